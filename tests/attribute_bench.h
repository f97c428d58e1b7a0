// attribute_bench: what the tests of attributes share: a scene on the GPU, its voxels found and numbered.
#ifndef ATTRIBUTE_BENCH_H
#define ATTRIBUTE_BENCH_H

#include "../chapters/01_voxelization/attributes.h"

#include <criterion/criterion.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct Bench {
    Scene *scene;
    RasterMesh gpu;
    Voxelizer voxelizer;
    Attributer attributer;
    TriangleLists lists;
    Voxels voxels;
    Attributes attributes;
} Bench;

static inline void make_nothing(Scene *scene, uint64_t seed)
{
    (void)scene, (void)seed;
}

static inline Scene *open_empty(void)
{
    gl_open(GL_PLATFORM_OSMESA, 16, 16, "test");
    return scene_from(&(SceneKind){"made here", "", make_nothing}, 1);
}

// Find the scene's voxels and number them. `small_side` 0: the usual.
static inline Bench bench_open(Scene *scene, const VoxelGrid *grid, float small_side)
{
    Bench bench = {.scene = scene,
                   .gpu = raster_mesh(scene),
                   .voxelizer = voxelizer_open(),
                   .attributer = attributer_open(),
                   .voxels = voxels_create(grid, "voxels")};
    if (small_side > 0)
        bench.voxelizer.small_side = small_side;
    bench.lists = triangle_lists_create(&bench.gpu);
    voxelize_exact(&bench.voxelizer, &bench.gpu, &bench.lists, &bench.voxels);
    bench.attributes = attributes_rank(&bench.attributer, &bench.voxels);
    return bench;
}

static inline Fragments fragments_of(const Bench *bench)
{
    return (Fragments){&bench->voxelizer, &bench->gpu, &bench->lists};
}

static inline void bench_close(Bench *bench)
{
    attributes_delete(&bench->attributes);
    voxels_delete(&bench->voxels);
    triangle_lists_delete(&bench->lists);
    attributer_close(&bench->attributer);
    voxelizer_close(&bench->voxelizer);
    raster_mesh_delete(&bench->gpu);
}

static inline void add_triangle(Scene *scene, vec3 a, vec3 b, vec3 c, uint32_t material)
{
    const vec3 none = {0};
    uint32_t first = mesh_add_vertex(&scene->mesh, a, none);
    mesh_add_triangle(&scene->mesh, first, mesh_add_vertex(&scene->mesh, b, none),
                      mesh_add_vertex(&scene->mesh, c, none), material);
}

// Rounded to steps of 1/1023 and 1/511 each fragment is off by half a step at most, and so is their mean; float32 adds 1e-6.
static const double ALBEDO_OFF = 0.5 / 1023 + 1e-6, NORMAL_OFF = 0.5 / 511 + 1e-6;

#endif
