// Voxels from the light's depth map, one sample a light ray (θ, φ): what is nearest to the light is all that a scan needs (Wyman 2011, section 4.1.3).
layout(local_size_x = 64) in;
#define EPIPOLE_AT_INFINITY (MAP_KIND == 2)
#include "06_epipolar_vsv/voxels.glsl"
#include "06_epipolar_vsv/map.glsl"

//[resample
void main()
{
    ivec2 ray = ivec2(gl_GlobalInvocationID.xy); // (φ, θ)
    if (any(greaterThanEqual(ray, epipolar_count.zy)))
        return;
    float phi = epipolar_phi_at(float(ray.x) + 0.5), theta = epipolar_theta_at(float(ray.y) + 0.5);
    float hit = map_first_hit(theta, phi);
    if (isinf(hit))
        return;
    // A voxel stands for its middle: it is in shadow where the middle's α is not before the hit's.
    float place = ceil(epipolar_alpha_place(epipolar_alpha(phi, hit)) - 0.5);
    if (place < float(epipolar_count.x))
        voxels_set(int(max(place, 0.0)), ray.y, ray.x >> 5, 1u << (ray.x & 31));
}
//]
