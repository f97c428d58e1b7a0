// voxels: the volume as every pass sees it: a bit a voxel, and for each word column where its first set bit lies, so that a scan starts there or not at all.
#ifndef VOXELS_GLSL
#define VOXELS_GLSL
#include "common/epipolar.glsl"

//[voxels
layout(std430, binding = 1) buffer Voxels { uint voxels[]; };
layout(std430, binding = 2) buffer Columns { uint first[]; }; // α; epipolar_count.x: the word column is empty

// Mark what an occluder covers of a word: shadow begins here.
void voxels_set(int alpha, int theta, int word, uint bits)
{
    int column = epipolar_column(theta, word);
    atomicOr(voxels[epipolar_word(alpha, theta, word)], bits);
    if (first[column] > uint(alpha)) // reading is cheaper than an atomic, and most bits come late
        atomicMin(first[column], uint(alpha));
}
//]

#endif
