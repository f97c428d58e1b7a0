// airlight_bench: what the tests of chapter 04 share: GLSL run on lists of inputs, and the list of stiff ones.
#ifndef AIRLIGHT_BENCH_H
#define AIRLIGHT_BENCH_H

#include "shader.h"
#include "truth.h"

#include <criterion/criterion.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

// Run a shader of tests/data/airlight over `count` inputs; the caller frees the `results` floats an input.
static inline float *bench_run(const char *file, const char *definitions, const TruthPhase *phase,
                               const void *inputs, size_t input_bytes, size_t count, size_t results)
{
    shader_search_first("tests/data/airlight");
    Shader *shader = shader_open(file, definitions, file);
    const size_t bytes = count * results * sizeof(float);
    GLuint in = gl_buffer(.label = "inputs", .bytes = count * input_bytes, .data = inputs);
    GLuint out = gl_buffer(.label = "results", .bytes = bytes);
    float *got = memory_new(count * results, sizeof *got, "results");
    shader_use(shader);
    if (phase) {
        shader_set_float(shader, "mean_cosine", (float)phase->mean_cosine);
        shader_set_float(shader, "rayleigh_share", (float)phase->rayleigh_share);
    }
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, in);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, out);
    gl.DispatchCompute((GLuint)(count + 7) / 8, 1, 1);
    gl.MemoryBarrier(GL_ALL_BARRIER_BITS);
    gl_buffer_read(out, 0, bytes, got);
    gl_buffer_delete(&in);
    gl_buffer_delete(&out);
    shader_close(shader);
    return got;
}

static inline bool normal_float(double x)
{
    return x >= 1.2e-38 && x <= 3.4e38;
}

typedef struct PointCase {
    float nearest, foot, radius, from, to, sigma;
} PointCase;

static inline double point_truth(const PointCase *c, const TruthPhase *phase)
{
    return truth_airlight_point((double)c->nearest, (double)c->foot, (double)c->radius, (double)c->from,
                                (double)c->to, (double)c->sigma, phase);
}

// A ray's stretch of length 1, or a millionth, none, or without end; the light from on its line to 10^6 away, at, before and behind either end; optical depth
// 0 and 10^-6 to 10^4.
enum { STIFF_CASES = 9 * 12 * 6 * 9 };
static inline size_t stiff_cases(PointCase *cases)
{
    static const float sides[] = {0, 1e-6f, 1e-4f, 1e-2f, 0.3f, 1, 1e2f, 1e4f, 1e6f};
    static const float feet[] = {-1e6f, -1, -1e-6f, 0, 1e-6f, 0.25f, 0.7f, 1, 1.000001f, 2, 1e3f, 1e6f};
    static const float ends[][2] = {{0, 1},         {0, INFINITY}, {1e-5f, 1}, {0.5f, 0.5000001f},
                                    {0.25f, 0.25f}, {0, 1e-6f}};
    static const float sigmas[] = {0, 1e-6f, 1e-3f, 0.1f, 1, 7, 60, 1e3f, 1e4f};
    static const float radii[] = {1e-4f, 1e-9f, 0.05f};
    for (size_t i = 0; i < STIFF_CASES; i++)
        cases[i] = (PointCase){sides[i % 9],         feet[i / 9 % 12],     radii[i / 7 % 3],
                               ends[i / 108 % 6][0], ends[i / 108 % 6][1], sigmas[i / 648]};
    return STIFF_CASES;
}

// Every stiff case against the truth.
static inline void check_stiff(const char *definitions, const TruthPhase *phase, double tolerance)
{
    static PointCase cases[STIFF_CASES];
    const size_t count = stiff_cases(cases);
    gl_open(GL_PLATFORM_OSMESA, 16, 16, "test");
    float *got = bench_run("point.comp", definitions, phase, cases, sizeof *cases, count, 2);
    size_t compared = 0;
    for (size_t i = 0; i < count; i++) {
        const PointCase *c = &cases[i];
        const double expected = point_truth(c, phase), value = (double)got[2 * i],
                     error = fabs(value - expected);
        char *where = text_format("%g for %g: nearest %g foot %g radius %g [%g, %g] sigma %g", value,
                                  expected, (double)c->nearest, (double)c->foot, (double)c->radius,
                                  (double)c->from, (double)c->to, (double)c->sigma);
        cr_assert(isfinite(value), "%s", where);
        if (c->from == c->to)
            cr_assert_eq(value, 0.0, "%s", where);
        // What is no normal float may come out as 0, which this renderer makes of it.
        if (normal_float(expected)) {
            cr_assert(error <= tolerance * expected, "off by %g: %s", error / expected, where);
            compared++;
        }
        free(where);
    }
    cr_assert(compared > count / 3, "only %zu of %zu values are normal floats", compared, count);
    free(got);
    gl_close();
}

#endif
