// Exercise 04.1: equal angles at their limit. What you write stands in equal_angles.comp; this runs it.
//
// INPUT   6 numbers a sample: the lamp's distance from the ray's line; the foot, the ray's nearest point to the lamp (metres from the eye);
//         the lamp's radius; the stretch from, to; and x between 0 and 1
// OUTPUT  2 numbers a sample: the place t, in metres from the eye, and dt/dx
//
// Check it with: make check EX=04.1
#include "exercise.h"
#include "shader.h"

#include <stdlib.h>

int main(int argc, char **argv)
{
    enum { NUMBERS = 6, GROUP = 8 };
    Exercise exercise = exercise_open(argc, argv);
    size_t samples = exercise.count / NUMBERS, bytes = 2 * samples * sizeof(float);
    gl_open(gl_headless_platform(), 0, 0, "");
    shader_search_first(exercise_folder(__FILE__));
    Shader *shader = shader_open("equal angles", NULL, "equal_angles.comp");
    GLuint numbers =
        gl_buffer(.label = "samples", .bytes = exercise.count * sizeof(float), .data = exercise.input);
    GLuint places = gl_buffer(.label = "places", .bytes = bytes);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, numbers);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, places);
    shader_use(shader);
    gl.DispatchCompute((GLuint)((samples + GROUP - 1) / GROUP), 1, 1);
    gl.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    float *output = memory_new(2 * samples, sizeof *output, "places");
    gl_buffer_read(places, 0, bytes, output);
    gl_buffer_delete(&numbers);
    gl_buffer_delete(&places);
    shader_close(shader);
    gl_close();
    int status = exercise_close(&exercise, output, 2 * samples);
    free(output);
    return status;
}
