// triangles_vsv: the voxelizations of triangles.h for a voxelized shadow volume as vsv.h holds it.
#include "triangles_vsv.h"

#include <stdlib.h>
#include <string.h>

bool triangles_method(const char *method)
{
    return strcmp(method, "conservative") == 0 || strcmp(method, "flat") == 0 || strcmp(method, "solid") == 0;
}

TriangleSplits triangles_splits(const char *split)
{
    return strcmp(split, "all") == 0       ? SPLIT_ALL
           : strcmp(split, "wrap") == 0    ? SPLIT_WRAP
           : strcmp(split, "epipole") == 0 ? SPLIT_EPIPOLE
                                           : SPLIT_NONE;
}

// The volume's slices where they are not even; NULL where they are. New memory.
static float *borders_of(const Vsv *vsv)
{
    if (strcmp(vsv->settings.slices, "pixel") != 0)
        return NULL;
    const size_t count = (size_t)vsv->settings.theta + 1;
    float *borders = memory_new(count, sizeof *borders, "borders of slices");
    gl_buffer_read(vsv->borders, 0, count * sizeof *borders, borders);
    return borders;
}

void triangles_vsv_list(Triangles *triangles, const RasterMesh *mesh, const Vsv *vsv, const Light *light)
{
    float *borders = borders_of(vsv);
    const TrianglesGrid grid = {&vsv->frame, &vsv->range, light, borders,
                                strcmp(vsv->settings.warp, "square") == 0};
    triangles_aim(triangles, &grid);
    triangles_list(triangles, mesh, &grid);
    free(borders);
}

void triangles_vsv_fill(const Triangles *triangles, const RasterMesh *mesh, const Vsv *vsv,
                        const Light *light)
{
    const TrianglesGrid grid = {&vsv->frame, &vsv->range, light, NULL,
                                strcmp(vsv->settings.warp, "square") == 0};
    triangles_fill(triangles, mesh, &grid, vsv->voxels, vsv->first);
}
