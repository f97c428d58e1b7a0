// show: a depth map or a visibility as grey, for looking at. All layers of a map stand side by side, a row of three.
#include "02_shadow_maps/map.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, rgba32f) writeonly uniform image2D picture;
#if LAYERS > 1
layout(binding = 1, r32f) readonly uniform image2DArray source;
#else
layout(binding = 1, r32f) readonly uniform image2D source;
#endif
uniform vec2 range; // what is white and what is black
uniform vec3 beside; // the colour of what is no number in the range: nothing hit, nothing asked

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(picture);
    if (any(greaterThanEqual(pixel, size)))
        return;
    const ivec2 tiles = LAYERS == 6 ? ivec2(3, 2) : ivec2(LAYERS, 1);
    int side = min(size.x / tiles.x, size.y / tiles.y);
    ivec2 from_corner = pixel - (size - side * tiles) / 2;
    vec3 shown = beside;
    if (side > 0 && all(greaterThanEqual(from_corner, ivec2(0))) && all(lessThan(from_corner, side * tiles))) {
        ivec2 tile = from_corner / side;
        vec2 place = (vec2(from_corner - tile * side) + 0.5) / float(side);
        int layer = tile.y * tiles.x + tile.x;
#if LAYERS > 1
        float value = imageLoad(source, ivec3(ivec2(place * vec2(imageSize(source).xy)), layer)).x;
#else
        float value = imageLoad(source, ivec2(place * vec2(imageSize(source)))).x;
#endif
        if (!isinf(value))
            shown = vec3(clamp((range.y - value) / (range.y - range.x), 0.0, 1.0));
    }
    imageStore(picture, pixel, vec4(shown, 1.0));
}
