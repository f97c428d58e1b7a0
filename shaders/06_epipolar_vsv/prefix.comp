// Airlight up to each word of each of the grid's view rays (but for 1/D): lit bits of all words before, times their weights.
layout(local_size_x = 64) in;
#define EPIPOLE_AT_INFINITY (MAP_KIND == 2)
uniform vec3 extinction;
layout(binding = 4, rgba32ui) readonly uniform uimageBuffer texels;
layout(binding = 7, rgba32f) readonly uniform imageBuffer weights;
#include "06_epipolar_vsv/bytes.glsl"
#if GREY
layout(std430, binding = 6) writeonly buffer Prefixes { float prefixes[]; };
#else
layout(std430, binding = 6) writeonly buffer Prefixes { vec4 prefixes[]; };
#endif

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
