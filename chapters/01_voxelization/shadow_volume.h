// shadow_volume: which voxels are in shadow of a light that shines along an axis? Those with a set voxel at or before them: a prefix OR
// along the axis (Wyman 2011, section 2 and figure 2, in Cartesian space). Of a conservative grid it holds every shadowed point, and the surface
// itself; of a solid, the voxels whose centres are shadowed.
#ifndef SHADOW_VOLUME_H
#define SHADOW_VOLUME_H

#include "voxelize.h"

typedef struct ShadowScan {
    Shader *scan;
} ShadowScan;
ShadowScan shadow_scan_open(void);
void shadow_scan_close(ShadowScan *shadow_scan);

// The light travels along axis 0 x, 1 y, 2 z, or against it. `shadow` has the grid of `in` and is another buffer; what it held is lost.
void shadow_volume_find(const ShadowScan *shadow_scan, const Voxels *in, int axis, bool against,
                        const Voxels *shadow);

#endif
