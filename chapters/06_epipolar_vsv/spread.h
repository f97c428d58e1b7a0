// spread: how a grid's light rays are spread over φ: densely where the picture's shadows have borders. Tables for shaders/common/epipolar.glsl with WARP_TABLE.
#ifndef SPREAD_H
#define SPREAD_H

#include "gl.h"

enum { SPREAD_STEPS = 256 }; // WARP_STEPS there

size_t spread_bytes(int phi);
// Into such a buffer: voxels of equal width.
void spread_even(GLuint table, int phi);
// By the weight of the borders in each of SPREAD_STEPS even steps of φ. None: even.
void spread_set(GLuint table, int phi, const uint32_t *weight);

#endif
