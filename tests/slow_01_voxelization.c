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

// Every N that the closed form is promised for; the fast test takes some.
Test(slow_voxelization, a_cube_a_quarter_inside_the_grid_fills_its_shell)
{
    for (int n = 4; n <= 64; n++) {
        Bench bench = bench_open(NULL);
        float far = (float)n - 0.25f;
        mesh_add_box(&bench.mesh, vec3_make(0.25f, 0.25f, 0.25f), vec3_make(far, far, far), 0);
        bench_mesh(&bench);
        VoxelGrid grid = cube_grid(0.0, 1.0, n);
        uint32_t *bits = bits_exact(&bench, &grid);
        cr_assert_eq(voxels_count(bits, NULL, grid_words(&grid)), pow(n, 3) - pow(n - 2, 3), "N = %d", n);
        free(bits);
        gl_close();
    }
}
