// The closed forms, which know no shadow: from the ray's start to its end in one evaluation. With oracle=map each lit stretch gets its own.
#include "common/airlight_ray.glsl"
#include "04_airlight/sun.glsl"
#include "04_airlight/pegoraro.glsl"
#if EXACT
#include "common/airlight_exact.glsl"
#endif

#define SUN 0
#define PEGORARO 1
#define GAUSS 2

float closed_form(Ray ray, float from, float to, float sigma)
{
#if MAP_KIND == DIRECTIONAL
    return airlight_directional(from, to, sigma) * phase(phase_half_angle(light_direction, ray.direction));
#elif METHOD == SUN
    return sun_point(ray.nearest, ray.foot, from, to, sigma);
#elif METHOD == PEGORARO
    return pegoraro_point(ray.nearest, ray.foot, from, to, sigma);
#else
    return airlight_point(ray.nearest, ray.foot, light_radius, from, to, sigma);
#endif
}

vec3 closed_forms(Ray ray, float from, float to) // a channel
{
#if GREY && !EVERYTHING
    return vec3(closed_form(ray, from, to, extinction.x));
#else
    return vec3(closed_form(ray, from, to, extinction.x), closed_form(ray, from, to, extinction.y), closed_form(ray, from, to, extinction.z));
#endif
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    Ray ray = ray_of(pixel);
    if (!ray_needed(pixel, ray))
        return;
#if EXACT
    vec3 integral = vec3(0.0);
    exact_begin(pixel, imageSize(airlight).x);
    for (; exact_at < exact_end; exact_at++) {
        vec2 lit = clamp(exact_spans[exact_at], ray.from, ray.to);
        integral += lit.x < lit.y ? closed_forms(ray, lit.x, lit.y) : vec3(0.0);
    }
#else
    vec3 integral = closed_forms(ray, ray.from, ray.to);
#endif
    ray_store(pixel, ray, integral, 0u);
}
