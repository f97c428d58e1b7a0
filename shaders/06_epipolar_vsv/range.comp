// The least and greatest φ that any pixel's ray reaches where light can be (Wyman 2011, section 4.3): of surfaces, and of the sky, whose rays go on towards π - α.
// Beside it: how near the nearest surface is.
#include "common/airlight_ray.glsl"
#include "06_epipolar_vsv/query.glsl"
layout(std430, binding = 5) buffer Range { uint phi_least, phi_most, nearest; }; // positive floats are in order as integers

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    Ray ray = ray_of(pixel);
    if (!ray_needed(pixel, ray))
        return;
    uint surface = floatBitsToUint(imageLoad(distances, pixel).x);
    if (surface < nearest) // reading is cheaper than an atomic, and what most rays say is known already
        atomicMin(nearest, surface);
    vec2 alpha = vec2(length(cross(epipolar_axis, ray.direction)), dot(epipolar_axis, ray.direction));
    if (ray.inside > 0.0) {
        uint least = floatBitsToUint(max(epipolar_phi(alpha, ray.from), 0.0)), most = floatBitsToUint(max(epipolar_phi(alpha, ray.to), 0.0));
        if (least < phi_least)
            atomicMin(phi_least, least);
        if (most > phi_most)
            atomicMax(phi_most, most);
    }
}
