// Airlight marched between the bounds of shadow alone (Wyman and Ramsey 2008); before and behind them the ray is lit, in closed form.
#include "common/airlight_ray.glsl"
layout(binding = 5, rg32f) readonly uniform image2D bounds; // bounds.h
uniform int steps;

vec3 lit_stretch(Ray ray, float from, float to)
{
#if MAP_KIND == DIRECTIONAL
#define INTEGRAL(sigma) (phase(phase_half_angle(light_direction, ray.direction)) * airlight_directional(from, to, sigma))
#else
#define INTEGRAL(sigma) airlight_point(ray.nearest, ray.foot, light_radius, from, to, sigma)
#endif
    float grey = INTEGRAL(extinction.x);
#if GREY && !EVERYTHING
    return vec3(grey);
#else
    return vec3(grey, INTEGRAL(extinction.y), INTEGRAL(extinction.z));
#endif
}

//[bounds
// Midpoints in the angle at the light, which cancels the inverse square (Kulla and Fajardo 2012).
vec3 marched(Ray ray, float from, float to)
{
    vec3 sum = vec3(0.0);
#if MAP_KIND == DIRECTIONAL
    float scattered = phase(phase_half_angle(light_direction, ray.direction)), step = (to - from) / float(steps);
    for (int i = 0; i < steps; i++) {
        float t = from + (float(i) + 0.5) * step;
        sum += step * scattered * ray_lit(ray, t) * ray_transmittance(t);
    }
#else
    float d = max(ray.nearest, light_radius), first = atan((from - ray.foot) / d), step = (atan((to - ray.foot) / d) - first) / float(steps);
    for (int i = 0; i < steps; i++) {
        float u = d * tan(first + (float(i) + 0.5) * step), t = ray.foot + u, r = airlight_hypotenuse(ray.nearest, u), held = max(r, light_radius);
        vec3 way = eye_from_origin + t * ray.direction;
        sum += step * (d + u * (u / d)) / (held * held) * ray_lit(ray, t) * phase(phase_half_angle(normalize(way), ray.direction)) * ray_transmittance(t + r);
    }
#endif
    return sum;
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    Ray ray = ray_of(pixel);
    if (!ray_needed(pixel, ray))
        return;
    vec2 found = imageLoad(bounds, pixel).xy;
    // A ray that begins in shadow may have no face before it.
    float begin = ray_lit(ray, ray.from) == 0.0 ? ray.from : clamp(found.x, ray.from, ray.to);
    float end = clamp(-found.y, begin, ray.to);
    bool shadow = begin < end;
    vec3 sum = lit_stretch(ray, ray.from, begin) + lit_stretch(ray, end, ray.to);
    // A loop, since this renderer computes both sides of an if for all pixels, but ends a loop that no pixel needs.
    for (int once = 0; once < (shadow ? 1 : 0); once++)
        sum += marched(ray, begin, end);
    ray_store(pixel, ray, sum, shadow ? uint(steps) : 0u);
}
//]
