// spread: see spread.h.
#include "spread.h"

#include <math.h>
#include <stdlib.h>

// Few rays are walked, and a byte of φ has one weight: no voxel may be wider than twice an even one. With 0.25 prefix sums lose what runs gain.
static const double FLOOR = 0.5;

size_t spread_bytes(int phi)
{
    return ((size_t)phi / 8 + 1) * sizeof(float);
}

//[density
// A border is off by up to half a voxel's width, and so is the light behind it, by its weight g. With n(φ) voxels a step the squared error is Σ g / n²; for a
// given Σ n it is least where n is as the cube root of g.
static void place_steps(const uint32_t *weight, float places[SPREAD_STEPS + 1])
{
    double density[SPREAD_STEPS], sum = 0.0, place = 0.0;
    for (int i = 0; i < SPREAD_STEPS; i++) {
        const double below = weight[i > 0 ? i - 1 : i], above = weight[i + 1 < SPREAD_STEPS ? i + 1 : i];
        density[i] = cbrt(0.25 * below + 0.5 * weight[i] + 0.25 * above);
        sum += density[i];
    }
    for (int i = 0; i < SPREAD_STEPS; i++) {
        const double share = sum > 0.0 ? density[i] / sum : 1.0 / SPREAD_STEPS;
        places[i] = (float)place;
        place += FLOOR / SPREAD_STEPS + (1.0 - FLOOR) * share;
    }
    places[SPREAD_STEPS] = 1.0f;
}
//]

void spread_set(GLuint table, int phi, const uint32_t *weight)
{
    const int bytes = phi / 8;
    float places[SPREAD_STEPS + 1], *borders = memory_new(1, spread_bytes(phi), "spread of phi");
    place_steps(weight, places);
    for (int i = 0, step = 0; i <= bytes; i++) {
        const float place = (float)i / (float)bytes;
        while (step + 1 < SPREAD_STEPS && places[step + 1] < place)
            step++;
        const float into = (place - places[step]) / (places[step + 1] - places[step]);
        borders[i] = ((float)step + into) / SPREAD_STEPS;
    }
    gl.NamedBufferSubData(table, 0, (GLsizeiptr)spread_bytes(phi), borders);
    free(borders);
}

void spread_even(GLuint table, int phi)
{
    static const uint32_t none[SPREAD_STEPS] = {0};
    spread_set(table, phi, none);
}
