// sun: Sun, Ramamoorthi, Narasimhan and Nayar, "A practical analytic single scattering model for real time rendering" (2005): without shadow, for the uniform phase
// function and a point light without radius, the integral along a ray is a difference of
//     F(u, v) = ∫ e^(-u tan ξ) dξ over [0, v],
// which is read from a table: u down to 0 at texel 0, SUN_MOST_U at the last; v from 0 to π/2.
#ifndef SUN_GLSL
#define SUN_GLSL

layout(binding = 3, r32f) readonly uniform image2D sun_table;
const float SUN_MOST_U = 10.0;

//[sun
float sun_f(float u, float v)
{
    vec2 last = vec2(imageSize(sun_table) - 1), at = clamp(vec2(u / SUN_MOST_U, v / HALF_PI), 0.0, 1.0) * last;
    ivec2 low = ivec2(min(floor(at), last - 1.0));
    vec2 share = at - vec2(low);
    vec2 below = vec2(imageLoad(sun_table, low).x, imageLoad(sun_table, low + ivec2(1, 0)).x);
    vec2 above = vec2(imageLoad(sun_table, low + ivec2(0, 1)).x, imageLoad(sun_table, low + ivec2(1, 1)).x);
    vec2 value = mix(below, above, share.y);
    return mix(value.x, value.y, share.x);
}

// Their equation 10 for [0, to], here from any start. What is not a number is returned as 0: where that is, and why, the lesson says.
float sun_point(float nearest, float foot, float from, float to, float sigma)
{
    float u = sigma * nearest;
    float first = 0.5 * HALF_PI + 0.5 * atan((from - foot) / nearest), last = 0.5 * HALF_PI + 0.5 * atan((to - foot) / nearest);
    float result = 2.0 * INVERSE_4_PI * exp(-sigma * foot) / nearest * (sun_f(u, last) - sun_f(u, first));
    return isnan(result) || isinf(result) ? 0.0 : result;
}
//]

#endif
