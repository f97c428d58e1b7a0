// slices: of each θ, from which α on any of its light rays is in shadow, and from which on all are. Once scanned, shadow never ends along α; so these two
// numbers are the whole mip chain's answer to "is this block lit, or dark, throughout?".
#ifndef SLICES_GLSL
#define SLICES_GLSL

struct Slice { uint any, all; };
layout(std430, binding = 4) buffer Slices { Slice slices[]; };

void slices_note(int theta, int any_from, int all_from)
{
    atomicMin(slices[theta].any, uint(any_from));
    atomicMax(slices[theta].all, uint(all_from));
}

#endif
