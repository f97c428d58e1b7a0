// surface_bench: what the tests of chapter 01's surface methods share: a scene on the GPU, and its bits by each method.
#ifndef SURFACE_BENCH_H
#define SURFACE_BENCH_H

#include "../chapters/01_voxelization/surface.h"
#include "voxel_bench.h"

typedef enum Method { RASTER, THREEPASS, SLICING, PEELING, MSAA, EXPANDED, BINARY, EXACT, METHODS } Method;
static const char *const method_names[METHODS] = {"raster", "threepass", "slicing", "peeling",
                                                  "msaa",   "expanded",  "binary",  "exact"};

typedef struct SurfaceBench {
    Bench on;
    Surfaces surfaces;
    PeelCount peeled; // by the last PEELING
    int slices, empty_slices;
} SurfaceBench;

static inline SurfaceBench surface_bench_open(const char *name)
{
    Bench on = bench_open(name);
    return (SurfaceBench){.on = on, .surfaces = surfaces_open()};
}

// Cubic voxels of 1 m from the origin.
static inline VoxelGrid unit_grid(int x, int y, int z)
{
    return (VoxelGrid){{0, 0, 0}, 1, {x, y, z}};
}

static inline void draw_slicing(SurfaceBench *bench, bool everything, const Voxels *voxels)
{
    SliceLists lists = slice_lists_make(&bench->surfaces, &bench->on.gpu, &voxels->grid);
    bench->slices = lists.slices;
    bench->empty_slices = lists.empty;
    surface_slicing(&bench->surfaces, &bench->on.gpu, everything ? NULL : &lists, voxels);
    slice_lists_delete(&lists);
}

static inline void draw_binary(SurfaceBench *bench, const Voxels *voxels)
{
    BinaryGrid binary = binary_create(&voxels->grid);
    binary_draw(&bench->surfaces, &bench->on.gpu, &binary);
    binary_unpack(&bench->surfaces, &binary, voxels);
    binary_delete(&binary);
}

// `most_layers` and `everything` are peeling's and slicing's. New memory.
static inline uint32_t *bits_of(SurfaceBench *bench, Method method, const VoxelGrid *grid, int most_layers,
                                bool everything)
{
    if (method == EXACT)
        return bits_exact(&bench->on, grid);
    Voxels voxels = voxels_create(grid, method_names[method]);
    const Surfaces *surfaces = &bench->surfaces;
    const RasterMesh *mesh = &bench->on.gpu;
    if (method == RASTER)
        voxelize_raster(&bench->on.voxelizer, mesh, &voxels);
    else if (method == THREEPASS)
        surface_threepass(surfaces, mesh, &voxels);
    else if (method == SLICING)
        draw_slicing(bench, everything, &voxels);
    else if (method == PEELING)
        bench->peeled = surface_peeling(surfaces, mesh, most_layers, everything, &voxels);
    else if (method == MSAA)
        surface_msaa(surfaces, mesh, &voxels);
    else if (method == EXPANDED)
        surface_expanded(surfaces, mesh, &voxels);
    else
        draw_binary(bench, &voxels);
    uint32_t *bits = voxels_read(&voxels);
    voxels_delete(&voxels);
    gl_check(method_names[method]);
    return bits;
}

static inline uint32_t *bits_by(SurfaceBench *bench, Method method, const VoxelGrid *grid)
{
    return bits_of(bench, method, grid, voxelize_side(grid), false);
}

static inline double bits_count(const uint32_t *bits, const VoxelGrid *grid)
{
    return voxels_count(bits, NULL, grid_words(grid));
}

// Not one voxel of `part` may lie outside of `whole`.
static inline void check_within(const uint32_t *part, const uint32_t *whole, const VoxelGrid *grid,
                                const char *what)
{
    double outside = voxels_count(part, whole, grid_words(grid));
    cr_assert(outside == 0, "%s, %d voxels long: %g of %g voxels are not in the other set", what,
              voxelize_side(grid), outside, bits_count(part, grid));
}

