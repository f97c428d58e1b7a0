// Airlight up to each word of each of the grid's view rays (but for 1/D): lit bits of all words before, times their weights.
layout(local_size_x = 64) in;
#define EPIPOLE_AT_INFINITY (MAP_KIND == 2)
uniform vec3 extinction;
#include "06_epipolar_vsv/weight.glsl"
layout(binding = 4, rgba32ui) readonly uniform uimageBuffer texels;
#if GREY
layout(binding = 0, rgba32f) readonly uniform imageBuffer weights; // four bytes a texel
layout(std430, binding = 6) writeonly buffer Prefixes { float prefixes[]; };
#else
layout(binding = 0, rgba32f) readonly uniform imageBuffer weights; // a byte a texel
layout(std430, binding = 6) writeonly buffer Prefixes { vec4 prefixes[]; };
#endif

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

//[prefix
void main()
{
    ivec2 row = ivec2(gl_GlobalInvocationID.yx); // (α, θ)
    if (row.y >= epipolar_count.y)
        return;
    Weight sum = Weight(0.0);
    int words = epipolar_row_words(), first = epipolar_word(row.x, row.y, 0);
    for (int quarter = 0; quarter < words; quarter += 4) {
        uvec4 texel = imageLoad(texels, (first + quarter) >> 2);
        for (int k = 0; k < 4; k++) {
            prefixes[first + quarter + k] = weight_store(sum);
            sum += weighted(byte_counts(~texel[k]), row.x * words + quarter + k);
        }
    }
}
//]
