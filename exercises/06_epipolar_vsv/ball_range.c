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

static Ranges ranges_of(vec3 light, vec3 middle, float radius)
{
    // Yours: this is less than nothing, of every ball.
    (void)light, (void)middle, (void)radius;
    return (Ranges){-PI, -PI, -PI, -PI};
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
