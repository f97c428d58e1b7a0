// weight: airlight as an integral over φ, by which bits are weighted. Along a view ray D dt = r² dφ (D: the light's distance from the ray, r: the way to the
// light), so the inverse square cancels, and
//
//     L = σs I / D ∫ ρ e^(-σt (t + r)) dφ:   what is left under the integral is smooth in α and φ, and 1/D can wait for the pixel, which knows its own D.
//
// A directional light has no r, and the distance from its axis for φ: L = σs E ρ ∫ e^(-σt t) dφ / sin α.
// Includes common/epipolar.glsl, where EPIPOLE_AT_INFINITY may be set before, and common/phase.glsl.
#ifndef WEIGHT_GLSL
#define WEIGHT_GLSL
#include "common/epipolar.glsl"
#include "common/phase.glsl"

// Three channels differ in extinction; a grey medium needs one number where others need three.
#if GREY
#define Weight float
#define weight_store(w) (w)
#define weight_load(texel) (texel).x
#define WEIGHT_EXTINCTION extinction.x
#else
#define Weight vec3
#define weight_store(w) vec4(w, 0.0)
#define weight_load(texel) (texel).rgb
#define WEIGHT_EXTINCTION extinction
#endif

//[weight
// What is under the integral. By half angles, (sin α + sin φ) / sin(α + φ) = cos((α - φ)/2) / cos((α + φ)/2), and α + φ is the angle by which light is turned.
Weight weight_at(float alpha, float phi)
{
#if EPIPOLE_AT_INFINITY
    float sine = max(sin(alpha), 1e-30), half_turn = cos(0.5 * alpha);
    return exp(-WEIGHT_EXTINCTION * (phi / sine)) * (phase(vec2(1.0 - half_turn * half_turn, half_turn * half_turn)) / sine);
#else
    float half_turn = cos(0.5 * (alpha + phi)), path = epipolar_distance * cos(0.5 * (alpha - phi)) / max(half_turn, 1e-30);
    float met = float(half_turn > 0.0); // 0: the rays do not meet
    return exp(-WEIGHT_EXTINCTION * path) * (met * phase(vec2(1.0 - half_turn * half_turn, half_turn * half_turn)));
#endif
}
//]

#endif
