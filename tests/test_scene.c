// scene: what the rule refuses, drops and repairs, and what is just beyond it; building blocks against closed forms.
#include "scene_builtin.h"
#include "scene_sums.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

// --- scenes by hand --------------------------------------------------------------------------------------------------------------

static Scene *by_hand(void)
{
    Scene *scene = memory_new(1, sizeof *scene, "a scene");
    scene->name = text_format("by hand");
    scene_add_material(scene, "grey", vec3_make(0.5f, 0.5f, 0.5f), vec3_make(0, 0, 0));
    return scene;
}

static void add(Scene *scene, vec3 a, vec3 b, vec3 c, vec3 normal)
{
    const uint32_t first = mesh_add_vertex(&scene->mesh, a, normal);
    mesh_add_vertex(&scene->mesh, b, normal);
    mesh_add_vertex(&scene->mesh, c, normal);
    mesh_add_triangle(&scene->mesh, first, first + 1, first + 2, 0);
}

// A right triangle in z = 0 whose longest edge is 1 and whose height over it, at the middle, is `height`: |cross| = height.
static void add_flat(Scene *scene, float height)
{
    add(scene, vec3_make(0, 0, 0), vec3_make(1, 0, 0), vec3_make(0.5f, height, 0), vec3_make(0, 0, 1));
}

static void expect_verdict(Scene *scene, bool may_be_empty, const char *expected)
{
    char *refused = scene_validate(scene, may_be_empty);
    cr_assert(expected ? refused && strcmp(refused, expected) == 0 : !refused, "got '%s', expected '%s'",
              refused ? refused : "accepted", expected ? expected : "accepted");
    free(refused);
    scene_close(scene);
}

Test(scene, vertices_that_are_not_finite_are_refused)
{
    const float bad[] = {NAN, INFINITY, -INFINITY};
    for (size_t i = 0; i < 9; i++) {
        Scene *scene = by_hand();
        add_flat(scene, 1);
        scene->mesh.positions[i] = bad[i / 3];
        expect_verdict(scene, true, "1 of 3 vertices are NaN or infinite");
    }
    Scene *scene = by_hand(); // just beyond: the largest finite number
    add_flat(scene, 1);
    scene->mesh.positions[3] = scene->mesh.positions[7] = FLT_MAX;
    expect_verdict(scene, false, NULL);
}

Test(scene, indices_past_the_last_vertex_are_refused)
{
    for (uint32_t index = 2; index < 4; index++) {
        Scene *scene = by_hand();
        add_flat(scene, 1);
        scene->mesh.indices[2] = index;
        expect_verdict(scene, false, index < 3 ? NULL : "1 of 3 indices are past the last of 3 vertices");
    }
}

Test(scene, a_triangle_without_area_is_dropped_and_a_flatter_one_than_any_sliver_stays)
{
    // Dropped up to 2^-50 of the longest edge squared, as scene_validate.c says.
    const float height[] = {0, 0x1p-60f, 0x1p-50f, 0x1p-49f, 1e-6f, 1};
    for (size_t i = 0; i < 6; i++) {
        Scene *scene = by_hand();
        add_flat(scene, height[i]);
        add_flat(scene, 1);
        char *refused = scene_validate(scene, false);
        cr_assert(!refused, "refused: %s", refused);
        cr_assert_eq(scene->report.zero_area_triangles, i < 3, "height %g", (double)height[i]);
        cr_assert_eq(scene->mesh.triangle_count, i < 3 ? 1 : 2, "height %g", (double)height[i]);
        scene_close(scene);
    }
}

