// scene: model files, sound and broken, and the voxel grid around a scene.
#include "failure.h"
#include "scene.h"

#include <criterion/criterion.h>
#include <float.h>

#define DATA "tests/data/scene/"

static void expect_vector(vec3 got, double x, double y, double z, const char *what)
{
    const double far =
        fmax(fmax(fabs((double)got[0] - x), fabs((double)got[1] - y)), fabs((double)got[2] - z));
    cr_assert(far <= 2e-6, "%s: (%g %g %g), expected (%g %g %g)", what, (double)got[0], (double)got[1],
              (double)got[2], x, y, z); // the files' quaternions have 8 digits, the numbers are below 12
}

// --- what a sound file brings --------------------------------------------------------------------------------------------------

// Cameras and lights hang on a node that is turned by 90° about y (z becomes x, x becomes -z) and moved by (1, 2, 3).
Test(scene_file, gltf_camera_stands_where_its_node_does)
{
    const char *const files[] = {DATA "lights.gltf", DATA "no_aspect.gltf"};
    for (size_t i = 0; i < 2; i++) { // Assimp multiplies the angle by the aspect ratio where there is one
        Scene *scene = scene_open(files[i], 0);
        const Camera *camera = &scene->camera;
        cr_assert(fabsf(camera->vertical_fov_rad - 0.8f) < 1e-6f, "%s: yfov is 0.8, got %.7g", files[i],
                  (double)camera->vertical_fov_rad); // one rounding of a product and a quotient
        expect_vector(camera->eye, 6, 2, 3, "eye");
        expect_vector(camera->target, 4.5, 2, 3, "target: ahead, as deep as the middle of the box -2 … 11");
        expect_vector(camera->up, 0, 1, 0, "up");
        cr_assert_eq(camera->near_distance, 0.25f, "near, got %g", (double)camera->near_distance);
        cr_assert(camera->far_distance > 8, "far holds the scene, got %g", (double)camera->far_distance);
        scene_close(scene);
    }
}

Test(scene_file, gltf_lights_keep_colour_cone_and_place)
{
    Scene *scene = scene_open(DATA "lights.gltf", 0);
    cr_assert_eq(scene->light_count, 3, "got %zu", scene->light_count);
    const Light *spot = &scene->lights[0], *point = &scene->lights[1], *sun = &scene->lights[2];
    cr_assert(spot->kind == LIGHT_SPOT && point->kind == LIGHT_POINT && sun->kind == LIGHT_DIRECTIONAL,
              "kinds");
    expect_vector(spot->position, 3, 2, 3, "spot's place");
    expect_vector(spot->direction, -1, 0, 0, "spot's direction");
    expect_vector(spot->intensity, 8, 4, 2, "spot's colour times its intensity");
    cr_assert(fabsf(spot->half_angle_rad - 0.4f) < 1e-6f, "outer cone's half angle, got %g",
              (double)spot->half_angle_rad);
    expect_vector(point->position, 1, 3, 3, "point's place");
    expect_vector(point->intensity, 3, 3, 3, "point's intensity, white");
    expect_vector(sun->direction, 0, -1, 0, "sun's direction: its own node turns it down");
    expect_vector(sun->intensity, 0, 2, 2, "sun's irradiance");
    const double diagonal = sqrt(13 * 13 + 1 + 1);
    cr_assert(fabs((double)point->radius / (1e-4 * diagonal) - 1) < 1e-5, "radius %g m",
              (double)point->radius);
    scene_close(scene);
}

static double volume_of(const Mesh *mesh, size_t first, size_t end)
{
    double volume = 0;
    for (size_t i = first; i < end; i++) {
        double p[9];
        for (size_t k = 0; k < 9; k++)
            p[k] = (double)mesh->positions[3 * mesh->indices[3 * i + k / 3] + k % 3];
        volume += (p[0] * (p[4] * p[8] - p[5] * p[7]) + p[1] * (p[5] * p[6] - p[3] * p[8]) +
                   p[2] * (p[3] * p[7] - p[4] * p[6])) /
                  6;
    }
    return volume;
}

