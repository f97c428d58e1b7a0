// 01 voxelization: exact voxels against counts in closed form, invariants, and the truth's separating axes; the left-outs' witnesses.
#include "failure.h"
#include "voxel_bench.h"

#include <unistd.h>

// ---------------------------------------------------------------- closed forms

static double cube_voxels(int side, float inset)
{
    Bench bench = bench_open(NULL);
    float far = (float)side - inset;
    mesh_add_box(&bench.mesh, vec3_make(inset, inset, inset), vec3_make(far, far, far), 0);
    bench_mesh(&bench);
    VoxelGrid grid = cube_grid(0.0, 1.0, side);
    uint32_t *bits = bits_exact(&bench, &grid);
    double count = voxels_count(bits, NULL, grid_words(&grid));
    free(bits);
    gl_close();
    return count;
}
Test(voxelization, a_cube_a_quarter_inside_the_grid_fills_its_shell)
{
    for (int n = 4; n <= 64; n += n < 16 ? 1 : 12)
        cr_assert_eq(cube_voxels(n, 0.25f), pow(n, 3) - pow(n - 2, 3), "N = %d: %g voxels", n,
                     cube_voxels(n, 0.25f));
}
// Faces in the planes 1 and N-1: the voxels on both sides touch.
Test(voxelization, triangles_in_voxel_faces_mark_both_sides)
{
    for (int n = 5; n <= 64; n += n < 16 ? 1 : 12)
        cr_assert_eq(cube_voxels(n, 1.0f), pow(n, 3) - pow(n - 4, 3), "N = %d: %g voxels", n,
                     cube_voxels(n, 1.0f));
}
// In the grid's own outer faces there is only one side.
Test(voxelization, triangles_in_the_outer_faces_fill_the_shell)
{
    for (int n = 4; n <= 64; n += 12)
        cr_assert_eq(cube_voxels(n, 0.0f), pow(n, 3) - pow(n - 2, 3), "N = %d: %g voxels", n,
                     cube_voxels(n, 0.0f));
}
// Three edges and one point of a triangle touch corners only: a voxel whose only common point is a corner counts.
Test(voxelization, touching_in_a_point_counts)
{
    Bench bench = bench_open(NULL);
    bench_add(&bench, vec3_make(4, 4, 4), vec3_make(4.5f, 4.5f, 4.25f), vec3_make(4.5f, 4.25f, 4.5f));
    bench_mesh(&bench);
    VoxelGrid grid = cube_grid(0.0, 1.0, 8);
    uint32_t *bits = bits_exact(&bench, &grid);
    for (int i = 0; i < 8; i++)
        cr_assert(bit_of(bits, &grid, 3 + (i & 1), 3 + (i >> 1 & 1), 3 + (i >> 2)),
                  "voxel %d round the corner (4, 4, 4) is not set", i);
    cr_assert_eq(voxels_count(bits, NULL, grid_words(&grid)), 8,
                 "more than the 8 voxels round a corner are set");
    free(bits);
}

// In the grid's own space the triangle lies in x = 1 - 2^-30: within voxel 0 by less than single precision can tell.
Test(voxelization, corners_are_rebased_in_double)
{
    Bench bench = bench_open(NULL);
    bench_add(&bench, vec3_make(1, 0.25f, 0.25f), vec3_make(1, 0.75f, 0.25f), vec3_make(1, 0.25f, 0.75f));
    bench_mesh(&bench);
    VoxelGrid grid = cube_grid(0x1p-30, 1.0, 4);
    uint32_t *bits = bits_exact(&bench, &grid);
    cr_assert(bit_of(bits, &grid, 0, 0, 0), "the voxel that holds it is not set");
    cr_assert_eq(voxels_count(bits, NULL, grid_words(&grid)), 1, "a voxel that it does not reach is set");
    free(bits);
}

// ---------------------------------------------------------------- truth

