// Exercise 06.6: the part of the grid that a ball can darken.
//
// The lesson cuts the grid down to what the picture sees, by corners: of the picture, of the box around all surfaces. Where a single thing has moved since the
// last picture, only its part of the grid is to be built anew. Put a ball around it: seen from the eye and from the light that is a disc, and where its rim
// lies nearest to the axis, and farthest from it, has a closed form; so has the wedge between the two planes through the axis that touch it. Of α the least
// is all you need: along a light ray α grows, and what lies beyond the ball is dark up to the grid's end.
//
// INPUT   7 numbers a ball: the light, then the ball's middle, in metres from the eye; its radius
// OUTPUT  4 numbers a ball: the least α of all its points; the θ that it spans, all of 2π where the axis passes through it; the least φ of them and the greatest
// Angles are in radians. α is the angle at the eye between light and point, φ that at the light between eye and point: both from 0 to π. The axis is the whole
// line through eye and light; to its points, and so to α = 0, α = π, φ = 0 and φ = π, belong all θ. A ball may hold the eye, or the light: from within, it lies
// all around. No ball touches eye, light or axis: it passes them by, if only by a hair, or holds them. A range that begins near 0 is as exact as a wide one.
//
// Check it with: make check EX=06.6
#include "exercise.h"
#include "linear.h"

#include <stdlib.h>

typedef struct Ranges {
    float alpha_least, theta_span, phi_least, phi_most;
} Ranges;

static const float PI = 3.14159265f;

#ifdef SOLUTION
// A ball from one end of the axis. All is short enough to be exact: whole numbers, or sixteenths.
typedef struct View {
    float off,
        along; // the cross and the dot product of the axis and the way to the middle: its sine and cosine, times both lengths
    float square; // the distance to the middle, squared
    float radius;
    float
        clear; // (the middle's distance from the axis)² - radius², times the axis' length squared: above 0 where the axis passes the ball by
} View;

// The least angle to the axis: to the middle, less the rim's, whose sine is radius / distance and whose cosine is tangent / distance.
static float least_angle(View ball)
{
    float tangent_square = ball.square - ball.radius * ball.radius;
    if (tangent_square <= 0.0f || (ball.clear <= 0.0f && ball.along > 0.0f))
        return 0.0f;
    float tangent = sqrtf(tangent_square), a = ball.off * tangent, b = ball.along * ball.radius;
    // a - b is the difference's sine. Of two numbers alike it is what (a² - b²) / (a + b) is, and a² - b² = square · clear.
    float sine = b > 0.0f ? ball.square * ball.clear / (a + b) : a - b;
    return atan2f(sine, ball.along * tangent + ball.off * ball.radius);
}

// From the axis' other direction the greatest angle is the least one.
static float most_angle(View ball)
{
    ball.along = -ball.along;
    return PI - least_angle(ball);
}

#endif
static Ranges ranges_of(vec3 light, vec3 middle, float radius)
{
#ifdef SOLUTION
    vec3 across = vec3_cross(light, middle), from_light = middle - light;
    float off_square = vec3_dot(across, across), off = sqrtf(off_square),
          axis_square = vec3_dot(light, light);
    float clear = off_square - radius * radius * axis_square;
    View eye = {off, vec3_dot(light, middle), vec3_dot(middle, middle), radius, clear};
    View lamp = {off, -vec3_dot(light, from_light), vec3_dot(from_light, from_light), radius, clear};
    return (Ranges){.alpha_least = least_angle(eye),
                    .theta_span =
                        clear > 0.0f ? 2.0f * atan2f(radius * sqrtf(axis_square), sqrtf(clear)) : 2.0f * PI,
                    .phi_least = least_angle(lamp),
                    .phi_most = most_angle(lamp)};
#else
    // Yours: this is less than nothing, of every ball.
    (void)light, (void)middle, (void)radius;
    return (Ranges){-PI, -PI, -PI, -PI};
#endif
}

int main(int argc, char **argv)
{
    Exercise exercise = exercise_open(argc, argv);
    size_t balls = exercise.count / 7;
    float *output = memory_new(4 * balls, sizeof *output, "ranges");
    for (size_t i = 0; i < balls; i++) {
        const float *in = exercise.input + 7 * i;
        Ranges ranges = ranges_of(vec3_make(in[0], in[1], in[2]), vec3_make(in[3], in[4], in[5]), in[6]);
        output[4 * i] = ranges.alpha_least;
        output[4 * i + 1] = ranges.theta_span;
        output[4 * i + 2] = ranges.phi_least;
        output[4 * i + 3] = ranges.phi_most;
    }
    int status = exercise_close(&exercise, output, 4 * balls);
    free(output);
    return status;
}
