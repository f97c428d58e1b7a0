// Exercise 02.1: a bias from the texel's size. What you write stands in slope_bias.comp; this runs it.
//
// INPUT   7 numbers a receiver: metres that a texel covers there; the surface's normal; the way to the light (both of any length)
// OUTPUT  1 number a receiver: texel · (½ + tan θ) in metres, θ between normal and light. cos θ is held at 1/1000 at least: a surface that
//         faces away is dark whatever the map says, but its bias must be a number
//
// Check it with: make check EX=02.1
#include "exercise.h"
#include "shader.h"

#include <stdlib.h>

int main(int argc, char **argv)
{
    enum { NUMBERS = 7, GROUP = 8 };
    Exercise exercise = exercise_open(argc, argv);
    size_t receivers = exercise.count / NUMBERS;
    gl_open(gl_headless_platform(), 0, 0, "");
    shader_search_first(exercise_folder(__FILE__));
    Shader *shader = shader_open("slope bias", NULL, "slope_bias.comp");
    GLuint numbers =
        gl_buffer(.label = "receivers", .bytes = exercise.count * sizeof(float), .data = exercise.input);
    GLuint biases = gl_buffer(.label = "biases", .bytes = receivers * sizeof(float));
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, numbers);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, biases);
    shader_use(shader);
    gl.DispatchCompute((GLuint)((receivers + GROUP - 1) / GROUP), 1, 1);
    gl.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    float *output = memory_new(receivers, sizeof *output, "biases");
    gl_buffer_read(biases, 0, receivers * sizeof *output, output);
    gl_buffer_delete(&numbers);
    gl_buffer_delete(&biases);
    shader_close(shader);
    gl_close();
    int status = exercise_close(&exercise, output, receivers);
    free(output);
    return status;
}
