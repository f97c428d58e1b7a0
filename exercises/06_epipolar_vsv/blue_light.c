// Exercise 06.4: blue light from bits.
//
// Along a view ray that passes the light at the distance h, even steps of φ are worth even amounts of light: ds / d² = dφ / h. So in air so thin that
// nothing is lost on the way, and lamp and scattering of strength 1, the airlight of the ray is
//     L = 1/h · ∫ p(α + φ) dφ over what is lit of [from, to],
// since light is turned by the angle α + φ when it is scattered towards the eye. Clean air scatters as Rayleigh found: p(x) = 3/(16π) · (1 + cos² x).
// That has a closed form. Sum it over the lit voxels of a row of bits.
//
// INPUT   12 numbers a ray: the distance from eye to light; α; the φ where the ray's stretch begins, and where it ends; then 128 bits as 8 numbers of 16, the lowest
//         bit first: bit k is the voxel from φ = k·π/128 to (k + 1)·π/128, and is set where it lies in shadow
// OUTPUT  1 number a ray: L in 1/m
// A stretch begins and ends within voxels: of these a part counts. A short stretch is as exact as a long one.
//
// Check it with: make check EX=06.4
#include "exercise.h"

#include <math.h>
#include <stdlib.h>

enum { VOXELS = 128, NUMBERS = 4 + VOXELS / 16 };
static const float PI = 3.14159265f;

// Whether voxel k lies in shadow.
static bool is_dark(const float *bits, int k)
{
    return (unsigned)bits[k / 16] >> k % 16 & 1u;
}

// The airlight of one ray.
static float airlight(float distance, float alpha, float from, float to, const float *bits)
{
    // Yours: this is the same for every ray, whatever is lit.
    (void)distance, (void)alpha, (void)from, (void)to, (void)is_dark(bits, 0);
    return 0.25f / PI;
}

int main(int argc, char **argv)
{
    Exercise exercise = exercise_open(argc, argv);
    size_t rays = exercise.count / NUMBERS;
    float *output = memory_new(rays, sizeof *output, "airlight");
    for (size_t r = 0; r < rays; r++) {
        const float *in = exercise.input + NUMBERS * r;
        output[r] = airlight(in[0], in[1], in[2], in[3], in + 4);
    }
    int status = exercise_close(&exercise, output, rays);
    free(output);
    return status;
}
