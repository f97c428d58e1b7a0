// 04 airlight: where the published closed forms hold, and where they do not, while airlight_point does.
#include "../chapters/04_airlight/closed_form.h"
#include "airlight_bench.h"

enum { SUN, PEGORARO };
static const TruthPhase uniform = {.name = "uniform"};

static float *published(const PointCase *cases, size_t count, int table_size)
{
    GLuint texture = closed_form_table(table_size);
    gl.BindImageTexture(3, texture, 0, GL_FALSE, 0, GL_READ_ONLY, GL_R32F);
    float *got = bench_run("published.comp", "PHASE 0", NULL, cases, sizeof *cases, count, 2);
    gl_texture_delete(&texture);
    return got;
}

static double relative(const PointCase *c, float got)
{
    const double expected = point_truth(c, &uniform);
    return fabs((double)got - expected) / expected;
}

// Light and segment of a like size, an optical depth of about 1: what the papers show.
Test(published, both_hold_in_the_middle_of_their_range)
{
    const PointCase cases[] = {{1, 1, 1e-4f, 0, 3, 0.3f},
                               {0.5f, 2, 1e-4f, 0, 5, 0.5f},
                               {2, -1, 1e-4f, 0, 4, 0.2f},
                               {1, 0.5f, 1e-4f, 0, 2, 1}};
    gl_open(GL_PLATFORM_OSMESA, 16, 16, "test");
    float *got = published(cases, 4, 64);
    for (size_t i = 0; i < 4; i++) {
        cr_assert(relative(&cases[i], got[2 * i + SUN]) < 5e-2, "Sun: %g",
                  relative(&cases[i], got[2 * i + SUN])); // the table's error, below
        cr_assert(relative(&cases[i], got[2 * i + PEGORARO]) < 1e-5, "Pegoraro: %g",
                  relative(&cases[i], got[2 * i + PEGORARO]));
    }
    free(got);
    gl_close();
}

// Bilinear in a table of n² texels: errors fall as 1/n² except in the cell at u = 0, v = π/2, where F has no second derivative.
Test(published, the_table_of_f_is_as_good_as_its_lesson_says)
{
    for (int size = 64; size <= 128; size *= 2) {
        float *table = sun_table(size);
        double worst = 0.0;
        for (int j = 0; j + 1 < size; j += 3)
            for (int i = 0; i + 1 < size; i += 3) { // in the middle of cells, where it is worst
                const float *at = table + j * size + i;
                const double mean =
                    0.25 * ((double)at[0] + (double)at[1] + (double)at[size] + (double)at[size + 1]);
                const double exact =
                    sun_f(SUN_MOST_U * (i + 0.5) / (size - 1), M_PI_2 * (j + 0.5) / (size - 1));
                worst = fmax(worst, fabs(mean - exact));
            }
        cr_assert(worst > 1e-3 && worst < (size == 64 ? 5e-2 : 2.5e-2), "%d: %g", size, worst);
        free(table);
    }
}

typedef struct Failing {
    const char *why;
    PointCase at;
    double sun, pegoraro; // at least so wrong, relative; 0: not asked
} Failing;
static const Failing failing[] = {
    {"a short stretch: a difference of two nearly equal numbers",
     {1, 1, 1e-4f, 2, 2.00001f, 0.3f},
     0.03,
     5e-3},
    {"the light nearly on the ray, behind the eye", {1e-6f, -1, 1e-9f, 0, 1, 0.3f}, 0.05, 0},
    {"the light nearly on the ray, before it: s cancels", {1e-4f, 2, 1e-9f, 0, 1, 0.3f}, 0, 0.05},
    {"the light on the ray: 0/0", {0, 2, 1e-4f, 0, 1, 0.3f}, 0.9, 0.9},
    {"the light far behind", {1, -100, 1e-4f, 0, 1, 0.3f}, 0.5, 0},
    {"u = σ · distance beyond the table", {40, 1, 1e-4f, 0, 1, 1}, 0.5, 0},
    {"|z| where one series cancels and the other diverges", {5, 1, 1e-4f, 0, 10, 1}, 0, 1e-3},
};

Test(published, each_fails_where_the_lesson_says_and_the_stretch_does_not)
{
    enum { COUNT = sizeof failing / sizeof *failing };
    PointCase cases[COUNT];
    for (size_t i = 0; i < COUNT; i++)
        cases[i] = failing[i].at;
    gl_open(GL_PLATFORM_OSMESA, 16, 16, "test");
    float *got = published(cases, COUNT, 64);
    float *ours = bench_run("point.comp", "PHASE 0", NULL, cases, sizeof *cases, COUNT, 2);
    for (size_t i = 0; i < COUNT; i++) {
        const double sun = relative(&cases[i], got[2 * i + SUN]),
                     pegoraro = relative(&cases[i], got[2 * i + PEGORARO]);
        cr_expect(sun >= failing[i].sun, "%s: Sun is off by %g only", failing[i].why, sun);
        cr_expect(pegoraro >= failing[i].pegoraro, "%s: Pegoraro is off by %g only", failing[i].why,
                  pegoraro);
        cr_expect(isfinite(got[2 * i]) && isfinite(got[2 * i + 1]), "%s: not finite", failing[i].why);
        cr_expect(relative(&cases[i], ours[2 * i]) < 1e-4, "%s: the stretch is off by %g", failing[i].why,
                  relative(&cases[i], ours[2 * i]));
    }
    free(got);
    free(ours);
    gl_close();
}

// How much of all that may be asked each answers to 1 %: printed in the lesson.
Test(published, most_of_the_stiff_cases_are_beyond_them)
{
    static PointCase cases[STIFF_CASES];
    const size_t count = stiff_cases(cases);
    size_t asked = 0, sun = 0, pegoraro = 0;
    gl_open(GL_PLATFORM_OSMESA, 16, 16, "test");
    float *got = published(cases, count, 64);
    for (size_t i = 0; i < count; i++) {
        if (!normal_float(point_truth(&cases[i], &uniform)))
            continue;
        asked++;
        sun += relative(&cases[i], got[2 * i + SUN]) <= 0.01;
        pegoraro += relative(&cases[i], got[2 * i + PEGORARO]) <= 0.01;
    }
    cr_log_info("of %zu stiff cases Sun answers %zu to 1 %%, Pegoraro %zu", asked, sun, pegoraro);
    cr_assert(sun < asked / 2 && pegoraro < asked / 2, "of %zu: Sun %zu, Pegoraro %zu", asked, sun, pegoraro);
    free(got);
    gl_close();
}

// Billeter et al.'s signed sum from the eye, where the ray first passes close by the light: what a millimetre of lit air far behind it gives is lost among the
// last digits of what lies before. Integrated for itself it is not.
Test(published, signed_sums_cancel_and_intervals_do_not)
{
    const PointCase cases[] = {{1e-3f, 1, 1e-5f, 5, 5.001f, 0.1f},
                               {1e-3f, 1, 1e-5f, 0, 5.001f, 0.1f},
                               {1e-3f, 1, 1e-5f, 0, 5, 0.1f}};
    gl_open(GL_PLATFORM_OSMESA, 16, 16, "test");
    float *got = bench_run("point.comp", "PHASE 0", NULL, cases, sizeof *cases, 3, 2);
    cr_assert(relative(&cases[0], got[0]) < 1e-5, "interval: off by %g", relative(&cases[0], got[0]));
    cr_assert(relative(&cases[0], got[2] - got[4]) > 1e-1, "signed: off by %g",
              relative(&cases[0], got[2] - got[4]));
    free(got);
    gl_close();
}
