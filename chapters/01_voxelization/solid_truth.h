// solid_truth: which voxels are inside, and which in shadow, without a scan and without a column: by Embree's rays from every centre, and voxel by voxel.
#ifndef SOLID_TRUTH_H
#define SOLID_TRUTH_H

#include "truth.h"

// Bits as grid_words says, in new memory. A centre is inside where most of five oblique rays from it cross the surface an odd number of times: of a closed
// mesh that is so for all five, but for one that passes an edge. (Of a mesh with holes it is a guess like any other.)
uint32_t *solid_truth(const Mesh *mesh, const VoxelGrid *grid);

// Of these bits: those at or behind a set one, for light that travels along an axis ("x", "-x", …), in new memory.
uint32_t *shadow_truth(const uint32_t *bits, const VoxelGrid *grid, const char *axis);

#endif
