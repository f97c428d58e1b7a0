// sample: the airlight integrand over φ. Comes after common/airlight_ray.glsl and 06_epipolar_vsv/query.glsl.
#ifndef SAMPLE_GLSL
#define SAMPLE_GLSL
#include "06_epipolar_vsv/texture.glsl"

//[sample
// ρ Lin e^(-σ (t + r)) dt/dφ at φ, for I = 1. With nearest = D sin α, r = nearest / sin(α + φ) and dt/dφ = r² / nearest: the inverse square cancels, so that equal
// steps of φ are Kulla and Fajardo's equiangular samples. The light is turned by α + φ.
vec3 sample_phi(Ray ray, Query query, float phi)
{
    float t = clamp(epipolar_along(query.alpha, phi), ray.from, min(ray.to, AIRLIGHT_FAR));
#if MAP_KIND == DIRECTIONAL
    float turn = 0.5 * query.angle;
    vec3 rest = ray_transmittance(t) / max(query.alpha.x, AIRLIGHT_LEAST);
#else
    float turn = 0.5 * (query.angle + phi), r = airlight_hypotenuse(ray.nearest, t - ray.foot), held = r / max(r, light_radius);
    vec3 rest = ray_transmittance(t + r) * (held * held / ray.nearest);
#endif
    vec2 turned = vec2(sin(turn), cos(turn));
    return rest * phase(turned * turned);
}
//]

#endif
