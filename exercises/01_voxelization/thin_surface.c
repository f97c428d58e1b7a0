// Exercise 01.2: a surface one voxel thick.
//
// The lesson's voxels are those that a triangle touches: none is missing, and a slanted wall is two or three voxels thick. For drawing a
// surface, or for asking whether light passes, less will do. Each voxel has three segments that join the centres of its opposite faces and
// cross at its centre. Set the voxel if the triangle crosses one of them (Schwarz and Seidel 2010, section 4.2: the 6-separating
// surface; Laine 2013 gives the reason why no path through faces slips through).
//
// INPUT   size x, y, z of the grid; then 9 numbers a triangle: its corners, in voxels from the grid's corner
// OUTPUT  1 number a voxel, x fastest: 1 set, 0 not
// Voxel (x, y, z) reaches from (x, y, z) to (x+1, y+1, z+1). A triangle's edges belong to it. A segment owns its lower end and not its
// upper: a wall that lies in the face between two voxels sets one layer, not two.
//
// Check it with: make check EX=01.2
#include "exercise.h"
#include "linear.h"

#include <stdlib.h>

static bool is_set(const vec3 p[3], vec3 centre)
{
    // Yours: this sets nothing.
    (void)p, (void)centre;
    return false;
}

int main(int argc, char **argv)
{
    Exercise exercise = exercise_open(argc, argv);
    if (exercise.count < 3)
        fail_work("the input is too short");
    const float *in = exercise.input;
    int size[3] = {(int)in[0], (int)in[1], (int)in[2]};
    size_t count = (size_t)size[0] * (size_t)size[1] * (size_t)size[2], triangles = (exercise.count - 3) / 9;
    float *voxels = memory_new(count, sizeof *voxels, "voxels");
    for (size_t t = 0; t < triangles; t++) {
        const float *c = in + 3 + 9 * t;
        vec3 p[3] = {vec3_make(c[0], c[1], c[2]), vec3_make(c[3], c[4], c[5]), vec3_make(c[6], c[7], c[8])};
        for (size_t i = 0; i < count; i++) {
            size_t x = i % (size_t)size[0], row = i / (size_t)size[0];
            size_t y = row % (size_t)size[1], z = row / (size_t)size[1];
            if (is_set(p, vec3_make((float)x + 0.5f, (float)y + 0.5f, (float)z + 0.5f)))
                voxels[i] = 1.0f;
        }
    }
    int status = exercise_close(&exercise, voxels, count);
    free(voxels);
    return status;
}
