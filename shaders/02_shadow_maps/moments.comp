// moments: the mean of distance and of its square over a box about each texel, in two passes: along x from the depth map, then along y. A sum over
// a box is a sum of sums over its rows, so that 2 n texels are read instead of n².
#include "02_shadow_maps/bounds.glsl"
#include "02_shadow_maps/map.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, rg32f) writeonly uniform image2DArray moments;
#if ALONG_Y
layout(binding = 1, rg32f) readonly uniform image2DArray source;
#elif LAYERS > 1
layout(binding = 1, r32f) readonly uniform image2DArray source;
#else
layout(binding = 1, r32f) readonly uniform image2D source;
#endif
layout(std430, binding = 0) readonly buffer AskedBounds { Bounds bounds[]; };
uniform vec2 depth_range; // metres
uniform float radius;     // texels, half the box's side

//[moments
vec2 moments_of(int layer, ivec2 texel)
{
    ivec3 at = map_texel(layer, texel, ivec2(map_size));
#if ALONG_Y
    return imageLoad(source, at).xy;
#else
#if LAYERS > 1
    float stored = imageLoad(source, at).x;
#else
    float stored = imageLoad(source, at.xy).x;
#endif
    // In [-1, 1], so that the square loses least; where there is nothing (+Inf), as far as the scene goes.
    float t = min(2.0 * (stored - depth_range.x) / (depth_range.y - depth_range.x) - 1.0, 1.0);
    return vec2(t, t * t);
#endif
}

void main()
{
    ivec3 at = ivec3(gl_GlobalInvocationID);
#if !EVERYTHING
    if (bounds[at.z].end_x == 0u)
        return; // no pixel will ask this layer
#endif
    if (any(greaterThanEqual(at.xy, ivec2(map_size))))
        return;
    const ivec2 along = ivec2(1 - ALONG_Y, ALONG_Y);
    int reach = int(ceil(radius - 0.5)); // the box cuts the texels at its ends
    vec2 sum = vec2(0.0);
    for (int k = -reach; k <= reach; k++)
        sum += clamp(radius + 0.5 - abs(float(k)), 0.0, 1.0) * moments_of(at.z, at.xy + k * along);
    imageStore(moments, at, vec4(sum / (2.0 * radius), 0.0, 0.0));
}
//]
