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

#ifdef SOLUTION
// Over h = sin²(θ/2), ρ is (1 - g²) / (4π b^1.5) with b = (1 - g)² + 4g h, and 2π sin θ dθ = 4π dh. So ξ = (1 - g²)/2g · (1/(1 - g) - 1/√b), which
// gives √b = (1 - g²) / d with d = 1 + g - 2g ξ, and h = (b - (1 - g)²) / 4g: written over d², g cancels.
static float sine_squared(float g, float xi, float rest) // rest = 1 - xi
{
    // d and 1 + g - g ξ, as sums of what is not negative
    float d = g >= 0.0f ? (1.0f - g) + 2.0f * g * rest : (1.0f + g) - 2.0f * g * xi;
    float n = g >= 0.0f ? 1.0f + g * rest : (1.0f + g) - g * xi;
    float share = (1.0f - g) / d;
    return share * share * xi * n;
}

#endif
static HalfAngle turn(float g, float xi)
{
#ifdef SOLUTION
    // Seen from behind, the peak has the other sign and the share is the rest.
    return (HalfAngle){sine_squared(g, xi, 1.0f - xi), sine_squared(-g, 1.0f - xi, xi)};
#else
    // Yours: this turns everything by 90°.
    (void)g, (void)xi;
    return (HalfAngle){0.5f, 0.5f};
#endif
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