Test(scene_file, gltf_nodes_place_scale_and_mirror_their_mesh)
{
    Scene *scene = scene_open(DATA "lights.gltf", 0);
    cr_assert_eq(scene->mesh.triangle_count, 8, "a tetrahedron twice, got %zu", scene->mesh.triangle_count);
    cr_assert(fabs(volume_of(&scene->mesh, 0, 4) - 1.0 / 6) < 1e-6, "the one that is moved");
    cr_assert(fabs(volume_of(&scene->mesh, 4, 8) - 2.0 / 6) < 1e-6,
              "the one that is mirrored still faces outwards");
    expect_vector(scene->lower, -2, 0, 0, "lower");
    expect_vector(scene->upper, 11, 1, 1, "upper");
    const float *slope = scene->mesh.normals + 3 * scene->mesh.indices[3 * 7];
    expect_vector(vec3_make(slope[0], slope[1], slope[2]), -1.0 / 3, 2.0 / 3, 2.0 / 3,
                  "normal of -x/2 + y + z = 1");
    const Material *material = &scene->materials[scene->mesh.triangle_material[0]];
    expect_vector(material->albedo, 0.25, 0.5, 0.75, "base colour");
    expect_vector(material->emission, 1, 0.5, 0, "emission");
    scene_close(scene);
}

Test(scene_file, a_file_without_camera_or_light_gets_both)
{
    Scene *scene = scene_open(DATA "whole.obj", 0);
    cr_assert_eq(scene->light_count, 1, "got %zu", scene->light_count);
    const vec3 way = scene->lights[0].direction;
    cr_assert(scene->lights[0].kind == LIGHT_DIRECTIONAL && way[0] > 0 && way[1] < 0,
              "from above, from the left");
    const vec3 ahead = vec3_normalize(scene->camera.target - scene->camera.eye);
    cr_assert(vec3_dot(ahead, vec3_normalize(0.5f * (scene->lower + scene->upper) - scene->camera.eye)) >
                  0.9999f,
              "it looks at the middle");
    scene_close(scene);
}

Test(scene_file, an_obj_without_normals_keeps_its_creases)
{
    Scene *scene = scene_open(DATA "creases.obj", 0);
    const double half = sqrt(0.5);
    for (size_t corner = 0; corner < 2; corner++) { // of the first triangle of each roof: on the ridge
        const float *flat = scene->mesh.normals + 3 * (size_t)scene->mesh.indices[corner];
        const float *steep = scene->mesh.normals + 3 * (size_t)scene->mesh.indices[6 + corner];
        expect_vector(vec3_make(flat[0], flat[1], flat[2]), 0, 1, 0, "a ridge that turns by 20° is smoothed");
        expect_vector(vec3_make(steep[0], steep[1], steep[2]), half, half, 0, "one that turns by 90° is not");
    }
    scene_close(scene);
}

Test(scene_file, what_is_no_triangle_is_counted)
{
    Scene *scene = scene_open(DATA "mixed.obj", 0);
    cr_assert_eq(scene->mesh.triangle_count, 1, "got %zu", scene->mesh.triangle_count);
    cr_assert_eq(scene->report.zero_area_triangles, 2, "got %zu", scene->report.zero_area_triangles);
    cr_assert_eq(scene->report.other_primitives, 3, "two points and a line, got %zu",
                 scene->report.other_primitives);
    scene_close(scene);
}

// --- what is wrong with a file, in one line ------------------------------------------------------------------------------------

static const char *name;
static void open_named(void)
{
    scene_close(scene_open(name, 0));
}

#define SAYS(test, name_or_file, exit_status, line)                                                          \
    Test(scene_file, test)                                                                                   \
    {                                                                                                        \
        name = name_or_file;                                                                                 \
        const Failure got = failure_of(open_named);                                                          \
        cr_assert(got.status == (exit_status) && failure_says(&got, ": " line "\n"), "status %d, '%s'",      \
                  got.status, got.message);                                                                  \
    }

SAYS(missing, DATA "nowhere.obj", 1, DATA "nowhere.obj: no such file")
SAYS(folder, "./tests", 1, "./tests: a directory, not a model file")
SAYS(folder_named_like_a_model, DATA, 1, DATA ": a directory, not a model file")
SAYS(unknown_ending, DATA "notes.xyz", 1,
     DATA "notes.xyz: a file of this ending cannot be read; .obj, .gltf, .glb, .ply, .off can")
