// Exercise 06.3: shadow that begins behind the surface. What you write stands in before_it.comp; this runs it.
//
// The lesson keeps 32 φ in a word and scans along α word by word: inclusive, so that a voxel with a surface in it is in shadow. Asked whether that surface is
// lit, such a volume says no: it shades itself. Here a word holds 32 α of one light ray, and a voxel is in shadow if a surface lies in a voxel before
// it, nearer to the light; the surface's own voxel is lit, if no other is before it.
//
// INPUT   1 number a voxel, 128 along each light ray, nearest to the light first: 1 where a surface is, else 0
// OUTPUT  1 number a voxel: 1 in shadow, 0 lit
// A loop over 128 bits is right, too; four steps a ray are enough.
//
// Check it with: make check EX=06.3
#include "exercise.h"
#include "shader.h"

#include <stdlib.h>

enum { VOXELS = 128, GROUP = 8 };

int main(int argc, char **argv)
{
    Exercise exercise = exercise_open(argc, argv);
    size_t rays = exercise.count / VOXELS, count = rays * VOXELS, bytes = count / 32 * sizeof(uint32_t);
    uint32_t *words = memory_new(count / 32, sizeof *words, "words");
    for (size_t i = 0; i < count; i++)
        words[i / 32] |= (uint32_t)(exercise.input[i] != 0.0f) << i % 32;

    gl_open(gl_headless_platform(), 0, 0, "");
    shader_search_first(exercise_folder(__FILE__));
    Shader *shader = shader_open("before it", NULL, "before_it.comp");
    GLuint buffer = gl_buffer(.label = "words", .bytes = bytes, .data = words);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, buffer);
    shader_use(shader);
    gl.DispatchCompute((GLuint)((rays + GROUP - 1) / GROUP), 1, 1);
    gl.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    gl_buffer_read(buffer, 0, bytes, words);
    gl_buffer_delete(&buffer);
    shader_close(shader);
    gl_close();

    float *output = memory_new(count, sizeof *output, "voxels");
    for (size_t i = 0; i < count; i++)
        output[i] = (float)(words[i / 32] >> i % 32 & 1);
    int status = exercise_close(&exercise, output, count);
    free(output);
    free(words);
    return status;
}
