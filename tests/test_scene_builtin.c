// scene: the built-in scenes against closed forms and against themselves.
#include "failure.h"
#include "scene_sums.h"

#include <stdlib.h>

static bool needs_a_missing_package(const SceneKind *kind)
{
    return strcmp(kind->name, "office") == 0 && access("/usr/share/geomview/geom/office.oogl", R_OK) != 0;
}

Test(scene_builtin, built_in_scenes_are_whole)
{
    for (const SceneKind *kind = scene_kinds; kind->name; kind++) {
        if (needs_a_missing_package(kind))
            continue;
        Scene *scene = scene_open(kind->name, 1);
        const Sums sums = sums_of(&scene->mesh, 0);
        const bool broken = strcmp(kind->name, "degenerate") == 0, empty = strcmp(kind->name, "empty") == 0;
        cr_assert_eq(sums.not_unit, 0, "%s: %zu normals are not unit", kind->name, sums.not_unit);
        // a triangle turned over shares its vertices' normals in `degenerate`; a bunny's smooth normal may lean over a fold (0.1 %)
        cr_assert(broken || sums.against <= 3 * scene->mesh.triangle_count / 1000,
                  "%s: %zu normals against the winding", kind->name, sums.against);
        cr_assert_eq(scene->report.zero_area_triangles, broken ? 120 : 0, "%s: %zu dropped", kind->name,
                     scene->report.zero_area_triangles); // of 40 broken groups, three each
        cr_assert(scene->light_count >= 1, "%s has no light", kind->name);
        for (size_t i = 0; i < scene->mesh.triangle_count; i++)
            cr_assert(scene->mesh.triangle_material[i] < scene->material_count, "%s: no such material",
                      kind->name);
        const double diagonal = empty ? sqrt(3) : (double)vec3_length(scene->upper - scene->lower);
        expect_near((double)scene->lights[0].radius, 1e-4 * diagonal, FLOAT_SUMS, "the light's radius");
        if (scene->lights[0].kind != LIGHT_POINT)
            expect_near((double)vec3_length(scene->lights[0].direction), 1, FLOAT_SUMS,
                        "the light's direction");
        const Camera *camera = &scene->camera;
        const vec3 away = camera->target - camera->eye, centre = 0.5f * (scene->lower + scene->upper);
        cr_assert(vec3_length(away) > 0 && camera->vertical_fov_rad > 0 && camera->near_distance > 0 &&
                      camera->far_distance >= vec3_length(centre - camera->eye) + 0.5f * (float)diagonal,
                  "%s: the far plane at %g m cuts the scene", kind->name, (double)camera->far_distance);
        scene_close(scene);
    }
}

Test(scene_builtin, cornell_has_the_areas_of_its_walls_and_blocks)
{
    Scene *scene = scene_open("cornell", 1);
    const double room = 5.5, b = 1.65;
    const double walls = 5 * room * room, low = 6 * b * b, tall = 2 * b * b + 4 * b * 2 * b;
    expect_near(sums_of(&scene->mesh, 0).area, walls + low + tall, FLOAT_SUMS, "area");
    const Sums blocks = sums_of(&scene->mesh, 10); // after five quads
    cr_assert_eq(scene->mesh.triangle_count, 34, "got %zu", scene->mesh.triangle_count);
    expect_near(blocks.volume, 3 * b * b * b, FLOAT_SUMS, "the blocks' volume");
    expect_vector(scene->lower, -2.75, 0, -2.75, "lower");
    expect_vector(scene->upper, 2.75, 5.5, 2.75, "upper");
    scene_close(scene);
}

Test(scene_builtin, bunny_is_closed_and_has_its_triangles)
{
    Scene *scene = scene_open("bunny", 1);
    const Sums sums = sums_of(&scene->mesh, 0);
    cr_assert_eq(scene->mesh.triangle_count, 69666, "got %zu", scene->mesh.triangle_count);
    for (int axis = 0; axis < 3; axis++) // rounding in double of 69 666 exact terms
        cr_assert(fabs(sums.area_vector[axis]) < 1e-9, "open along axis %d by %g m²", axis,
                  sums.area_vector[axis]);
    cr_assert(sums.volume > 0.1 && sums.volume < 8 * 0.991 * 0.775,
              "volume %g m³ is positive and less than its box's", sums.volume);
    scene_close(scene);
}

