// Exercise 04.2: the sun's penumbra in thin mist.
//
// The sun is no point, so a shadow's border in mist is no step: from one end of a stretch of the ray to the other the light fades. Take it to
// fade evenly, and the airlight of the stretch still has a closed form,
//     L = ∫ w(t) e^(-σt) dt from a to b,   with w(a) = w0, w(b) = w1 and a straight line between.
// Derive it; then see what becomes of it in single precision where the mist is thin, σ(b - a) small or 0, and repair that.
//
// INPUT   5 numbers a stretch: σ in 1/m; a and b in metres, 0 <= a < b; w0 and w1
// OUTPUT  1 number a stretch: L in metres
//
// Check it with: make check EX=04.2
#include "exercise.h"

#include <math.h>
#include <stdlib.h>

#ifdef SOLUTION
// ∫ (1 - x) e^(-τx) dx and ∫ x e^(-τx) dx over [0, 1].
typedef struct Shares {
    float first, last;
} Shares;

static Shares shares_of(float tau)
{
    if (tau >= 1.0f)
        return (Shares){(tau - 1.0f + expf(-tau)) / (tau * tau),
                        (1.0f - (1.0f + tau) * expf(-tau)) / (tau * tau)};
    // Below, both numerators are τ²/2 as the difference of numbers of size 1. Their series, Σ (-τ)^k / (k + 2)! and Σ (k + 1) (-τ)^k / (k + 2)!:
    Shares shares = {0.0f, 0.0f};
    float term = 0.5f; // (-τ)^k / (k + 2)!
    for (int k = 0; k < 10; k++) {
        shares.first += term;
        shares.last += (float)(k + 1) * term;
        term *= -tau / (float)(k + 3);
    }
    return shares;
}

#endif
static float faded(float sigma, float a, float b, float w0, float w1)
{
#ifdef SOLUTION
    Shares shares = shares_of(sigma * (b - a));
    return expf(-sigma * a) * (b - a) * (w0 * shares.first + w1 * shares.last);
#else
    // Yours: this is the whole stretch in full light, in air without mist.
    (void)sigma, (void)w0, (void)w1;
    return b - a;
#endif
}

int main(int argc, char **argv)
{
    Exercise exercise = exercise_open(argc, argv);
    size_t stretches = exercise.count / 5;
    float *airlight = memory_new(stretches, sizeof *airlight, "airlight");
    for (size_t i = 0; i < stretches; i++) {
        const float *in = exercise.input + 5 * i;
        airlight[i] = faded(in[0], in[1], in[2], in[3], in[4]);
    }
    int status = exercise_close(&exercise, airlight, stretches);
    free(airlight);
    return status;
}
