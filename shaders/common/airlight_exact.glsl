// exact: where the light reaches a pixel's ray, as the truth knows it (oracle=map): lit spans in order instead of a depth map.
#ifndef EXACT_GLSL
#define EXACT_GLSL

layout(binding = 1, std430) readonly buffer ExactFirst { uint exact_first[]; }; // of pixel x + width · y, y upwards; and where the last one's end
layout(binding = 2, std430) readonly buffer ExactSpans { vec2 exact_spans[]; }; // from, to along the ray

uint exact_at, exact_end; // the span that the last sample met or passed; the end of the ray's

void exact_begin(ivec2 pixel, int width)
{
    exact_at = exact_first[pixel.y * width + pixel.x];
    exact_end = exact_first[pixel.y * width + pixel.x + 1];
}

// 1 lit, 0 in shadow, at t. Samples come in order along the ray, so one walk along the spans serves them all.
float exact_lit(float t)
{
    while (exact_at < exact_end && exact_spans[exact_at].y < t)
        exact_at++;
    return float(exact_at < exact_end && exact_spans[min(exact_at, exact_end - 1u)].x <= t);
}

#endif
