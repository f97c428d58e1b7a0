// 04 airlight: the integral over a lit stretch, GLSL in single precision, against GSL in double, over all that it may be asked.
#include "airlight_bench.h"

// 16 nodes; measured 6.2e-5
Test(closed_form, uniform_over_the_whole_range)
{
    check_stiff("PHASE 0", &(TruthPhase){.name = "uniform"}, 1e-4);
}
Test(closed_form, rayleigh)
{
    check_stiff("PHASE 1", &(TruthPhase){.name = "rayleigh"}, 1e-4);
}
// A peak of width (1 - |g|)/2 on top of all that, 24 nodes: measured 1.4e-5 forward, 4.8e-5 backward.
static void check_peak(float mean_cosine)
{
    check_stiff("PHASE 2", &(TruthPhase){.name = "henyey_greenstein", .mean_cosine = (double)mean_cosine},
                1e-4);
}
Test(closed_form, forward)
{
    check_peak(0.9f);
}
Test(closed_form, backward)
{
    check_peak(-0.9f);
}
Test(closed_form, forward_a_thousandth_wide)
{
    check_peak(0.999f);
}
Test(closed_form, backward_a_thousandth_wide)
{
    check_peak(-0.999f);
}

Test(closed_form, directional)
{
    PointCase cases[64];
    const float sigmas[] = {1e-12f, 1e-6f, 1e-3f, 0.049f, 0.051f, 1, 50, 1e4f},
                ends[][2] = {{0, 1}, {0, INFINITY}, {0.001f, 0.0010001f}, {2, 30}};
    size_t count = 0;
    for (size_t s = 0; s < 8; s++)
        for (size_t e = 0; e < 4; e++)
            cases[count++] = (PointCase){1, 0, 1, ends[e][0], ends[e][1], sigmas[s]};
    gl_open(GL_PLATFORM_OSMESA, 16, 16, "test");
    float *got = bench_run("point.comp", "PHASE 0", NULL, cases, sizeof *cases, count, 2);
    for (size_t i = 0; i < count; i++) {
        const double from = (double)cases[i].from, to = (double)cases[i].to, sigma = (double)cases[i].sigma;
        const double expected = exp(-sigma * from) * -expm1(-sigma * (to - from)) / sigma;
        if (normal_float(expected)) // exp's argument is rounded: 2^-24 of up to 87; the cut e^-14
            cr_assert(fabs((double)got[2 * i + 1] - expected) <= 1e-5 * expected,
                      "%g for %g: [%g, %g] sigma %g", (double)got[2 * i + 1], expected, from, to, sigma);
        cr_assert(isfinite(got[2 * i + 1]));
    }
    free(got);
    gl_close();
}

// A light at to_light, radius r0; a ray from the origin.
typedef struct VectorCase {
    float to_light[3], radius, direction[3], sigma, from, to, unused[2];
} VectorCase;

static double vector_truth(const double x[9])
{
    double length = 0.0, foot = 0.0, cross = 0.0;
    for (int k = 0; k < 3; k++) {
        length = hypot(length, x[3 + k]);
        foot += x[k] * x[3 + k];
        cross = hypot(cross, x[k] * x[3 + (k + 1) % 3] - x[(k + 1) % 3] * x[3 + k]);
    }
    // x: to_light, direction, sigma, to, radius; from is 0
    return truth_airlight_point(cross / length, foot / length, x[8], 0.0, x[7], x[6],
                                &(TruthPhase){.name = "uniform"});
}

// Σ |x ∂L/∂x| / L by central differences.
static double condition(const double x[9], double value)
{
    double sum = 0.0;
    for (int i = 0; i < 9; i++) {
        const double step = 1e-5 * fabs(x[i]);
        double more[9], less[9];
        memcpy(more, x, sizeof more);
        memcpy(less, x, sizeof less);
        more[i] += step;
        less[i] -= step;
        sum += step > 0.0 ? fabs(vector_truth(more) - vector_truth(less)) / (2e-5 * value) : 0.0;
    }
    return sum;
}

// Its own error is 1e-4; what vectors add may be 4 times what rounding each of them in its last bit does to the exact integral.
Test(closed_form, from_vectors)
{
    enum { COUNT = 400 };
    static VectorCase cases[COUNT];
    srand(3);
    for (int i = 0; i < COUNT; i++) {
        double axis[3], side[3], length = 0.0;
        for (int k = 0; k < 3; k++) {
            axis[k] = rand() / (double)RAND_MAX - 0.5;
            side[k] = rand() / (double)RAND_MAX - 0.5;
            length = hypot(length, axis[k]);
        }
        const double aside = pow(10, -4.0 * rand() / RAND_MAX),
                     scale = pow(10, 12.0 * rand() / RAND_MAX - 6.0);
        VectorCase *c = &cases[i];
        for (int k = 0; k < 3; k++) {
            c->direction[k] = (float)(axis[k] / length);
            c->to_light[k] = (float)(scale * (axis[k] / length * (i % 3 - 1) + aside * side[k]));
        }
        c->radius = (float)(1e-5 * scale);
        c->sigma = (float)(pow(10, 4.0 * rand() / RAND_MAX - 3.0) / scale);
        c->to = (float)(scale * pow(10, 3.0 * rand() / RAND_MAX - 2.0));
    }
    gl_open(GL_PLATFORM_OSMESA, 16, 16, "test");
    float *got = bench_run("vectors.comp", "PHASE 0", NULL, cases, sizeof *cases, COUNT, 1);
    for (int i = 0; i < COUNT; i++) {
        const VectorCase *c = &cases[i];
        double x[9] = {0, 0, 0, 0, 0, 0, (double)c->sigma, (double)c->to, (double)c->radius};
        for (int k = 0; k < 3; k++) {
            x[k] = (double)c->to_light[k];
            x[3 + k] = (double)c->direction[k];
        }
        const double expected = vector_truth(x), worst = condition(x, expected);
        if (normal_float(expected))
            cr_assert(fabs((double)got[i] - expected) <= (1e-4 + 4.0 * worst * 0x1p-24) * expected,
                      "case %d: %g for %g, condition %g", i, (double)got[i], expected, worst);
    }
    free(got);
    gl_close();
}