static void check_truth(const char *scene, int resolution)
{
    Bench bench = bench_open(scene);
    VoxelGrid grid = scene_grid(bench.scene, resolution);
    uint32_t *exact = bits_exact(&bench, &grid), *truth = truth_voxels(&bench.mesh, &grid);
    cr_assert(voxels_count(truth, NULL, grid_words(&grid)) > resolution, "%s: the truth is empty", scene);
    check_same(exact, truth, &grid, scene);
    free(exact);
    free(truth);
}
#define TRUTH_TEST(scene, resolution)                                                                        \
    Test(voxelization, exact_is_the_truth_on_##scene##_##resolution)                                         \
    {                                                                                                        \
        check_truth(#scene, resolution);                                                                     \
    }
TRUTH_TEST(bunny, 32)
TRUTH_TEST(bunny, 64)
TRUTH_TEST(cornell, 32)
TRUTH_TEST(cornell, 64)
TRUTH_TEST(colonnade, 32)
TRUTH_TEST(colonnade, 64)
TRUTH_TEST(slivers, 32)
TRUTH_TEST(huge, 32)

// Slivers in random directions, shorter than a voxel to longer than the grid, on corners that are no lattice's.
Test(voxelization, exact_is_the_truth_on_random_triangles)
{
    Bench bench = bench_open(NULL);
    srand(5);
    for (int i = 0; i < 3000; i++) {
        vec3 p[3] = {0};
        float length = powf(10.0f, 3.0f * (float)rand() / (float)RAND_MAX - 1.0f);
        for (int v = 0; v < 3; v++)
            for (int k = 0; k < 3; k++)
                p[v][k] = v == 0 ? 24.0f * (float)rand() / (float)RAND_MAX - 4.0f
                                 : p[0][k] + length * ((float)rand() / (float)RAND_MAX - 0.5f);
        if (i % 3 == 0)
            p[2] = p[1] + 1e-5f * (p[2] - p[1]);
        bench_add(&bench, p[0], p[1], p[2]);
    }
    bench_mesh(&bench);
    VoxelGrid grid = {{-0.25, 0.125, 0.5}, 0.3000000119f, {52, 47, 50}};
    uint32_t *exact = bits_exact(&bench, &grid), *truth = truth_voxels(&bench.mesh, &grid);
    cr_assert(bench.lists.outside > 0 && bench.lists.count[LIST_SMALL] > 0 && bench.lists.count[LIST_X] > 0,
              "not every path is taken");
    check_same(exact, truth, &grid, "random triangles");
    free(exact);
    free(truth);
}

// ---------------------------------------------------------------- invariants

Test(voxelization, the_order_of_triangles_changes_nothing)
{
    Bench bench = bench_open("bunny");
    VoxelGrid grid = scene_grid(bench.scene, 64);
    uint32_t *before = bits_exact(&bench, &grid);
    srand(3);
    for (size_t i = bench.mesh.triangle_count - 1; i > 0; i--) {
        size_t j = (size_t)rand() % (i + 1);
        uint32_t swap[3], *a = bench.mesh.indices + 3 * i, *b = bench.mesh.indices + 3 * j;
        memcpy(swap, a, sizeof swap);
        memmove(a, b, sizeof swap);
        for (int k = 0; k < 3; k++)
            b[k] = swap[(k + 1) % 3]; // and the order of corners
    }
    bench_mesh(&bench);
    uint32_t *after = bits_exact(&bench, &grid);
    check_same(after, before, &grid, "shuffled");
    free(before);
    free(after);
}

static uint64_t hash_of_bits(const char *scene)
{
    Bench bench = bench_open(scene);
    VoxelGrid grid = scene_grid(bench.scene, 64);
    uint32_t *exact = bits_exact(&bench, &grid), *raster = bits_raster(&bench, &grid);
    uint64_t hash = hash_bytes(HASH_START, exact, 4 * grid_words(&grid));
    return hash_bytes(hash, raster, 4 * grid_words(&grid));
}
Test(voxelization, the_number_of_threads_changes_nothing)
{
    cr_assert_eq(hash_with_threads("1", hash_of_bits, "bunny"), hash_with_threads("2", hash_of_bits, "bunny"),
                 "1 and 2 threads differ");
}

Test(voxelization, a_grid_moved_by_whole_voxels_holds_moved_voxels)
{
    Bench bench = bench_open("bunny");
    // powers of two: the origin moves without rounding
    VoxelGrid grid = cube_grid(-1.25, 0x1p-5, 80), moved = grid;
    const int by[3] = {3, -5, 2};
    for (int k = 0; k < 3; k++)
        moved.origin[k] -= by[k] * grid.voxel_size;
    uint32_t *here = bits_exact(&bench, &grid), *there = bits_exact(&bench, &moved);
    int wrong = 0, set = 0;
    for (int z = 5; z < 75; z++)
        for (int y = 5; y < 75; y++)
            for (int x = 5; x < 75; x++) {
                bool bit = bit_of(here, &grid, x, y, z);
                set += bit;
                wrong += bit != bit_of(there, &moved, x + by[0], y + by[1], z + by[2]);
            }
    cr_assert(set > 1000 && wrong == 0, "%d of %d voxels did not move", wrong, set);
    free(here);
    free(there);
}

// The rasterizer snaps corners to 1/256 pixel, so a voxel of its own may be beside the triangle by so much and its float rounding: 1/128.
static void check_raster(const char *scene, int resolution, double most_missing, double least_missing)
{
    Bench bench = bench_open(scene);
    VoxelGrid grid = scene_grid(bench.scene, resolution);
    uint32_t *exact = bits_exact(&bench, &grid), *raster = bits_raster(&bench, &grid);
    for (int z = 0; z < grid.size[2]; z++)
        for (int y = 0; y < grid.size[1]; y++)
            for (int x = 0; x < grid.size[0]; x++) {
                if (!bit_of(raster, &grid, x, y, z) || bit_of(exact, &grid, x, y, z))
                    continue;
                double gap = INFINITY;
                for (size_t t = 0; t < bench.mesh.triangle_count; t++) {
                    float corners[9];
                    for (int i = 0; i < 9; i++)
                        corners[i] =
                            bench.mesh
                                .positions[3 * bench.mesh.indices[3 * t + (size_t)i / 3] + (size_t)i % 3];
                    gap = fmin(gap, truth_voxel_gap(corners, &grid, (int[3]){x, y, z}));
                }
                cr_assert(gap <= 1.0 / 128.0, "%s: raster's voxel %d %d %d is %g voxels off", scene, x, y, z,
                          gap);
            }
    size_t words = grid_words(&grid);
    double missing = voxels_count(exact, raster, words) / voxels_count(exact, NULL, words);
    cr_assert(missing >= least_missing && missing <= most_missing, "%s: raster misses %g of the voxels",
              scene, missing);
    free(exact);
    free(raster);
}
// A plane of slope (a, b) to its dominant axis touches 1 + a + b voxels of a column and one is set: between nothing and 2/3 is missed.
Test(voxelization, raster_finds_exact_voxels_only_and_misses_many)
{
    check_raster("bunny", 64, 2.0 / 3.0, 0.3);
    gl_close();
    check_raster("cornell", 64, 0.1, 0.0);
}
// 3 of a column's voxels touch the oblique plane in its middle, and 4 on corners; 1 is set.
Test(voxelization, raster_misses_two_thirds_of_an_oblique_triangle)
{
    check_raster("oblique", 32, 0.77, 0.65);
}

Test(voxelization, small_and_large_triangles_are_treated_alike)
{
    Bench bench = bench_open("colonnade");
    VoxelGrid grid = scene_grid(bench.scene, 48);
    bench.voxelizer.small_side = 1e9f;
    uint32_t *small = bits_exact(&bench, &grid);
    cr_assert_eq(bench.lists.count[LIST_SMALL], bench.lists.triangle_count, "not all are small");
    bench.voxelizer.small_side = -1.0f;
    uint32_t *large = bits_exact(&bench, &grid);
    cr_assert_eq(bench.lists.count[LIST_SMALL], 0, "some are small");
    check_same(large, small, &grid, "large");
    free(small);
    free(large);
}

// However many undecided voxels the list holds, none is dropped: one too many, and all are decided at once. That comes first here, before a full list
// that could stand in for an empty one.
Test(voxelization, where_and_when_a_voxel_is_decided_changes_nothing)
{
    Bench bench =
        bench_open("oblique"); // its plane passes through voxels' corners, and no other triangle sets them
    VoxelGrid grid = scene_grid(bench.scene, 32);
    const uint32_t whole_list = bench.voxelizer.undecided_most;
    bench.voxelizer.undecided_most = 0;
    uint32_t *at_once = bits_exact(&bench, &grid);
    Voxels voxels = voxels_create(&grid, "undecided");
    uint32_t undecided = voxelize_list(&bench.voxelizer, &bench.gpu, &bench.lists, LIST_Z, &voxels);
    cr_assert(undecided > 1 && undecided < whole_list, "%u voxels are undecided", undecided);
    const uint32_t most[] = {undecided - 1, undecided, whole_list};
    for (int i = 0; i < 3; i++) {
        bench.voxelizer.undecided_most = most[i];
        uint32_t *bits = bits_exact(&bench, &grid);
        check_same(bits, at_once, &grid, "later");
        free(bits);
    }
    free(at_once);
}

// ---------------------------------------------------------------- what is left out

// A triangle beyond a face of a grid of 8 voxels, or in it, both ways.
static void check_outside(float x, bool outside, double voxels)
{
    Bench bench = bench_open(NULL);
    bench_add(&bench, vec3_make(x, 0, 0), vec3_make(x, 16, 0), vec3_make(x, 0, 16));
    bench_mesh(&bench);
    VoxelGrid grid = cube_grid(0.0, 1.0, 8);
    uint32_t *bits = bits_exact(&bench, &grid);
    cr_assert_eq(bench.lists.outside, outside, "x = %.9g: %u triangles outside", x, bench.lists.outside);
    cr_assert_eq(bench.lists.count[LIST_X], !outside, "x = %.9g: %u face x", x, bench.lists.count[LIST_X]);
    cr_assert_eq(voxels_count(bits, NULL, grid_words(&grid)), voxels, "x = %.9g", x);
    free(bits);
    gl_close();
}
Test(voxelization, a_triangle_outside_the_grid_is_left_out)
{
    check_outside(nextafterf(8, 9), true, 0);
    check_outside(-0x1p-100f, true, 0);
}
// Just inside the rule: leaving it out would lose a layer of 8 × 8 voxels.
Test(voxelization, a_triangle_in_the_grids_outer_face_is_not_left_out)
{
    check_outside(8, false, 64);
    check_outside(0, false, 64);
}
Test(voxelization, with_everything_no_triangle_is_left_out_and_the_voxels_are_the_same)
{
    shader_define_all("EVERYTHING", 1);
    check_outside(nextafterf(8, 9), false, 0);
    check_outside(-0x1p-100f, false, 0);
    check_outside(8, false, 64);
}

Test(voxelization, an_axis_that_nothing_faces_has_an_empty_list)
{
    Bench bench = bench_open("floor");
    VoxelGrid grid = scene_grid(bench.scene, 32);
    uint32_t *bits = bits_exact(&bench, &grid); // draws the empty lists too
    cr_assert(bench.lists.count[LIST_X] == 0 && bench.lists.count[LIST_Z] == 0 &&
                  bench.lists.count[LIST_SMALL] == 0,
              "the floor faces x or z");
    Voxels voxels = voxels_create(&grid, "y only");
    voxelize_list(&bench.voxelizer, &bench.gpu, &bench.lists, LIST_Y, &voxels);
    uint32_t *only = voxels_read(&voxels);
    check_same(only, bits, &grid, "y only");
    free(bits);
    free(only);
}
// One small triangle that faces x, and its list is needed: without it a voxel is lost.
Test(voxelization, an_axis_that_one_triangle_faces_is_not_left_out)
{
    Bench bench = bench_open("floor");
    bench_add(&bench, vec3_make(8, 3, 3), vec3_make(8.125f, 9, 3), vec3_make(8, 3, 9));
    bench_mesh(&bench);
    VoxelGrid grid = cube_grid(0.0, 1.0, 16);
    bench.voxelizer.small_side = 0.0f;
    uint32_t *bits = bits_exact(&bench, &grid);
    cr_assert_eq(bench.lists.count[LIST_X], 1, "%u triangles face x", bench.lists.count[LIST_X]);
    Voxels voxels = voxels_create(&grid, "without x");
    voxelize_list(&bench.voxelizer, &bench.gpu, &bench.lists, LIST_Y, &voxels);
    uint32_t *without = voxels_read(&voxels);
    cr_assert(voxels_count(bits, without, grid_words(&grid)) > 0, "the list of x changes nothing");
    free(bits);
    free(without);
}

// ---------------------------------------------------------------- regions and refusals

Test(voxelization, a_region_holds_its_part_of_the_scene)
{
    Bench bench = bench_open("cornell");
    VoxelGrid grid = voxelize_grid(bench.scene, vec3_make(0, 0, 0), vec3_make(0.5f, 0.25f, 1), 40);
    cr_assert(grid.size[2] == 40 && grid.size[0] < 30 && grid.size[1] < 20,
              "the region's grid is %d x %d x %d", grid.size[0], grid.size[1], grid.size[2]);
    uint32_t *exact = bits_exact(&bench, &grid), *truth = truth_voxels(&bench.mesh, &grid);
    cr_assert(bench.lists.outside > 0, "no triangle lies outside");
    check_same(exact, truth, &grid, "region");
    free(exact);
    free(truth);
}

static void create_too_large(void)
{
    gl_open(GL_PLATFORM_OSMESA, 16, 16, "test");
    VoxelGrid grid = cube_grid(0.0, 1.0, 65536);
    voxels_create(&grid, "too large");
}
Test(voxelization, a_grid_that_cannot_fit_names_the_bytes)
{
    Failure failure = failure_of(create_too_large);
    cr_assert_eq(failure.status, 1, "status %d", failure.status);
    cr_assert(strstr(failure.message, "35184372088832 bytes"), "65536³ bits are 2^45 bytes: %s",
              failure.message);
}