Test(scene, three_points_on_a_line_have_no_area_wherever_they_are)
{
    // a, a + d, a + 3 d in float32 lie on one line exactly where the sums are exact: multiples of 1/16 up to 10^6.
    Random random = {7};
    for (int i = 0; i < 1000; i++) {
        vec3 a = 1e6f * random_direction(&random), d = 1e3f * random_direction(&random);
        for (int axis = 0; axis < 3; axis++)
            a[axis] = roundf(16 * a[axis]) / 16, d[axis] = roundf(16 * d[axis]) / 16;
        Scene *scene = by_hand();
        add(scene, a, a + d, a + 3 * d, vec3_make(0, 1, 0));
        expect_verdict(scene, false, "it has no triangle with an area (1 without, 0 points and lines)");
    }
}

Test(scene, an_empty_scene_is_refused_where_a_file_gave_it)
{
    expect_verdict(by_hand(), true, NULL);
    expect_verdict(by_hand(), false, "it has no triangle with an area (0 without, 0 points and lines)");
}

Test(scene, each_corner_without_a_normal_gets_its_own_triangles)
{
    const vec3 bad[] = {vec3_make(0, 0, 0), vec3_make(0, NAN, 1), vec3_make(INFINITY, 0, 0)};
    for (size_t i = 0; i < 3; i++) {
        Scene *scene =
            by_hand(); // a roof: two triangles that share the ridge's two vertices, at a right angle
        Mesh *mesh = &scene->mesh;
        mesh_add_vertex(mesh, vec3_make(0, 0, 0), bad[i]);
        mesh_add_vertex(mesh, vec3_make(0, 0, 1), bad[i]);
        mesh_add_vertex(mesh, vec3_make(1, -1, 0), bad[i]);
        mesh_add_vertex(mesh, vec3_make(-1, -1, 0), vec3_make(-3, 4, 0));
        mesh_add_vertex(mesh, vec3_make(9, 9, 9), bad[i]); // in no triangle
        mesh_add_triangle(mesh, 0, 1, 2, 0);
        mesh_add_triangle(mesh, 0, 3, 1, 0);
        char *refused = scene_validate(scene, false);
        cr_assert(!refused, "refused: %s", refused);
        cr_assert_eq(mesh->vertex_count, 7, "the ridge's two vertices are copied: %zu", mesh->vertex_count);
        cr_assert_eq(scene->report.repaired_normals, 5, "got %zu", scene->report.repaired_normals);
        for (size_t corner = 0; corner < 6; corner++) {
            const float *n = mesh->normals + 3 * mesh->indices[corner];
            const double side = corner < 3 ? 1 : -1, half = sqrt(0.5);
            const bool given = corner == 4; // of unit length now
            expect_vector(vec3_make(n[0], n[1], n[2]), given ? -0.6 : side * half, given ? 0.8 : half, 0,
                          "a corner");
        }
        const float *loose = mesh->normals + 3 * 4;
        expect_vector(vec3_make(loose[0], loose[1], loose[2]), 0, 1, 0, "in no triangle: up");
        expect_vector(scene->lower, -1, -1, 0, "lower");
        expect_vector(scene->upper, 1, 0, 1, "upper, without the vertex in no triangle");
        scene_close(scene);
    }
}

Test(scene, the_report_is_one_line_or_none)
{
    Scene *scene = by_hand();
    add_flat(scene, 1);
    free(scene_validate(scene, false));
    cr_assert(!scene_report_text(scene), "nothing was dropped");
    add_flat(scene, 0);
    scene->report.other_primitives = 2;
    scene->mesh.normals[2] = 0;
    free(scene_validate(scene, false));
    char *text = scene_report_text(scene);
    cr_assert_eq(strcmp(text,
                        "by hand: dropped 1 triangles without area and 2 points and lines; gave 1 vertices "
                        "their triangle's normal"),
                 0, "got '%s'", text);
    free(text);
    scene_close(scene);
}

// --- building blocks -------------------------------------------------------------------------------------------------------------

