// voxel_bench: what the tests of chapter 01 share: a scene on the GPU, the voxelizer, bits by each method and by the truth.
#ifndef VOXEL_BENCH_H
#define VOXEL_BENCH_H

#include "../chapters/01_voxelization/scenes.h"
#include "../chapters/01_voxelization/voxelize.h"
#include "threads_bench.h"
#include "truth.h"

#include <criterion/criterion.h>
#include <stdlib.h>
#include <string.h>

typedef struct Bench {
    Mesh mesh; // the scene's, or one made here
    Scene *scene;
    RasterMesh gpu;
    Voxelizer voxelizer;
    TriangleLists lists;
} Bench;

static inline void bench_mesh(Bench *bench)
{
    Scene scene = {.mesh = bench->mesh};
    if (bench->scene)
        scene = *bench->scene;
    scene.mesh = bench->mesh;
    bench->gpu = raster_mesh(&scene);
    bench->lists = triangle_lists_create(&bench->gpu);
}

// A built-in scene or one of the chapter's own; NULL: no triangle yet (bench_add, then bench_mesh).
static inline Bench bench_open(const char *name)
{
    gl_open(GL_PLATFORM_OSMESA, 16, 16, "test");
    Bench bench = {.voxelizer = voxelizer_open()};
    const SceneKind *kind = voxel_scenes;
    while (name && kind->name && strcmp(kind->name, name) != 0)
        kind++;
    if (name) {
        bench.scene = kind->name ? scene_from(kind, 1) : scene_open(name, 1);
        bench.mesh = bench.scene->mesh;
        bench_mesh(&bench);
    }
    return bench;
}

static inline void bench_add(Bench *bench, vec3 a, vec3 b, vec3 c)
{
    vec3 none = {0};
    uint32_t first = mesh_add_vertex(&bench->mesh, a, none);
    mesh_add_triangle(&bench->mesh, first, mesh_add_vertex(&bench->mesh, b, none),
                      mesh_add_vertex(&bench->mesh, c, none), 0);
}

// Cubic voxels of `size` metres from `origin` on each axis.
static inline VoxelGrid cube_grid(double origin, double size, int side)
{
    return (VoxelGrid){{origin, origin, origin}, size, {side, side, side}};
}

static inline uint32_t *bits_exact(Bench *bench, const VoxelGrid *grid)
{
    Voxels voxels = voxels_create(grid, "exact");
    voxelize_sort(&bench->voxelizer, &bench->gpu, grid, &bench->lists);
    for (int list = 0; list < LIST_COUNT; list++)
        voxelize_list(&bench->voxelizer, &bench->gpu, &bench->lists, list, &voxels);
    uint32_t *bits = voxels_read(&voxels);
    voxels_delete(&voxels);
    gl_check("bits_exact");
    return bits;
}

static inline uint32_t *bits_raster(Bench *bench, const VoxelGrid *grid)
{
    Voxels voxels = voxels_create(grid, "raster");
    voxelize_raster(&bench->voxelizer, &bench->gpu, &voxels);
    uint32_t *bits = voxels_read(&voxels);
    voxels_delete(&voxels);
    gl_check("bits_raster");
    return bits;
}

static inline bool bit_of(const uint32_t *bits, const VoxelGrid *grid, int x, int y, int z)
{
    size_t i = ((size_t)z * (size_t)grid->size[1] + (size_t)y) * (size_t)grid->size[0] + (size_t)x;
    return bits[i >> 5] >> (i & 31) & 1;
}

// Not one voxel may differ: both sides decide in double, and where they could differ is narrower than a rounding.
static inline void check_same(const uint32_t *got, const uint32_t *expected, const VoxelGrid *grid,
                              const char *what)
{
    size_t words = grid_words(grid);
    double missing = voxels_count(expected, got, words), extra = voxels_count(got, expected, words);
    cr_assert(missing == 0 && extra == 0, "%s, %d voxels long: %g of %g voxels are missing, %g are extra",
              what, grid->size[0], missing, voxels_count(expected, NULL, words), extra);
}

#endif
