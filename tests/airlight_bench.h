// airlight_bench: what the tests of chapter 04 share: GLSL run on lists of inputs.
#ifndef AIRLIGHT_BENCH_H
#define AIRLIGHT_BENCH_H

#include "shader.h"
#include "truth.h"

#include <criterion/criterion.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

// Run a shader of tests/data/airlight over `count` inputs; the caller frees the `results` floats a input.
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

#endif
