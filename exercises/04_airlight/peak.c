// Exercise 04.3: where does the mist turn this photon? Henyey and Greenstein near g = 1.
//
// To follow light that is scattered more than once, one draws the angle by which it turns: given ξ between 0 and 1, the angle θ such that
// the share ξ of all scattered light is turned by less than θ,
//     ξ = 2π ∫ ρ(θ') sin θ' dθ' from 0 to θ,   ρ = (1 - g²) / (4π (1 + g² - 2g cos θ)^1.5).
// The formula that is printed everywhere gives cos θ. It divides by g, and with g near 1 nearly all angles are so small that their cosine is 1
// in single precision. What is asked for tells the smallest angles apart, and those near π: the squares of sine and cosine of half the angle.
//
// INPUT   2 numbers a draw: g, with -1 < g < 1, and ξ, with 0 < ξ < 1
// OUTPUT  2 numbers a draw: sin²(θ/2), cos²(θ/2)
// Each is to be right in its own leading digits, however small it is.
//
// Check it with: make check EX=04.3
#include "exercise.h"

#include <math.h>
#include <stdlib.h>

typedef struct HalfAngle {
    float sine2, cosine2; // sin²(θ/2), cos²(θ/2)
} HalfAngle;

static HalfAngle turn(float g, float xi)
{
    // Yours: this turns everything by 90°.
    (void)g, (void)xi;
    return (HalfAngle){0.5f, 0.5f};
}

int main(int argc, char **argv)
{
    Exercise exercise = exercise_open(argc, argv);
    size_t draws = exercise.count / 2;
    float *angles = memory_new(2 * draws, sizeof *angles, "angles");
    for (size_t i = 0; i < draws; i++) {
        HalfAngle angle = turn(exercise.input[2 * i], exercise.input[2 * i + 1]);
        angles[2 * i] = angle.sine2;
        angles[2 * i + 1] = angle.cosine2;
    }
    int status = exercise_close(&exercise, angles, 2 * draws);
    free(angles);
    return status;
}
