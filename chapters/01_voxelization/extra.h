// extra: how far from the surface does the farthest voxel lie that a method set and the truth does not?
#ifndef EXTRA_H
#define EXTRA_H

#include "truth.h"

// In voxels, by the truth's gap to each extra voxel's nearest triangle; 0 where no voxel is extra, INFINITY where the mesh is empty.
double extra_gap(const Mesh *mesh, const VoxelGrid *grid, const uint32_t *got, const uint32_t *truth);

#endif