Test(scene, a_box_is_twelve_triangles_that_face_outwards)
{
    Scene *scene = by_hand();
    mesh_add_box(&scene->mesh, vec3_make(-1, 2, 3), vec3_make(1, 2.5f, 6), 0);
    const Sums sums = sums_of(&scene->mesh, 0);
    cr_assert_eq(scene->mesh.triangle_count, 12, "got %zu", scene->mesh.triangle_count);
    expect_near(sums.area, 2 * (2 * 0.5 + 0.5 * 3 + 2 * 3), FLOAT_SUMS, "area");
    expect_near(sums.volume, 2 * 0.5 * 3, FLOAT_SUMS, "volume");
    cr_assert_eq(sums.against + sums.not_unit, 0, "normals: %zu against, %zu not unit", sums.against,
                 sums.not_unit);
    scene_close(scene);
}

Test(scene, a_quad_faces_u_cross_v)
{
    Scene *scene = by_hand();
    mesh_add_quad(&scene->mesh, vec3_make(1, 1, 1), vec3_make(0, 0, 2), vec3_make(3, 0, 0), 0);
    const Sums sums = sums_of(&scene->mesh, 0);
    expect_near(sums.area_vector[1], 6, FLOAT_SUMS, "z × x = y");
    expect_near(sums.area, 6, FLOAT_SUMS, "area");
    cr_assert_eq(sums.against + sums.not_unit, 0, "the normals agree");
    scene_close(scene);
}

Test(scene, a_turned_profile_has_the_volume_of_its_frustums)
{
    enum { SEGMENTS = 12 };
    static const vec2 profile[] = {{0, 0}, {2, 0}, {1, 1}, {1.5f, 3}, {0, 4}};
    Scene *scene = by_hand();
    const Frame frame = frame_at(vec3_make(3, -1, 2), 0.4f);
    frame_revolve(&scene->mesh, &frame, profile, 5, SEGMENTS, 0);
    double volume = 0; // frustum: height (A + sqrt(A B) + B) / 3, A = n/2 sin(2π/n) r² of a regular n-gon
    const double polygon = SEGMENTS / 2.0 * sin(2 * 3.14159265358979 / SEGMENTS);
    for (int i = 0; i < 4; i++) {
        const double a = (double)profile[i][0], b = (double)profile[i + 1][0],
                     h = (double)profile[i + 1][1] - (double)profile[i][1];
        volume += polygon * h * (a * a + a * b + b * b) / 3;
    }
    const Sums sums = sums_of(&scene->mesh, 0);
    expect_near(sums.volume, volume, FLOAT_SUMS, "volume");
    cr_assert_eq(sums.against + sums.not_unit, 0, "normals: %zu against, %zu not unit", sums.against,
                 sums.not_unit);
    scene_close(scene);
}

static void make_wide_box(Scene *scene, uint64_t seed)
{
    (void)seed;
    mesh_add_box(&scene->mesh, vec3_make(-4, 1, -1), vec3_make(2, 2, 5), 0);
}

Test(scene, the_aimed_camera_sees_all_of_it_and_no_more_than_it_must)
{
    const vec3 directions[] = {vec3_make(1, 2, 3), vec3_make(0, 1, 0), vec3_make(0, -5, 0),
                               vec3_make(-1, 0, 0)};
    for (size_t d = 0; d < 4; d++) {
        Scene *scene = scene_from(&(SceneKind){"box", "a box", make_wide_box}, 0);
        scene_aim_camera(scene, directions[d], 0.5f);
        Camera camera = scene->camera;
        camera.near_distance = 0.01f, camera.far_distance = 100;
        const mat4 clip = mat4_multiply(camera_projection(camera, 1), camera_view(camera));
        double edge = 0;
        for (size_t i = 0; i < scene->mesh.vertex_count; i++) {
            const float *p = scene->mesh.positions + 3 * i;
            const vec3 seen = mat4_transform_point(clip, vec3_make(p[0], p[1], p[2]));
            edge = fmax(edge, fmax(fabs((double)seen[0]), fabs((double)seen[1])));
        }
        cr_assert(edge <= 1 && edge > 0.9, "the corner farthest out lies at %g of the picture",
                  edge); // 5 % of margin
        scene_close(scene);
    }
}
