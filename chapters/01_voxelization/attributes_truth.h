// attributes_truth: the means that attributes.h's storages are judged by: in double, over the fragments that truth_voxels finds of each triangle alone.
#ifndef ATTRIBUTES_TRUTH_H
#define ATTRIBUTES_TRUTH_H

#include "attributes.h"
#include "truth.h"

typedef struct TrueMean {
    double fragments, albedo[3], normal[3];
} TrueMean;
// Of each bit that truth_voxels sets in this grid, in the bits' order, in new memory.
TrueMean *attributes_truth(const Scene *scene, const VoxelGrid *grid, size_t *count);

// How far off the albedos are that a storage holds, in steps of a display (1/255): over all components of all voxels.
typedef struct AttributesError {
    double mean, worst, bias; // bias: the mean of got − true, below 0 where voxels are too dark
} AttributesError;
// `averaged`: of listing 4.9's averages; else of the sums. Infinite where other voxels are stored than the truth has.
AttributesError attributes_error(const Scene *scene, const Attributes *stored, bool averaged);

#endif
