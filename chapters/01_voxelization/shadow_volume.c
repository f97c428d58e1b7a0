// shadow_volume: see shadow_volume.h. The scan is shaders/01_voxelization/scan.comp, which fills solids as well.
#include "shadow_volume.h"

ShadowScan shadow_scan_open(void)
{
    return (ShadowScan){shader_open("shadow volume", NULL, "01_voxelization/scan.comp")};
}

void shadow_scan_close(ShadowScan *shadow_scan)
{
    shader_close(shadow_scan->scan);
}

void shadow_volume_find(const ShadowScan *shadow_scan, const Voxels *in, int axis, bool against,
                        const Voxels *shadow)
{
    const int *size = in->grid.size;
    voxels_clear(shadow);
    shader_use(shadow_scan->scan);
    shader_set_ivec3(shadow_scan->scan, "grid_size", size);
    shader_set_int(shadow_scan->scan, "axis", axis);
    shader_set_int(shadow_scan->scan, "backwards", against);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, in->words);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, shadow->words);
    // rows along x; else 32 columns that begin side by side
    uint32_t heads = axis == 0 ? (uint32_t)size[1] : (uint32_t)(size[0] + 31) / 32;
    voxelize_dispatch(heads * (uint32_t)(axis == 2 ? size[1] : size[2]));
    gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}
