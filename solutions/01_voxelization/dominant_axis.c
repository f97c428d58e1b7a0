// Exercise 01.1: the axis along which a triangle looks largest.
//
// INPUT   9 numbers a triangle: the three corners p0, p1, p2
// OUTPUT  1 number a triangle: 0 for x, 1 for y, 2 for z
// Where two axes tie, the later one wins: z before y before x.
//
// Check it with: make check EX=01.1
#include "exercise.h"
#include "linear.h"

#include <stdlib.h>

static int dominant_axis(vec3 p0, vec3 p1, vec3 p2)
{
#ifdef SOLUTION
    // The projection along an axis has the area ½ |n·axis|: the normal's largest component, whichever way it points.
    vec3 normal = vec3_cross(p1 - p0, p2 - p0);
    float x = fabsf(normal[0]), y = fabsf(normal[1]), z = fabsf(normal[2]);
    return z >= fmaxf(x, y) ? 2 : y >= x ? 1 : 0;
#else
    // Yours: this says z for every triangle.
    (void)p0, (void)p1, (void)p2;
    return 2;
#endif
}

int main(int argc, char **argv)
{
    Exercise exercise = exercise_open(argc, argv);
    size_t triangles = exercise.count / 9;
    float *axes = memory_new(triangles, sizeof *axes, "axes");
    for (size_t i = 0; i < triangles; i++) {
        const float *p = exercise.input + 9 * i;
        axes[i] = (float)dominant_axis(vec3_make(p[0], p[1], p[2]), vec3_make(p[3], p[4], p[5]),
                                       vec3_make(p[6], p[7], p[8]));
    }
    int status = exercise_close(&exercise, axes, triangles);
    free(axes);
    return status;
}
