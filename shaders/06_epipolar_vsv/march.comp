// Brute force for a textured light: as many lookups in the map and in the texture a ray as you like, at equal steps of φ (which is equiangular sampling).
#include "common/airlight_ray.glsl"
#include "06_epipolar_vsv/query.glsl"
#include "06_epipolar_vsv/sample.glsl"
uniform int steps;

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    Ray ray = ray_of(pixel);
    if (!ray_needed(pixel, ray))
        return;
    Query query = query_of(ray);
    float width = (query.to - query.from) / float(steps);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < steps; i++) {
        float phi = query.from + (float(i) + 0.5) * width;
        sum += ray_lit(ray, epipolar_along(query.alpha, phi)) * sample_phi(ray, query, phi) * light_texture(query.theta, phi);
    }
    ray_store(pixel, ray, sum * width, uint(steps));
}
