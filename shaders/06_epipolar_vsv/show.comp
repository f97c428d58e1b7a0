// The volume laid flat, as Wyman 2011 shows it in figure 6: α to the right, a slice θ a row, as bright as voxels are set.
layout(local_size_x = 8, local_size_y = 8) in;
#include "common/epipolar.glsl"
layout(binding = 0, rgba32f) writeonly uniform image2D picture;
layout(binding = 4, rgba32ui) readonly uniform uimageBuffer texels;

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(picture);
    if (any(greaterThanEqual(pixel, size)))
        return;
    ivec2 row = min(pixel * epipolar_count.xy / size, epipolar_count.xy - 1);
    int set = 0;
    for (int quarter = 0; quarter < epipolar_count.z / 128; quarter++) {
        ivec4 bits = bitCount(imageLoad(texels, epipolar_word(row.x, row.y, 4 * quarter) >> 2));
        set += bits.x + bits.y + bits.z + bits.w;
    }
    float share = float(set) / float(epipolar_count.z);
    imageStore(picture, pixel, vec4(share, share * share, 0.25 * float(set > 0), 1.0));
}
