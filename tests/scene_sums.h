// scene_sums: closed forms over a mesh's triangles. For tests of scenes.
#ifndef SCENE_SUMS_H
#define SCENE_SUMS_H

#include "scene.h"

#include <criterion/criterion.h>

// Sums of some float32 products near 1, each within 2^-24.
static const double FLOAT_SUMS = 1e-5;

typedef struct Sums {
    double area,
        volume; // m², m³ (divergence theorem: a closed surface whose triangles face outwards has its volume)
    double area_vector[3];    // 0 where the surface is closed
    size_t against, not_unit; // corners whose normal lies against the winding, or is not of unit length
} Sums;

static inline Sums sums_of(const Mesh *mesh, size_t first)
{
    Sums sums = {0};
    for (size_t i = first; i < mesh->triangle_count; i++) {
        double p[3][3], c[3];
        for (size_t k = 0; k < 9; k++) // from the first vertex of all, so that distance costs no digits
            p[k / 3][k % 3] = (double)mesh->positions[3 * (size_t)mesh->indices[3 * i + k / 3] + k % 3] -
                              (double)mesh->positions[k % 3];
        for (size_t a = 0; a < 3; a++) {
            const size_t u = (a + 1) % 3, v = (a + 2) % 3;
            c[a] = (p[1][u] - p[0][u]) * (p[2][v] - p[0][v]) - (p[1][v] - p[0][v]) * (p[2][u] - p[0][u]);
            sums.area_vector[a] += c[a] / 2;
            sums.volume += p[0][a] * c[a] / 6;
        }
        sums.area += sqrt(c[0] * c[0] + c[1] * c[1] + c[2] * c[2]) / 2;
        for (size_t k = 0; k < 3; k++) {
            const float *n = mesh->normals + 3 * (size_t)mesh->indices[3 * i + k];
            const double nx = (double)n[0], ny = (double)n[1], nz = (double)n[2];
            sums.against += nx * c[0] + ny * c[1] + nz * c[2] <= 0;
            sums.not_unit += !(fabs(nx * nx + ny * ny + nz * nz - 1) < 1e-6);
        }
    }
    return sums;
}

static inline void expect_near(double got, double expected, double relative, const char *what)
{
    cr_assert(fabs(got - expected) <= relative * fabs(expected), "%s: %.9g, expected %.9g", what, got,
              expected);
}

static inline void expect_vector(vec3 got, double x, double y, double z, const char *what)
{
    const double far =
        fmax(fmax(fabs((double)got[0] - x), fabs((double)got[1] - y)), fabs((double)got[2] - z));
    cr_assert(far <= 1e-6, "%s: (%g %g %g), expected (%g %g %g)", what, (double)got[0], (double)got[1],
              (double)got[2], x, y, z); // a few roundings of numbers below 10
}

#endif
