// visibility: how much of the light reaches each pixel of the G-buffer, 0 to 1, through a depth map; -1 where the pixel asks nothing.
#include "02_shadow_maps/receiver.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, r32f) writeonly uniform image2D visibility;
#if LAYERS > 1
layout(binding = 3, r32f) readonly uniform image2DArray depth_map;
#else
layout(binding = 3, r32f) readonly uniform image2D depth_map;
#endif
layout(binding = 4, rg32f) readonly uniform image2DArray moments_map;

#define NONE 0
#define CONSTANT 1
#define SLOPE 2
#define NORMAL 3
#define NEAREST 0
#define PCF 1
#define VARIANCE 2
uniform int bias_kind, filter_kind;
uniform float bias_size; // metres (constant) or texels (slope, normal)
uniform float radius;    // texels: half the side of the filter's box

// A distance computed twice, for the map and here, differs by some units in the last place; the normal offset leaves no other bias where
// the light falls in straight.
const float ROUNDING = 4e-6;

//[fetch
float map_load(int layer, ivec2 texel)
{
#if LAYERS > 1
    return imageLoad(depth_map, map_texel(layer, texel, imageSize(depth_map).xy)).x;
#else
    return imageLoad(depth_map, map_texel(layer, texel, imageSize(depth_map)).xy).x;
#endif
}
//]

//[nearest
float lit_nearest(Place place, vec2 size, float nearer)
{
    float stored = map_load(place.layer, shadow_texel(place.at, ivec2(size)));
    return float(nearer <= stored);
}
//]

//[pcf
// The share of a box of 2 · radius texels about the place whose texels are lit: the box cuts those on its border.
float lit_pcf(Place place, vec2 size, float nearer)
{
    vec2 at = (0.5 * place.at + 0.5) * size, lower = at - radius, upper = at + radius;
    ivec2 first = ivec2(floor(lower)), last = ivec2(floor(upper));
    float lit = 0.0, all = 0.0;
    for (int y = first.y; y <= last.y; y++)
        for (int x = first.x; x <= last.x; x++) {
            vec2 texel = vec2(x, y);
            vec2 covered = min(texel + 1.0, upper) - max(texel, lower);
            all += covered.x * covered.y;
            lit += covered.x * covered.y * float(nearer <= map_load(place.layer, ivec2(x, y)));
        }
    return lit / all; // exactly 1 where all is lit, however the parts were rounded
}
//]

uniform vec2 depth_range;        // metres: nearest and farthest of the scene's box; the moments are of distances mapped to [-1, 1]
uniform float minimum_variance;  // m²
uniform float bleeding;          // the share of the bound that is taken for bleeding light

//[variance
// The mean of distances and of their squares, between the four texels about the place.
vec2 moments_at(Place place, vec2 size)
{
    vec2 at = (0.5 * place.at + 0.5) * size - 0.5;
    ivec2 texel = ivec2(floor(at));
    vec2 part = at - vec2(texel), sum = vec2(0.0);
    for (int k = 0; k < 4; k++) {
        ivec2 corner = ivec2(k & 1, k >> 1);
        vec2 weight = mix(1.0 - part, part, vec2(corner));
        sum += weight.x * weight.y * imageLoad(moments_map, map_texel(place.layer, texel + corner, ivec2(size))).xy;
    }
    return sum;
}

// Chebyshev's inequality: of any distances with this mean and variance, at most this share lies at t or beyond.
float chebyshev(float mean, float variance, float t)
{
    return t <= mean ? 1.0 : variance / (variance + (t - mean) * (t - mean));
}

float lit_variance(Place place, vec2 size, float nearer)
{
    float half_range = 0.5 * (depth_range.y - depth_range.x);
    float t = clamp((nearer - depth_range.x) / half_range - 1.0, -1.0, 1.0);
    vec2 moments = moments_at(place, size);
    float variance = max(moments.y - moments.x * moments.x, minimum_variance / (half_range * half_range));
    return clamp((chebyshev(moments.x, variance, t) - bleeding) / (1.0 - bleeding), 0.0, 1.0);
}
//]

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    Receiver receiver;
    if (!receiver_find(pixel, receiver)) {
        imageStore(visibility, pixel, vec4(-1.0)); // stores outside the image do nothing
        return;
    }
    //[bias
    // A filter reads texels up to (radius + ½)·√2 from the place, so its surface is met that much nearer; a single texel's half diagonal
    // is what shadow_bias holds for.
    float width = filter_kind == NEAREST ? 1.0 : 2.0 * radius + 1.0;
    vec3 point = receiver.point;
    Place place = map_place(point);
    float bias = 0.0;
    if (bias_kind == CONSTANT)
        bias = bias_size;
    else if (bias_kind == SLOPE)
        bias = bias_size * shadow_bias(width * place.texel, receiver.cosine);
    else if (bias_kind == NORMAL) {
        float sine = sqrt(max(0.0, 1.0 - receiver.cosine * receiver.cosine));
        point += receiver.normal * (bias_size * width * place.texel * sine);
        place = map_place(point);
        bias = ROUNDING * length(point);
    }
    float nearer = map_distance(point) - bias;
    //]
#if LAYERS > 1
    vec2 size = vec2(imageSize(depth_map).xy);
#else
    vec2 size = vec2(imageSize(depth_map));
#endif
    float lit;
    if (filter_kind == NEAREST)
        lit = lit_nearest(place, size, nearer);
    else if (filter_kind == PCF)
        lit = lit_pcf(place, size, nearer);
    else
        lit = lit_variance(place, size, nearer);
#if SHAPE == DIRECTIONAL
    if (any(greaterThan(abs(place.at), vec2(1.0))))
        lit = 1.0; // beside the map, which covers all that can cast
#endif
    imageStore(visibility, pixel, vec4(lit));
}
