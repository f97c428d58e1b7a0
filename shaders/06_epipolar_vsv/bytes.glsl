// bytes: what the lit bits of a word weigh. Weights are of eight neighbours along φ, a byte: in a grey medium four of them a texel of `weights`, a word's; else
// a texel each. Comes after an image `weights`.
#ifndef BYTES_GLSL
#define BYTES_GLSL
#include "06_epipolar_vsv/weight.glsl"

//[byte_counts
// Bits set in each byte: pairs, fours, bytes, as every bit count begins; the sum of the four that usually follows is what we leave out.
vec4 byte_counts(uint bits)
{
    bits -= (bits >> 1) & 0x55555555u;
    bits = (bits & 0x33333333u) + ((bits >> 2) & 0x33333333u);
    bits = (bits + (bits >> 4)) & 0x0f0f0f0fu;
    return vec4(bits & 255u, (bits >> 8) & 255u, (bits >> 16) & 255u, bits >> 24);
}
//]

Weight weighted(vec4 counts, int word)
{
#if GREY
    return 0.125 * dot(counts, imageLoad(weights, word));
#else
    return 0.125 * (counts.x * imageLoad(weights, 4 * word).rgb + counts.y * imageLoad(weights, 4 * word + 1).rgb +
                    counts.z * imageLoad(weights, 4 * word + 2).rgb + counts.w * imageLoad(weights, 4 * word + 3).rgb);
#endif
}

#endif
