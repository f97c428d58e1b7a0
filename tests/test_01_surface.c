// 01 voxelization, surface methods: inclusions, closed forms, invariants, witnesses of what is left out.
#include "surface_bench.h"

// ---------------------------------------------------------------- which method finds what another does

Test(surface, methods_include_one_another_on_bunny)
{
    check_inclusions("bunny", 32);
}
Test(surface, methods_include_one_another_on_cornell)
{
    check_inclusions("cornell", 32);
}
Test(surface, methods_include_one_another_on_colonnade)
{
    check_inclusions("colonnade", 32);
}
// Nothing that a method misses may make these inclusions trivial: each set is smaller than the next.
Test(surface, three_axes_find_more_than_one_and_less_than_all)
{
    SurfaceBench bench = surface_bench_open("bunny");
    VoxelGrid grid = scene_grid(bench.on.scene, 32);
    double count[METHODS];
    for (int m = 0; m < METHODS; m++) {
        uint32_t *bits = bits_by(&bench, (Method)m, &grid);
        count[m] = bits_count(bits, &grid);
        free(bits);
    }
    cr_assert(count[RASTER] < count[SLICING] && count[SLICING] < count[MSAA] && count[MSAA] < count[EXACT],
              "raster %g, slicing %g, msaa %g, exact %g", count[RASTER], count[SLICING], count[MSAA],
              count[EXACT]);
    cr_assert(count[EXPANDED] < count[EXACT], "the printed expansion misses nothing");
}

// ---------------------------------------------------------------- closed forms

Test(surface, a_cube_a_quarter_inside_the_grid_fills_its_shell)
{
    check_cubes(4, 12);
}

// Faces in the planes 1 and N - 1 touch both sides. Only who decides by overlap finds both.
Test(surface, binary_marks_both_sides_of_a_face)
{
    SurfaceBench bench = surface_bench_open(NULL);
    for (int n = 5; n <= 64; n += n < 8 ? 1 : 14) {
        bench.on.mesh = (Mesh){0};
        mesh_add_box(&bench.on.mesh, vec3_make(1, 1, 1), vec3_make((float)n - 1, (float)n - 1, (float)n - 1),
                     0);
        bench_mesh(&bench.on);
        VoxelGrid grid = unit_grid(n, n, n);
        uint32_t *bits = bits_by(&bench, BINARY, &grid);
        cr_assert_eq(bits_count(bits, &grid), pow(n, 3) - pow(n - 4, 3), "N = %d: %g voxels", n,
                     bits_count(bits, &grid));
        free(bits);
        raster_mesh_delete(&bench.on.gpu);
    }
}

// Grids whose columns end within a word, a texel, a slab; and random triangles of every size and slope.
Test(surface, binary_is_exact_on_any_grid_and_slope)
{
    SurfaceBench bench = surface_bench_open(NULL);
    bench_add(&bench.on, vec3_make(-1, -1, 0.5f), vec3_make(4, -1, 0.5f), vec3_make(-1, 4, 0.75f));
    srand(7);
    for (int i = 0; i < 600; i++) {
        vec3 p[3] = {0};
        float length = powf(10.0f, 4.0f * (float)rand() / (float)RAND_MAX - 1.5f);
        for (int v = 0; v < 3; v++)
            for (int k = 0; k < 3; k++)
                p[v][k] = v == 0 ? 40.0f * (float)rand() / (float)RAND_MAX - 4.0f
                                 : p[0][k] + length * ((float)rand() / (float)RAND_MAX - 0.5f);
        if (i % 3 == 0)
            p[2] = p[1] + 1e-5f * (p[2] - p[1]); // a sliver
        if (i % 5 == 0)
            p[1][2] = p[0][2] + 1e4f * length; // nearly along z
        bench_add(&bench.on, p[0], p[1], p[2]);
    }
    bench_mesh(&bench.on);
    const int sizes[][3] = {{1, 1, 1}, {3, 50, 7}, {33, 5, 131}, {17, 31, 128}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        VoxelGrid grid = unit_grid(sizes[i][0], sizes[i][1], sizes[i][2]);
        uint32_t *binary = bits_by(&bench, BINARY, &grid), *exact = bits_by(&bench, EXACT, &grid);
        cr_assert(bits_count(exact, &grid) > 0, "grid %zu is empty", i);
        check_within(binary, exact, &grid, "binary in exact");
        check_within(exact, binary, &grid, "exact in binary");
        free(binary);
        free(exact);
    }
}

// ---------------------------------------------------------------- invariants

Test(surface, the_order_of_triangles_changes_nothing)
{
    SurfaceBench bench = surface_bench_open("colonnade");
    VoxelGrid grid = scene_grid(bench.on.scene, 32);
    uint32_t *before[METHODS];
    for (int m = 0; m < METHODS; m++)
        before[m] = bits_by(&bench, (Method)m, &grid);
    srand(3);
    for (size_t i = bench.on.mesh.triangle_count - 1; i > 0; i--) {
        size_t j = (size_t)rand() % (i + 1);
        for (int k = 0; k < 3; k++) {
            uint32_t swap = bench.on.mesh.indices[3 * i + (size_t)k];
            bench.on.mesh.indices[3 * i + (size_t)k] = bench.on.mesh.indices[3 * j + (size_t)k];
            bench.on.mesh.indices[3 * j + (size_t)k] = swap;
        }
    }
    bench_mesh(&bench.on);
    for (int m = 0; m < METHODS; m++) {
        uint32_t *after = bits_by(&bench, (Method)m, &grid);
        check_within(after, before[m], &grid, method_names[m]);
        check_within(before[m], after, &grid, method_names[m]);
        free(after);
        free(before[m]);
    }
}