Test(scene_builtin, colonnade_is_as_large_as_it_says)
{
    Scene *scene = scene_open("colonnade", 1);
    cr_assert(scene->mesh.triangle_count >= 60000 && scene->mesh.triangle_count <= 120000, "%zu triangles",
              scene->mesh.triangle_count);
    cr_assert(scene->material_count >= 12, "albedo varies: %zu materials", scene->material_count);
    scene_close(scene);
}

// Each edge of a closed surface belongs to two triangles that run along it in opposite ways.
static int by_edge(const void *a, const void *b)
{
    const uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

// Seven saddles of four sheets: stars of eight arms at the heights where the sheets meet, four strips between each two of them, so the shell's middle
// has an Euler characteristic of 7 + 7·4 - 2·7·4 = -21, and the closed surface around it twice that: V - F/2 = 2 - 2·22.
Test(scene_builtin, toroid_is_closed_and_has_22_handles)
{
    Scene *scene = scene_open("toroid", 1);
    const Mesh *mesh = &scene->mesh;
    enum { SLAB_TRIANGLES = 12, SLAB_VERTICES = 24 };
    const size_t triangles = mesh->triangle_count - SLAB_TRIANGLES, edges = 3 * triangles;
    uint64_t *way = memory_new(edges, sizeof *way, "edges"), *back = memory_new(edges, sizeof *back, "edges");
    for (size_t i = 0; i < edges; i++) {
        const uint64_t a = mesh->indices[i], b = mesh->indices[i / 3 * 3 + (i + 1) % 3];
        way[i] = a << 32 | b;
        back[i] = b << 32 | a;
    }
    qsort(way, edges, sizeof *way, by_edge);
    qsort(back, edges, sizeof *back, by_edge);
    for (size_t i = 0; i < edges; i++) {
        cr_assert_eq(way[i], back[i], "edge %zu has no other side", i);
        cr_assert(i == 0 || way[i] != way[i - 1], "edge %zu is there twice", i);
    }
    cr_assert_eq((long)(mesh->vertex_count - SLAB_VERTICES) - (long)triangles / 2, 2 - 2 * 22,
                 "%zu vertices, %zu triangles", mesh->vertex_count, triangles);
    // Outwards: the slab is closed too, so the volume is what both hold.
    cr_assert(sums_of(mesh, 0).volume > 10 * 7 * 0.149, "volume %g m³", sums_of(mesh, 0).volume);
    free(way);
    free(back);
    scene_close(scene);
}

// Twigs thinner than a texel of a cube's map of 1024 at their distance, and a lamp that the camera looks towards.
Test(scene_builtin, forest_has_thin_twigs_before_its_lamp)
{
    Scene *scene = scene_open("forest", 1);
    const Mesh *mesh = &scene->mesh;
    size_t leaves = 0, thin = 0;
    for (size_t i = 0; i < mesh->triangle_count; i++) {
        const float *a = mesh->positions + 3 * (size_t)mesh->indices[3 * i],
                    *b = mesh->positions + 3 * (size_t)mesh->indices[3 * i + 1];
        const bool leaf = mesh->triangle_material[i] >= 2;
        leaves += leaf;
        thin += !leaf && hypotf(a[0] - b[0], hypotf(a[1] - b[1], a[2] - b[2])) < 0.01f;
    }
    cr_assert(mesh->triangle_count > 100000 && mesh->triangle_count < 400000, "%zu triangles",
              mesh->triangle_count);
    cr_assert(leaves > 50000 && thin > 30000, "%zu of leaves, %zu of twigs", leaves, thin);
    const vec4 lamp = {scene->lights[0].position[0], scene->lights[0].position[1],
                       scene->lights[0].position[2], 1};
    const vec4 seen =
        mat4_transform(camera_projection(scene->camera, 1), mat4_transform(camera_view(scene->camera), lamp));
    cr_assert(fabsf(seen[0]) < 0.5f * seen[3] && fabsf(seen[1]) < 0.5f * seen[3] && seen[3] > 0,
              "the lamp is seen at (%g %g)", (double)(seen[0] / seen[3]), (double)(seen[1] / seen[3]));
    scene_close(scene);
}

Test(scene_builtin, slivers_reach_an_aspect_of_a_million)
{
    Scene *scene = scene_open("slivers", 3);
    double most = 0;
    for (size_t i = 0; i < scene->mesh.triangle_count; i++) {
        const Mesh one = {.triangle_count = 1,
                          .positions = scene->mesh.positions,
                          .normals = scene->mesh.normals,
                          .indices = scene->mesh.indices + 3 * i};
        most = fmax(most, 1 / (2 * sums_of(&one, 0).area)); // the long edge is 1 m
    }
    // 10^-6 m of height on coordinates that are rounded to within 6e-8 m each
    cr_assert(most > 0.8e6 && most < 1.3e6, "the flattest has an aspect of %g", most);
    scene_close(scene);
}

Test(scene_builtin, huge_and_tiny_are_the_same_temple)
{
    Scene *huge = scene_open("huge", 1), *tiny = scene_open("tiny", 1);
    const Sums far = sums_of(&huge->mesh, 0), small = sums_of(&tiny->mesh, 0);
    cr_assert_eq(huge->mesh.triangle_count, tiny->mesh.triangle_count, "the same triangles");
    expect_near(small.area, 1e-12 * far.area, FLOAT_SUMS, "area at 10^-6");
    expect_vector(huge->upper - huge->lower, 10, 6.75, 10, "the huge one is 10 m wide");
    expect_vector(huge->lower, 1e6 - 5, 1e6, -1e6 - 5, "and far away");
    expect_vector(1e6f * (tiny->upper - tiny->lower), 10, 6.75, 10, "the tiny one is 10 µm wide");
    scene_close(huge);
    scene_close(tiny);
}

Test(scene_builtin, planar_lies_in_one_plane)
{
    Scene *scene = scene_open("planar", 1);
    cr_assert(scene->lower[2] == 0 && scene->upper[2] == 0 && scene->mesh.triangle_count > 0, "z = 0");
    expect_near(sums_of(&scene->mesh, 0).area_vector[2], 4, FLOAT_SUMS,
                "a sheet of 2 m by 2 m without a hole");
    expect_near(sums_of(&scene->mesh, 0).area, 4, FLOAT_SUMS, "and without a fold");
    scene_close(scene);
}

static uint64_t hash_of(const char *name, uint64_t seed)
{
    Scene *scene = scene_open(name, seed);
    uint64_t hash = hash_bytes(HASH_START, scene->mesh.positions, 12 * scene->mesh.vertex_count);
    hash = hash_bytes(hash, scene->mesh.indices, 12 * scene->mesh.triangle_count);
    for (size_t i = 0; i < scene->material_count; i++)
        hash = hash_bytes(hash, &scene->materials[i].albedo, 12);
    scene_close(scene);
    return hash;
}

Test(scene_builtin, the_seed_decides_and_nothing_else)
{
    const char *const random[] = {"colonnade", "slivers", "planar", "degenerate", "forest"},
                      *const fixed[] = {"cornell", "huge", "tiny", "toroid"};
    for (size_t i = 0; i < 5; i++) {
        cr_assert_eq(hash_of(random[i], 5), hash_of(random[i], 5), "%s differs from itself", random[i]);
        cr_assert_neq(hash_of(random[i], 5), hash_of(random[i], 6), "%s heeds no seed", random[i]);
    }
    for (size_t i = 0; i < 4; i++)
        cr_assert_eq(hash_of(fixed[i], 5), hash_of(fixed[i], 6), "%s has nothing random", fixed[i]);
}

static void make_cube_of(Scene *scene, uint64_t exponent)
{
    const float size = powf(10, (float)(int64_t)exponent);
    mesh_add_box(&scene->mesh, vec3_make(0, 0, 0), vec3_make(size, size, size), 0);
}

static int64_t cube_exponent;
static void open_cube(void)
{
    scene_close(scene_from(&(SceneKind){"cube", "a cube", make_cube_of}, (uint64_t)cube_exponent));
}

Test(scene_builtin, sizes_whose_square_leaves_float32_are_refused)
{
    for (cube_exponent = -24; cube_exponent <= 24; cube_exponent += 6) {
        const Failure got = failure_of(open_cube);
        const bool fits = labs(cube_exponent) <= 18;
        cr_assert(fits ? got.status == 0 : got.status == 1 && failure_says(&got, "cube: refused: it is 1e"),
                  "10^%d m: status %d, %s", (int)cube_exponent, got.status, got.message);
    }
}
