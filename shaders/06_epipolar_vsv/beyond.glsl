// beyond: what a view ray adds behind the grid's last φ, where light rays miss the scene's box, so that all is lit: running totals of the weight over BEYOND_STEPS
// equal steps of φ from there to where the rays meet no more, π - α, for each α of the grid.
#ifndef BEYOND_GLSL
#define BEYOND_GLSL
#include "06_epipolar_vsv/weight.glsl"

#ifdef BEYOND_MAKE
#if GREY
layout(std430, binding = 6) writeonly buffer Beyond { float beyond[]; };
#else
layout(std430, binding = 6) writeonly buffer Beyond { vec4 beyond[]; };
#endif
#else
#if GREY
layout(binding = 0, r32f) readonly uniform imageBuffer beyond;
#else
layout(binding = 0, rgba32f) readonly uniform imageBuffer beyond;
#endif
#endif

float beyond_step(int row)
{
    return max(EPIPOLAR_PI - epipolar_alpha_at(float(row) + 0.5) - epipolar_least.z - epipolar_span.z, 0.0) / float(BEYOND_STEPS);
}

#ifndef BEYOND_MAKE
//[beyond
Weight beyond_grid(int row, float phi)
{
    float place = clamp((phi - epipolar_least.z - epipolar_span.z) / max(beyond_step(row), 1e-9), 0.0, float(BEYOND_STEPS));
    int below = min(int(place), BEYOND_STEPS - 1), at = row * (BEYOND_STEPS + 1) + below;
    return mix(weight_load(imageLoad(beyond, at)), weight_load(imageLoad(beyond, at + 1)), place - float(below));
}
//]
#endif

#endif