Test(surface, the_number_of_threads_changes_nothing)
{
    cr_assert_eq(hash_with_threads("1", hash_of_methods, "bunny"),
                 hash_with_threads("2", hash_of_methods, "bunny"), "1 and 2 threads differ");
}

// ---------------------------------------------------------------- what is left out

// The same bits with and without leaving out, and how much was left out.
static void check_left_out(const char *scene, int resolution, int empty_slices, int layers)
{
    SurfaceBench bench = surface_bench_open(scene);
    VoxelGrid grid = scene_grid(bench.on.scene, resolution);
    const Method methods[] = {SLICING, PEELING};
    for (int i = 0; i < 2; i++) {
        uint32_t *less = bits_of(&bench, methods[i], &grid, resolution, false);
        int peeled = bench.peeled.layers[0] + bench.peeled.layers[1] + bench.peeled.layers[2];
        cr_assert(i == 0 || peeled == layers, "%s: %d layers", scene, peeled);
        uint32_t *all = bits_of(&bench, methods[i], &grid, resolution, true);
        peeled = bench.peeled.layers[0] + bench.peeled.layers[1] + bench.peeled.layers[2];
        cr_assert(i == 0 || peeled == grid.size[0] + grid.size[1] + grid.size[2],
                  "not every layer was tried");
        check_within(less, all, &grid, method_names[methods[i]]);
        check_within(all, less, &grid, method_names[methods[i]]);
        free(less);
        free(all);
    }
    cr_assert_eq(bench.empty_slices, empty_slices, "%s: %d of %d slices are empty", scene, bench.empty_slices,
                 bench.slices);
    gl_close();
}
// Three voxels on the diagonal: of 16 slices an axis 13 are empty. Two pixels an axis show a grain, one the tetrahedron's; no two of the three
// lie behind one another, so a layer holds all (nothing, where no pixel's centre is covered: then the first layer is the empty one).
Test(surface, empty_slices_and_layers_are_left_out)
{
    check_left_out("speck", 16, 3 * 13, 3);
}
// A cube fills all slices; along each axis a front, a back, and the empty layer that tells that there is no more.
Test(surface, a_full_slice_is_not_left_out)
{
    check_left_out("cube", 16, 0, 3 * 3);
}
// One layer less loses voxels: the rule stops at the first layer that is not needed.
Test(surface, peeling_a_layer_less_loses_voxels)
{
    SurfaceBench bench = surface_bench_open("cube");
    VoxelGrid grid = scene_grid(bench.on.scene, 16);
    uint32_t *two = bits_of(&bench, PEELING, &grid, 2, false),
             *one = bits_of(&bench, PEELING, &grid, 1, false);
    uint32_t *all = bits_by(&bench, PEELING, &grid);
    check_within(all, two, &grid, "the third layer");
    cr_assert(voxels_count(all, one, grid_words(&grid)) > 0, "the second layer adds nothing");
    free(one);
    free(two);
    free(all);
}
// A triangle that only just reaches into a slice makes it one that is drawn; and the slice holds a voxel.
Test(surface, a_slice_that_one_triangle_reaches_is_drawn)
{
    for (int reaches = 0; reaches < 2; reaches++) {
        SurfaceBench bench = surface_bench_open(NULL);
        float top = reaches ? 3.25f : 2.75f;
        bench_add(&bench.on, vec3_make(0, 0, 2.5f), vec3_make(8, 0, 2.5f), vec3_make(0, 8, top));
        bench_mesh(&bench.on);
        VoxelGrid grid = unit_grid(8, 8, 8);
        uint32_t *bits = bits_by(&bench, SLICING, &grid);
        uint32_t in_slice = 0;
        for (int i = 3 * 64; i < 4 * 64; i++)
            in_slice += bits[i >> 5] >> (i & 31) & 1;
        cr_assert_eq(bench.empty_slices, reaches ? 6 : 7, "%d slices are empty", bench.empty_slices);
        cr_assert_eq(in_slice > 0, reaches, "%u voxels in slice 3", in_slice);
        free(bits);
        gl_close();
    }
}

// ---------------------------------------------------------------- extreme meshes and grids

Test(surface, a_mesh_of_one_point_has_no_voxel)
{
    SurfaceBench bench = surface_bench_open("point");
    VoxelGrid grid = scene_grid(bench.on.scene, 16);
    for (int m = 0; m < METHODS; m++)
        cr_assert_eq(bits_count(bits_by(&bench, (Method)m, &grid), &grid), 0, "%s finds some",
                     method_names[m]);
}

static void check_extreme(const char *scene, int resolution, double voxels)
{
    SurfaceBench bench = surface_bench_open(scene);
    VoxelGrid grid = scene_grid(bench.on.scene, resolution);
    uint32_t *exact = bits_by(&bench, EXACT, &grid);
    cr_assert_eq(bits_count(exact, &grid), voxels, "%s: %g voxels", scene, bits_count(exact, &grid));
    for (int m = 0; m < METHODS; m++) {
        uint32_t *bits = bits_by(&bench, (Method)m, &grid);
        check_within(bits, exact, &grid, method_names[m]);
        if (m == BINARY)
            check_within(exact, bits, &grid, "exact in binary");
        free(bits);
    }
    free(exact);
    gl_close();
}
Test(surface, a_mesh_smaller_than_a_voxel_sets_one)
{
    check_extreme("speck", 16, 3);
    check_extreme("speck", 1, 1);
}
Test(surface, an_edge_along_a_line_of_the_grid_touches_all_round)
{
    check_extreme("edge", 16, 42);
}
Test(surface, a_beam_of_3_by_500_by_7_voxels_has_its_shell)
{
    check_extreme("beam", 500, 3 * 500 * 7 - 1 * 498 * 5);
}