// Every voxel of `part` that is not in `exact` lies within `most` voxels of a triangle.
static inline void check_band(const SurfaceBench *bench, const uint32_t *part, const uint32_t *exact,
                              const VoxelGrid *grid, double most, const char *what)
{
    for (size_t i = 0; i < grid_voxels(grid); i++) {
        if (!(part[i >> 5] & ~exact[i >> 5] & 1u << (i & 31)))
            continue;
        size_t width = (size_t)grid->size[0], height = (size_t)grid->size[1];
        int voxel[3] = {(int)(i % width), (int)(i / width % height), (int)(i / width / height)};
        double gap = INFINITY;
        for (size_t t = 0; t < bench->on.mesh.triangle_count && gap > most; t++) {
            float corners[9];
            for (size_t k = 0; k < 9; k++)
                corners[k] = bench->on.mesh.positions[3 * bench->on.mesh.indices[3 * t + k / 3] + k % 3];
            gap = fmin(gap, truth_voxel_gap(corners, grid, voxel));
        }
        cr_assert(gap <= most, "%s: voxel %d %d %d is %g voxels off", what, voxel[0], voxel[1], voxel[2],
                  gap);
    }
}

// raster ⊆ slicing = peeling ⊆ exact, threepass = raster, binary = exact.
static inline void check_inclusions(const char *scene, int resolution)
{
    SurfaceBench bench = surface_bench_open(scene);
    VoxelGrid grid = scene_grid(bench.on.scene, resolution);
    uint32_t *bits[METHODS];
    for (int m = 0; m < METHODS; m++) {
        bits[m] = bits_by(&bench, (Method)m, &grid);
        cr_assert(bits_count(bits[m], &grid) > resolution, "%s by %s is empty", scene, method_names[m]);
    }
    check_within(bits[RASTER], bits[THREEPASS], &grid, "raster in threepass");
    check_within(bits[THREEPASS], bits[RASTER], &grid, "threepass in raster");
    check_within(bits[RASTER], bits[SLICING], &grid, "raster in slicing");
    check_within(bits[SLICING], bits[PEELING], &grid, "slicing in peeling");
    check_within(bits[PEELING], bits[SLICING], &grid, "peeling in slicing");
    check_within(bits[BINARY], bits[EXACT], &grid, "binary in exact");
    check_within(bits[EXACT], bits[BINARY], &grid, "exact in binary");
    // The rasterizer snaps corners to 1/256 pixel, and a depth along a steep axis is off by the slope times that; more than half a voxel's
    // fraction of 1/128 beside the triangle, seen along its own axis, there is none. See the lesson, "The rounding band".
    for (int m = 0; m < BINARY; m++)
        check_band(&bench, bits[m], bits[EXACT], &grid, 1.0 / 128.0, method_names[m]);
    for (int m = 0; m < METHODS; m++)
        free(bits[m]);
    gl_close();
}

// A cube from 0.25 to N - 0.25 voxels touches the shell. Its faces lie inside pixels' columns, and a quarter of a pixel inside the outermost pixel's
// border, so the pixels' centres are covered: the rasterizer finds all of it, too, whichever way it goes about it. The expansion alone does not:
// it draws its corners' positions inwards.
static inline void check_cubes(int from, int step)
{
    SurfaceBench bench = surface_bench_open(NULL);
    for (int n = from; n <= 64; n += step) {
        float far = (float)n - 0.25f;
        bench.on.mesh = (Mesh){0};
        mesh_add_box(&bench.on.mesh, vec3_make(0.25f, 0.25f, 0.25f), vec3_make(far, far, far), 0);
        bench_mesh(&bench.on);
        VoxelGrid grid = unit_grid(n, n, n);
        double shell = pow(n, 3) - pow(n - 2, 3);
        for (int m = 0; m < METHODS; m++) {
            uint32_t *bits = bits_by(&bench, (Method)m, &grid);
            double got = bits_count(bits, &grid);
            cr_assert(m == EXPANDED ? got <= shell : got == shell, "%s, N = %d: %g of %g voxels",
                      method_names[m], n, got, shell);
            free(bits);
        }
        raster_mesh_delete(&bench.on.gpu);
    }
}

// For hash_with_threads: the bits of every method on a scene.
static inline uint64_t hash_of_methods(const char *scene)
{
    SurfaceBench bench = surface_bench_open(scene);
    VoxelGrid grid = scene_grid(bench.on.scene, 32);
    uint64_t hash = HASH_START;
    for (int m = 0; m < METHODS; m++)
        hash = hash_bytes(hash, bits_by(&bench, (Method)m, &grid), 4 * grid_words(&grid));
    return hash;
}

#endif
