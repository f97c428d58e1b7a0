// 04 airlight: the phase functions share out all that is scattered, as printed and as they should be.
#include "airlight_bench.h"

#include <gsl/gsl_integration.h>

enum { NODES = 512 };

// 2π ∫ ρ sinθ dθ over [0, π] of the GLSL function. θ = π z³ and its mirror image about π/2 crowd the nodes at both ends, where peaks are.
static double integral_over_sphere(int phase, double g, double share, int form)
{
    static float angles[2 * NODES][2];
    static double weights[2 * NODES];
    gsl_integration_glfixed_table *rule = gsl_integration_glfixed_table_alloc(NODES);
    for (size_t i = 0; i < NODES; i++) {
        double z, weight;
        gsl_integration_glfixed_point(0.0, 1.0, i, &z, &weight, rule);
        const double theta = 0.5 * M_PI * z * z * z;
        weights[i] = weights[NODES + i] = 2.0 * M_PI * sin(theta) * weight * 1.5 * M_PI * z * z;
        angles[i][0] = angles[NODES + i][1] = (float)sin(0.5 * theta);
        angles[i][1] = angles[NODES + i][0] = (float)cos(0.5 * theta);
    }
    gsl_integration_glfixed_table_free(rule);
    char *definitions = text_format("PHASE %d", phase);
    float *got = bench_run("phase.comp", definitions, &(TruthPhase){"", g, share}, angles, sizeof *angles,
                           2 * NODES, 2);
    double sum = 0.0;
    for (size_t i = 0; i < 2 * NODES; i++)
        sum += weights[i] * (double)got[2 * i + (size_t)form];
    free(got);
    free(definitions);
    return sum;
}

static const double cosines[] = {-0.999, -0.99, -0.6, 0, 0.3, 0.9, 0.99, 0.999};
enum { COSINES = sizeof cosines / sizeof *cosines };

// From half angles, to float's precision times what (1 - g) loses as 1 - g is taken of a float: 2^-24/(1 - g).
Test(phase, each_integrates_to_1)
{
    gl_open(GL_PLATFORM_OSMESA, 16, 16, "test");
    cr_assert_float_eq(integral_over_sphere(0, 0, 0, 0), 1.0, 2e-6);
    cr_assert_float_eq(integral_over_sphere(1, 0, 0, 0), 1.0, 2e-6);
    for (int i = 0; i < COSINES; i++)
        for (int share = 0; share < 3; share++) {
            const double g = cosines[i], tolerance = 2e-6 + 0x1p-23 / (1.0 - fabs(g));
            cr_assert_float_eq(integral_over_sphere(2, g, 0, 0), 1.0, tolerance, "Henyey-Greenstein, g %g",
                               g);
            cr_assert_float_eq(integral_over_sphere(4, g, 0.5 * share, 0), 1.0, tolerance,
                               "Hoffman-Preetham normalized, g %g", g);
        }
    gl_close();
}

// From vectors: 1 ulp of a unit vector turns the angle by 1e-7, which is 2e-4 of a peak that is 5e-4 wide.
Test(phase, vectors_do_for_the_narrowest_peak)
{
    gl_open(GL_PLATFORM_OSMESA, 16, 16, "test");
    for (int i = 0; i < COSINES; i++)
        cr_assert_float_eq(integral_over_sphere(2, cosines[i], 0, 1), 1.0, 5e-4, "g %g", cosines[i]);
    gl_close();
}

// Hoffman and Preetham's Mie term, like Gomes' equation 1, has (1 - g)² for a numerator: it loses all but (1 - g)/(1 + g) of the light.
Test(phase, as_printed_light_is_lost_or_made)
{
    gl_open(GL_PLATFORM_OSMESA, 16, 16, "test");
    for (int i = 0; i < COSINES; i++) {
        const double g = cosines[i], printed = (1.0 - g) / (1.0 + g);
        const double tolerance = 1e-5 + 0x1p-22 / (1.0 - fabs(g));
        cr_assert_float_eq(integral_over_sphere(3, g, 0, 0) / printed, 1.0, tolerance, "g %g", g);
        cr_assert_float_eq(integral_over_sphere(3, g, 0.25, 0) / (0.25 + 0.75 * printed), 1.0, tolerance,
                           "g %g", g);
    }
    gl_close();
}

// The peak itself: (1 - g²)/(1 - g)³/4π, where 1 + g² - 2g cosθ in single precision is off by a tenth.
Test(phase, the_peak_is_as_high_as_it_should_be)
{
    gl_open(GL_PLATFORM_OSMESA, 16, 16, "test");
    const float g = 0.999f, straight[1][2] = {{0, 1}}, back[1][2] = {{1, 0}};
    const double exact = (1.0 - (double)g * (double)g) / pow(1.0 - (double)g, 3) / (4.0 * M_PI);
    float *got =
        bench_run("phase.comp", "PHASE 2", &(TruthPhase){"", (double)g, 0}, straight, sizeof *straight, 1, 2);
    const float naive = 1.0f + g * g - 2.0f * g * 1.0f;
    cr_assert_float_eq((double)got[0] / exact, 1.0, 1e-6);
    cr_assert_float_eq((double)got[1] / exact, 1.0, 1e-6);
    cr_assert(fabs((double)naive / ((1.0 - (double)g) * (1.0 - (double)g)) - 1.0) > 0.05, "%g",
              (double)naive);
    free(got);
    got = bench_run("phase.comp", "PHASE 2", &(TruthPhase){"", (double)-g, 0}, back, sizeof *back, 1, 2);
    cr_assert_float_eq((double)got[0] / exact, 1.0, 1e-6);
    free(got);
    gl_close();
}

// The truth's functions, in double and by cosθ, are the same ones.
Test(phase, the_truth_has_the_same)
{
    static const char *const names[] = {"uniform", "rayleigh", "henyey_greenstein", "hoffman_preetham",
                                        "hoffman_preetham_normalized"};
    gl_open(GL_PLATFORM_OSMESA, 16, 16, "test");
    for (int phase = 0; phase < 5; phase++)
        for (int i = 0; i <= 8; i++) {
            const double half = 0.5 * M_PI * i / 8.0;
            const float angle[1][2] = {{(float)sin(half), (float)cos(half)}};
            const TruthPhase of = {names[phase], (double)-0.7f, 0.25};
            char *definitions = text_format("PHASE %d", phase);
            float *got = bench_run("phase.comp", definitions, &of, angle, sizeof *angle, 1, 2);
            cr_assert_float_eq((double)got[0] / truth_phase(&of, cos(2.0 * half)), 1.0, 2e-6, "%s at %g",
                               names[phase], 2.0 * half);
            free(got);
            free(definitions);
        }
    gl_close();
}