SAYS(empty_gltf, DATA "empty.gltf", 1, DATA "empty.gltf: broken: the file is empty")
SAYS(cut_gltf, DATA "cut.gltf", 1,
     DATA "cut.gltf: broken: Assimp says: No suitable reader found for the file format of file \"" DATA
          "cut.gltf\".")
SAYS(nan_in_a_buffer, DATA "nan.gltf", 1, DATA "nan.gltf: refused: 2 of 4 vertices are NaN or infinite")
SAYS(nan_in_text, DATA "nan.obj", 1, DATA "nan.obj: refused: 2 of 4 vertices are NaN or infinite")
SAYS(face_cut, DATA "face_cut.obj", 1,
     DATA "face_cut.obj: broken: a face has 2 corners; is the file cut short?")
SAYS(index_past_the_end, DATA "past_the_end.obj", 1,
     DATA "past_the_end.obj: broken: Assimp says: OBJ: vertex index out of range")
SAYS(no_faces, DATA "without_faces.obj", 1,
     DATA "without_faces.obj: refused: it has no triangle with an area (0 without, 0 points and lines)")
SAYS(no_area, DATA "without_area.obj", 1,
     DATA "without_area.obj: refused: it has no triangle with an area (1 without, 0 points and lines)")
SAYS(too_large, DATA "largest.gltf", 1,
     DATA "largest.gltf: refused: it is 3.40282e+38 m wide; sizes from 1e-18 to 1e18 m can be worked with")
SAYS(unknown_name, "sponza", 2,
     "--scene: no scene is named 'sponza'; there are bunny, cornell, colonnade, fence, toroid, forest, "
     "office, "
     "empty, slivers, huge, tiny, degenerate, "
     "planar, or a model file (a path with a '.' or '/')")
SAYS(texture_is_noted, DATA "textured.gltf", 0,
     "note: " DATA
     "textured.gltf: textures are not read; the base colour's factor alone counts (materials: 1)")

Test(scene_file, sound_files_say_nothing)
{
    name = DATA "whole.obj"; // face_cut.obj with its last line whole
    const Failure got = failure_of(open_named);
    cr_assert(got.status == 0 && got.message[0] == '\0', "status %d, '%s'", got.status, got.message);
}

Test(scene_file, a_missing_package_is_named)
{
    name = "office";
    if (access("/usr/share/geomview/geom/office.oogl", R_OK) == 0)
        return open_named();
    const Failure got = failure_of(open_named);
    cr_assert(got.status == 1 &&
                  failure_says(&got,
                               ": scene office: /usr/share/geomview/geom/office.oogl is missing; install the "
                               "Debian package geomview\n"),
              "status %d, '%s'", got.status, got.message);
}

// --- the grid --------------------------------------------------------------------------------------------------------------------

static double uniform(uint64_t *state)
{
    *state = *state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (double)(*state >> 11) * 0x1p-53;
}

static Scene boxed(vec3 lower, vec3 upper)
{
    return (Scene){.mesh.triangle_count = 1, .lower = lower, .upper = upper};
}

static void check_grid(vec3 lower, vec3 upper, int resolution)
{
    const Scene scene = boxed(lower, upper);
    const VoxelGrid grid = scene_grid(&scene, resolution);
    const double h = grid.voxel_size;
    cr_assert(h > 0 && (double)(float)h == h, "voxel size %.17g is no float32", h);
    double longest = 0, farthest = 0;
    int most = 0;
    for (int axis = 0; axis < 3; axis++) {
        const double origin = grid.origin[axis], low = (double)lower[axis], high = (double)upper[axis];
        const int size = grid.size[axis];
        cr_assert((double)(float)origin == origin, "origin %.17g is no float32", origin);
        cr_assert(origin <= low && high <= origin + size * h,
                  "axis %d: %.17g … %.17g outside %.17g + %d · %.17g", axis, low, high, origin, size, h);
        cr_assert(size >= 1 && size <= resolution, "axis %d has %d of %d voxels", axis, size, resolution);
        cr_assert(size == 1 || origin + (size - 1) * h < high, "axis %d: its last voxel of %d is not needed",
                  axis, size);
        for (int i = 0; i <= size;
             i += i < 2 || i >= size - 2 ? 1 : size - 3) // x87's 64 bits show what double rounds away
            cr_assert((long double)origin + (long double)i * (long double)h == (long double)(origin + i * h),
                      "face %d of axis %d is not exact", i, axis);
        longest = fmax(longest, high - low);
        farthest = fmax(farthest, fmax(fabs(low), fabs(high)));
        most = size > most ? size : most;
    }
    // Rounding up costs a few units of 2^-23 of h, or of 2^-50 of the farthest coordinate where that is more.
    cr_assert(h <= longest / resolution * (1 + 8 * 0x1p-23) + 8 * farthest * 0x1p-50,
              "voxels of %g for %g m / %d", h, longest, resolution);
    if (farthest * 0x1p-50 * resolution < h * 0x1p-20 && resolution <= 1024)
        cr_assert_eq(most, resolution, "%d voxels along the longest side, %d wanted", most, resolution);
}

