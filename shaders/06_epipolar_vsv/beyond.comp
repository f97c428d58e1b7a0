// What of each ray lies beyond the grid's last φ, where light rays miss the scene's box: lit, so that shadow rays need not ask.
#include "common/airlight_ray.glsl"
#include "06_epipolar_vsv/query.glsl"
#include "06_epipolar_vsv/stretch.glsl"

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    Ray ray = ray_of(pixel);
    if (!ray_needed(pixel, ray))
        return;
    Query query = query_of(ray);
    float last = epipolar_phi_at(float(epipolar_count.z));
    if (query.to > last)
        ray_store(pixel, ray, stretch(ray, clamp(epipolar_along(query.alpha, last), ray.from, ray.to), ray.to), 0u);
}
