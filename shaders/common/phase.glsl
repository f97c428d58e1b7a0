// phase: how a medium's particles share out what they scatter: of the light that is turned by the angle θ, 1/sr; over the
// sphere each integrates to 1. Taught line by line in chapter 04.
//
// `half_angle` is (sin²(θ/2), cos²(θ/2)), θ between the way that the light travels and the way from the particle to the eye: 0 forward. Of
// cosθ alone neither end of the range could be told: near θ = 0 and π a step of 2^-24 in cosθ is 3.5e-4 rad. No acos is needed either.
#ifndef PHASE_GLSL
#define PHASE_GLSL

#define PHASE_UNIFORM 0
#define PHASE_RAYLEIGH 1
#define PHASE_HENYEY_GREENSTEIN 2
#define PHASE_HOFFMAN_PREETHAM 3            // as printed: integrates to less than 1
#define PHASE_HOFFMAN_PREETHAM_NORMALIZED 4
#ifndef PHASE
#define PHASE PHASE_UNIFORM
#endif

uniform float mean_cosine;    // Henyey and Greenstein's g, -0.999 to 0.999
uniform float rayleigh_share; // Hoffman and Preetham: how much of the scattering is Rayleigh's

const float INVERSE_4_PI = 0.0795774715;

//[half_angle
// Of unit vectors: the light's travel and the view ray (from the eye). |a - b|² = 2 - 2 a·b, so these are half angles without a cosine.
vec2 phase_half_angle(vec3 travel, vec3 view)
{
    vec3 forward = travel + view, backward = travel - view;
    return 0.25 * vec2(dot(forward, forward), dot(backward, backward));
}
//]

//[rayleigh
// 3/16π (1 + cos²θ); cosθ = cos² - sin² of the half angle.
float phase_rayleigh(vec2 half_angle)
{
    float cosine = half_angle.y - half_angle.x;
    return 0.75 * INVERSE_4_PI * (1.0 + cosine * cosine);
}
//]

//[henyey
// Henyey and Greenstein (1941): (1 - g²) / (1 + g² - 2g cosθ)^1.5 / 4π. The denominator's base is (1 - |g|)² + 4|g| sin²(θ/2) for g > 0, with the
// cosine for g < 0: a sum of what is positive, so nothing is lost as g nears ±1. Gomes 2015, eq. 1, prints the numerator (1 - g)².
float phase_henyey_greenstein(vec2 half_angle, float g)
{
    float rest = 1.0 - abs(g);
    float base = rest * rest + 4.0 * abs(g) * (g >= 0.0 ? half_angle.x : half_angle.y);
    return INVERSE_4_PI * (rest * (1.0 + abs(g))) / (base * sqrt(base));
}
//]

//[phase
// The phase function that the program chose.
float phase(vec2 half_angle)
{
#if PHASE == PHASE_RAYLEIGH
    return phase_rayleigh(half_angle);
#elif PHASE == PHASE_HENYEY_GREENSTEIN
    return phase_henyey_greenstein(half_angle, mean_cosine);
#elif PHASE == PHASE_HOFFMAN_PREETHAM
    // Their Mie term has the numerator (1 - g)²: over the sphere it integrates to (1 - g) / (1 + g).
    float mie = phase_henyey_greenstein(half_angle, mean_cosine) * (1.0 - mean_cosine) / (1.0 + mean_cosine);
    return mix(mie, phase_rayleigh(half_angle), rayleigh_share);
#elif PHASE == PHASE_HOFFMAN_PREETHAM_NORMALIZED
    return mix(phase_henyey_greenstein(half_angle, mean_cosine), phase_rayleigh(half_angle), rayleigh_share);
#elif EVERYTHING
    return phase_henyey_greenstein(half_angle, 0.0); // the same number, for nothing
#else
    return INVERSE_4_PI;
#endif
}
//]

#endif
