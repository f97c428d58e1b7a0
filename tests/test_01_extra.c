// 01 voxelization: how far extra voxels lie from the surface, against every triangle asked; and the balls that growth is measured on.
#include "voxel_bench.h"

#include "../chapters/01_voxelization/extra.h"

static double brute_force(const Bench *bench, const VoxelGrid *grid, const uint32_t *got,
                          const uint32_t *truth)
{
    double most = 0.0;
    for (int i = 0; i < (int)grid_voxels(grid); i++) {
        const int voxel[3] = {i % grid->size[0], i / grid->size[0] % grid->size[1],
                              i / grid->size[0] / grid->size[1]};
        if (!bit_of(got, grid, voxel[0], voxel[1], voxel[2]) ||
            bit_of(truth, grid, voxel[0], voxel[1], voxel[2]))
            continue;
        double least = INFINITY;
        for (size_t t = 0; t < bench->mesh.triangle_count; t++) {
            float corners[9];
            for (size_t k = 0; k < 9; k++)
                corners[k] = bench->mesh.positions[3 * bench->mesh.indices[3 * t + k / 3] + k % 3];
            least = fmin(least, truth_voxel_gap(corners, grid, voxel));
        }
        most = fmax(most, least);
    }
    return most;
}

// A voxel here and there, near the surface and far from it, in a grid whose rows end within words.
Test(extra, the_gap_is_that_of_the_nearest_triangle)
{
    Bench bench = bench_open("sphere_1000");
    VoxelGrid grid = {{-4.0, -2.0, 0.0}, 0.5, {45, 37, 33}};
    uint32_t *truth = truth_voxels(&bench.mesh, &grid), *got = memory_new(grid_words(&grid), 4, "bits");
    srand(11);
    for (int extra = 0; extra < 20; extra++) {
        size_t i = (size_t)rand() % grid_voxels(&grid);
        got[i >> 5] |= UINT32_C(1) << (i & 31);
        double expected = brute_force(&bench, &grid, got, truth);
        cr_assert_eq(extra_gap(&bench.mesh, &grid, got, truth), expected, "%d extra: %g, not %g", extra,
                     extra_gap(&bench.mesh, &grid, got, truth), expected);
    }
    cr_assert(extra_gap(&bench.mesh, &grid, got, truth) > 1.0, "every voxel lies beside the surface");
    cr_assert_eq(extra_gap(&bench.mesh, &grid, truth, truth), 0.0, "the truth has extra voxels");
}

// Closed, wound outwards, and smaller than the ball by what facets of this size cut off: their middles lie 1 - cos of half their angle inside.
static void check_ball(const char *name, double parts)
{
    Bench bench = bench_open(name);
    cr_assert_eq((double)bench.mesh.triangle_count, 8 * parts * parts, "%s: %zu triangles", name,
                 bench.mesh.triangle_count);
    double volume = 0.0;
    for (size_t t = 0; t < bench.mesh.triangle_count; t++) {
        double p[3][3];
        for (size_t v = 0; v < 3; v++)
            for (size_t k = 0; k < 3; k++)
                p[v][k] = bench.mesh.positions[3 * bench.mesh.indices[3 * t + v] + k] - 8.0;
        for (int k = 0; k < 3; k++) {
            int a = (k + 1) % 3, b = (k + 2) % 3;
            volume += p[0][k] * (p[1][a] * p[2][b] - p[1][b] * p[2][a]) / 6.0;
        }
    }
    double ball = 4.0 / 3.0 * acos(-1.0) * pow(7.5, 3.0);
    // the largest facets span 2 / parts rad in the middle of a face, so no more than (2 / parts)² of the volume is cut off
    cr_assert(volume < ball * (1.0 + 1e-6) && volume > ball * (1.0 - 4.0 / parts / parts - 1e-6),
              "%s: %g of %g m³", name, volume, ball);
    gl_close();
}
Test(extra, balls_have_their_triangles_and_their_volume)
{
    check_ball("sphere_1000", 11);
    check_ball("sphere_10000", 35);
    check_ball("sphere_100000", 112);
}