Test(scene_grid, holds_the_box_with_exact_faces_at_every_scale)
{
    uint64_t state = 1;
    for (int i = 0; i < 10000; i++) {
        const double scale = pow(10, -6 + 12 * uniform(&state)), away = pow(10, -6 + 12 * uniform(&state));
        vec3 lower = {0}, upper = {0};
        for (int axis = 0; axis < 3; axis++) {
            lower[axis] = (float)(away * (2 * uniform(&state) - 1));
            upper[axis] =
                (float)((double)lower[axis] + scale * (i % 5 ? uniform(&state) : 1)); // each fifth a cube
        }
        if (i % 7 == 0)
            upper[i % 3] = lower[i % 3];
        if (upper[0] == lower[0] && upper[1] == lower[1] && upper[2] == lower[2])
            continue; // too small for where it is: a point, which has no triangle with an area
        check_grid(lower, upper, 1 + (int)(1024 * uniform(&state)));
    }
}

Test(scene_grid, holds_the_extreme_scenes)
{
    const char *const names[] = {"huge", "tiny", "planar", "slivers"};
    for (size_t i = 0; i < 4; i++) {
        Scene *scene = scene_open(names[i], 1);
        check_grid(scene->lower, scene->upper, 64);
        scene_close(scene);
    }
    const float ulp = FLT_EPSILON * 524288;                              // of 10^6
    check_grid(vec3_make(1e6f, 0, 0), vec3_make(1e6f + ulp, 0, 0), 512); // one ulp wide, 512 voxels
    check_grid(vec3_make(1e-30f, -1e-38f, 0), vec3_make(1, 1, 1), 100);  // its digits lie far below a voxel's
}

Test(scene_grid, of_a_metre_scene_far_away_has_its_voxels)
{
    const Scene scene = boxed(vec3_make(1e6f, 1e6f, 1e6f), vec3_make(1e6f + 64, 1e6f + 32, 1e6f + 1));
    const VoxelGrid grid = scene_grid(&scene, 64);
    cr_assert(grid.voxel_size == 1 && grid.size[0] == 64 && grid.size[1] == 32 && grid.size[2] == 1,
              "64 x 32 x 1 of 1 m, got %d x %d x %d of %.17g", grid.size[0], grid.size[1], grid.size[2],
              grid.voxel_size);
}

Test(scene_grid, around_nothing_is_a_metre_wide)
{
    Scene *scene = scene_open("empty", 0);
    cr_assert(scene->mesh.triangle_count == 0 && vec3_length(scene->upper - scene->lower) == 0,
              "no triangle, no box");
    const VoxelGrid grid = scene_grid(scene, 64);
    for (int axis = 0; axis < 3; axis++)
        cr_assert(grid.origin[axis] == -0.5 && grid.size[axis] == 64 && grid.voxel_size == 1.0 / 64,
                  "axis %d", axis);
    scene_close(scene);
}

Test(scene_grid, counts_voxels_and_words)
{
    const VoxelGrid grids[] = {
        {.size = {1, 1, 1}}, {.size = {32, 1, 1}}, {.size = {11, 3, 1}}, {.size = {2048, 2048, 2048}}};
    const size_t voxels[] = {1, 32, 33, (size_t)1 << 33}, words[] = {1, 1, 2, (size_t)1 << 28};
    for (size_t i = 0; i < 4; i++)
        cr_assert(grid_voxels(&grids[i]) == voxels[i] && grid_words(&grids[i]) == words[i],
                  "%zu voxels in %zu words", grid_voxels(&grids[i]), grid_words(&grids[i]));
}
