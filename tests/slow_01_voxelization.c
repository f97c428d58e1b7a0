// 01 voxelization, slow: the truth at 128³ and 256³, and every extreme scene.
#include "voxel_bench.h"

static void check_truth(const char *scene, int resolution)
{
    Bench bench = bench_open(scene);
    VoxelGrid grid = scene_grid(bench.scene, resolution);
    uint32_t *exact = bits_exact(&bench, &grid), *truth = truth_voxels(&bench.mesh, &grid);
    check_same(exact, truth, &grid, scene);
    free(exact);
    free(truth);
    gl_close();
}
#define TRUTH_TEST(scene, ...)                                                                               \
    Test(slow_voxelization, exact_is_the_truth_on_##scene)                                                   \
    {                                                                                                        \
        const int resolutions[] = {__VA_ARGS__};                                                             \
        for (size_t i = 0; i < sizeof resolutions / sizeof(int); i++)                                        \
            check_truth(#scene, resolutions[i]);                                                             \
    }
TRUTH_TEST(bunny, 128, 256)
TRUTH_TEST(cornell, 128, 256)
TRUTH_TEST(colonnade, 128, 256)
TRUTH_TEST(slivers, 7, 100, 256)
TRUTH_TEST(huge, 7, 100, 256)
TRUTH_TEST(tiny, 7, 100, 256)
TRUTH_TEST(degenerate, 7, 100, 256)
TRUTH_TEST(planar, 7, 100, 256)
TRUTH_TEST(far, 7, 100, 256)
TRUTH_TEST(vast, 7, 100, 256)

// Every N that the closed forms are promised for; the fast tests take some. The faces of a cube `inset` voxels inside the grid.
static void check_every_cube(int from, float inset, double layers)
{
    Bench bench = bench_open(NULL);
    for (int n = from; n <= 64; n++) {
        float far = (float)n - inset;
        bench.mesh = (Mesh){0};
        mesh_add_box(&bench.mesh, vec3_make(inset, inset, inset), vec3_make(far, far, far), 0);
        bench_mesh(&bench);
        VoxelGrid grid = cube_grid(0.0, 1.0, n);
        uint32_t *bits = bits_exact(&bench, &grid);
        cr_assert_eq(voxels_count(bits, NULL, grid_words(&grid)), pow(n, 3) - pow(n - 2.0 * layers, 3),
                     "N = %d, %g inside", n, inset);
        free(bits);
        triangle_lists_delete(&bench.lists);
        raster_mesh_delete(&bench.gpu);
    }
}
Test(slow_voxelization, a_cube_a_quarter_inside_the_grid_fills_its_shell)
{
    check_every_cube(4, 0.25f, 1);
}
Test(slow_voxelization, triangles_in_voxel_faces_mark_both_sides)
{
    check_every_cube(5, 1.0f, 2);
}
Test(slow_voxelization, triangles_in_the_outer_faces_fill_the_shell)
{
    check_every_cube(4, 0.0f, 1);
}

// Three squares that halve the grid. Of an even number of voxels they lie in faces between two layers each: a shell turned inside out. Of an odd one they
// lie within the middle layers.
Test(slow_voxelization, three_squares_that_halve_the_grid_touch_their_layers)
{
    Bench bench = bench_open(NULL);
    for (int n = 4; n <= 64; n++) {
        const float side = (float)n;
        const vec3 x = vec3_make(side, 0, 0), y = vec3_make(0, side, 0), z = vec3_make(0, 0, side);
        bench.mesh = (Mesh){0};
        mesh_add_quad(&bench.mesh, 0.5f * x, y, z, 0);
        mesh_add_quad(&bench.mesh, 0.5f * y, z, x, 0);
        mesh_add_quad(&bench.mesh, 0.5f * z, x, y, 0);
        bench_mesh(&bench);
        VoxelGrid grid = cube_grid(0.0, 1.0, n);
        uint32_t *bits = bits_exact(&bench, &grid);
        cr_assert_eq(voxels_count(bits, NULL, grid_words(&grid)), pow(n, 3) - pow(n % 2 ? n - 1 : n - 2, 3),
                     "N = %d", n);
        free(bits);
        triangle_lists_delete(&bench.lists);
        raster_mesh_delete(&bench.gpu);
    }
}
