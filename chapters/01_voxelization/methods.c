// methods: see methods.h.
#include "methods.h"

#include <string.h>

static MethodWork find_slicing(const Surfaces *surfaces, const RasterMesh *mesh, bool everything,
                               const Voxels *voxels)
{
    if (everything) {
        surface_slicing(surfaces, mesh, NULL, voxels);
        return (MethodWork){"slices", 0, voxels->grid.size[0] + voxels->grid.size[1] + voxels->grid.size[2]};
    }
    SliceLists lists = slice_lists_make(surfaces, mesh, &voxels->grid);
    surface_slicing(surfaces, mesh, &lists, voxels);
    MethodWork work = {"slices", lists.empty, lists.slices};
    slice_lists_delete(&lists);
    return work;
}

static MethodWork find_peeling(const Surfaces *surfaces, const RasterMesh *mesh, bool everything,
                               const Voxels *voxels)
{
    const int *size = voxels->grid.size;
    PeelCount peeled = surface_peeling(surfaces, mesh, voxelize_side(&voxels->grid), everything, voxels);
    double of = size[0] + size[1] + size[2];
    return (MethodWork){"layers", of - (peeled.layers[0] + peeled.layers[1] + peeled.layers[2]), of};
}

static MethodWork find_binary(const Surfaces *surfaces, const RasterMesh *mesh, const Voxels *voxels)
{
    BinaryGrid binary = binary_create(&voxels->grid);
    binary_draw(surfaces, mesh, &binary);
    binary_unpack(surfaces, &binary, voxels);
    binary_delete(&binary);
    return (MethodWork){0};
}

//[methods
MethodWork method_find(const char *method, const Voxelizer *voxelizer, const Surfaces *surfaces,
                       const RasterMesh *mesh, bool everything, const Voxels *voxels)
{
    voxels_clear(voxels);
    if (strcmp(method, "slicing") == 0)
        return find_slicing(surfaces, mesh, everything, voxels);
    if (strcmp(method, "peeling") == 0)
        return find_peeling(surfaces, mesh, everything, voxels);
    if (strcmp(method, "binary") == 0)
        return find_binary(surfaces, mesh, voxels);
    if (strcmp(method, "threepass") == 0)
        surface_threepass(surfaces, mesh, voxels);
    else if (strcmp(method, "msaa") == 0)
        surface_msaa(surfaces, mesh, voxels);
    else if (strcmp(method, "expanded") == 0)
        surface_expanded(surfaces, mesh, voxels);
    else if (strcmp(method, "raster") == 0)
        voxelize_raster(voxelizer, mesh, voxels);
    else
        fail_work("no surface method is named %s", method);
    return (MethodWork){0};
}
//]

static const GLenum counted[] = {GL_FRAGMENT_SHADER_INVOCATIONS_ARB, GL_COMPUTE_SHADER_INVOCATIONS_ARB};

MethodCounter method_count_begin(void)
{
    MethodCounter counter;
    gl.GenQueries(2, counter.queries); // Mesa 22.3 refuses these targets to CreateQueries
    for (int i = 0; i < 2; i++)
        gl.BeginQuery(counted[i], counter.queries[i]);
    return counter;
}

void method_count_end(MethodCounter *counter, double *fragments, double *invocations)
{
    double *const values[] = {fragments, invocations};
    for (int i = 0; i < 2; i++) {
        GLuint64 value = 0;
        gl.EndQuery(counted[i]);
        gl.GetQueryObjectui64v(counter->queries[i], GL_QUERY_RESULT, &value);
        *values[i] = (double)value;
    }
    gl.DeleteQueries(2, counter->queries);
}
