// solid_bench: what the tests of solids share: a scene or a mesh made here, and its voxels.
#ifndef SOLID_BENCH_H
#define SOLID_BENCH_H

#include "../chapters/01_voxelization/solid.h"
#include "../chapters/01_voxelization/solid_scenes.h"

#include <criterion/criterion.h>
#include <stdlib.h>
#include <string.h>

typedef struct Filled {
    SolidMesh mesh;
    SolidColumns columns[3];
    char *message;
    uint32_t *bits;
    double count;
    VoxelGrid grid;
} Filled;

static inline Scene *solid_bench_scene(void (*make)(Scene *scene, uint64_t seed))
{
    return scene_from(&(SceneKind){"made here", "", make}, 1);
}

// A context must be current. `small_side` 0: the usual.
static inline Filled solid_bench_fill(const Scene *scene, const VoxelGrid *grid, bool everything,
                                      float small_side)
{
    RasterMesh gpu = raster_mesh(scene);
    Solids solids = solids_open();
    if (small_side > 0)
        solids.small_side = small_side;
    Filled filled = {.mesh = solid_mesh_create(scene, &gpu), .grid = *grid};
    SolidWork work = solid_work_create(grid, &filled.mesh, everything);
    solid_voxelize(&solids, &filled.mesh, &work);
    for (int axis = 0; axis < 3; axis++)
        filled.columns[axis] = solid_columns(&work, axis);
    filled.message = solid_message(scene->name, &filled.mesh, &work);
    filled.bits = voxels_read(&work.result);
    filled.count = voxels_count(filled.bits, NULL, grid_words(grid));
    solid_work_delete(&work);
    solid_mesh_delete(&filled.mesh);
    raster_mesh_delete(&gpu);
    solids_close(&solids);
    return filled;
}

static inline void filled_free(Filled *filled)
{
    free(filled->bits);
    free(filled->message);
}

static inline bool filled_at(const Filled *filled, int x, int y, int z)
{
    const int *size = filled->grid.size;
    size_t i = ((size_t)z * (size_t)size[1] + (size_t)y) * (size_t)size[0] + (size_t)x;
    return filled->bits[i >> 5] >> (i & 31) & 1;
}

#endif
