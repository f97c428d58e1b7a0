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

static float faded(float sigma, float a, float b, float w0, float w1)
{
    // Yours: this is the whole stretch in full light, in air without mist.
    (void)sigma, (void)w0, (void)w1;
    return b - a;
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
