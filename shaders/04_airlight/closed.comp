// The closed forms, which know no shadow: from the ray's start to its end in one evaluation.
#include "common/airlight_ray.glsl"
#include "04_airlight/sun.glsl"
#include "04_airlight/pegoraro.glsl"

#define SUN 0
#define PEGORARO 1
#define GAUSS 2

float closed_form(Ray ray, float sigma)
{
#if MAP_KIND == DIRECTIONAL
    return airlight_directional(ray.from, ray.to, sigma) * phase(phase_half_angle(light_direction, ray.direction));
#elif METHOD == SUN
    return sun_point(ray.nearest, ray.foot, ray.from, ray.to, sigma);
#elif METHOD == PEGORARO
    return pegoraro_point(ray.nearest, ray.foot, ray.from, ray.to, sigma);
#else
    return airlight_point(ray.nearest, ray.foot, light_radius, ray.from, ray.to, sigma);
#endif
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    Ray ray = ray_of(pixel);
    if (!ray_needed(pixel, ray))
        return;
#if GREY && !EVERYTHING
    vec3 integral = vec3(closed_form(ray, extinction.x));
#else
    vec3 integral = vec3(closed_form(ray, extinction.x), closed_form(ray, extinction.y), closed_form(ray, extinction.z));
#endif
    ray_store(pixel, ray, integral, 0u);
}
