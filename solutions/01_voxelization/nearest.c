// Exercise 01.4: runs the stages of nearest.comp, which is the file to work in.
//
// INPUT   the number of voxels; then 2 numbers a fragment: its voxel, its distance
// OUTPUT  1 number a voxel: the winning fragment's number, from 0, or -1
#include "exercise.h"
#include "shader.h"

#include <stdlib.h>

int main(int argc, char **argv)
{
    Exercise exercise = exercise_open(argc, argv);
    size_t voxels = exercise.count ? (size_t)exercise.input[0] : 0;
    if (voxels < 1 || exercise.count < 3)
        fail_work("the input is too short");
    size_t fragments = (exercise.count - 1) / 2, bytes = voxels * sizeof(float);

    gl_open(gl_headless_platform(), 1, 1, "nearest");
    shader_search_first(exercise_folder(__FILE__));
    Shader *shader = shader_open("nearest", NULL, "nearest.comp");
    GLuint list =
        gl_buffer(.label = "fragments", .bytes = 2 * fragments * sizeof(float), .data = exercise.input + 1);
    GLuint words = gl_buffer(.label = "words", .bytes = 2 * voxels * sizeof(uint32_t));
    GLuint winners = gl_buffer(.label = "winners", .bytes = bytes);
    GLuint buffers[] = {list, words, winners};
    for (GLuint binding = 0; binding < 3; binding++)
        gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffers[binding]);

    shader_use(shader);
    for (int stage = 0; stage < 4; stage++) {
        size_t items = stage == 1 || stage == 2 ? fragments : voxels;
        shader_set_int(shader, "stage", stage);
        shader_set_int(shader, "item_count", (int)items);
        gl.DispatchCompute((GLuint)(items + 63) / 64, 1, 1);
        gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    }

    float *output = memory_new(voxels, sizeof *output, "winners");
    gl_buffer_read(winners, 0, bytes, output);
    for (int i = 0; i < 3; i++)
        gl_buffer_delete(&buffers[i]);
    shader_close(shader);
    gl_close();
    int status = exercise_close(&exercise, output, voxels);
    free(output);
    return status;
}
