// Exercise 01.3: how many times does a closed line run around a point?
//
// Filling a mesh by parity asks whether a ray from a point crosses the surface an odd number of times. Where a surface overlaps itself,
// parity empties what is covered twice. The winding number does not: count a crossing upwards as +1 and one downwards as -1.
// In two dimensions, then: a ray from the point p towards +x, against the edges of a closed polygon.
//
// INPUT   the number n of corners; n corners x, y, the last joined to the first; then points x, y
// OUTPUT  1 number a point: how many times the polygon runs around it counter-clockwise (negative: clockwise)
// On the border the rule is half-open: an edge owns its lower end and not its upper one, so that of two edges which meet at p's own height one
// is counted; and a ray that begins on an edge does not cross it. Horizontal edges count for nothing.
//
// Check it with: make check EX=01.3
#include "exercise.h"

#include <math.h>
#include <stdlib.h>

// +1 where the ray from p towards +x crosses the edge from a to b upwards, -1 downwards, 0 where it does not.
static int crossing(const float a[2], const float b[2], const float p[2])
{
    // Yours: this never crosses.
    (void)a, (void)b, (void)p;
    return 0;
}

static int winding(const float *corners, size_t count, const float p[2])
{
    int sum = 0;
    for (size_t i = 0; i < count; i++)
        sum += crossing(corners + 2 * i, corners + 2 * ((i + 1) % count), p);
    return sum;
}

int main(int argc, char **argv)
{
    Exercise exercise = exercise_open(argc, argv);
    size_t corners = exercise.count ? (size_t)exercise.input[0] : 0;
    if (exercise.count < 1 + 2 * corners)
        fail_work("the input is too short");
    size_t points = (exercise.count - 1 - 2 * corners) / 2;
    const float *corner = exercise.input + 1, *point = corner + 2 * corners;
    float *windings = memory_new(points, sizeof *windings, "windings");
    for (size_t i = 0; i < points; i++)
        windings[i] = (float)winding(corner, corners, point + 2 * i);
    int status = exercise_close(&exercise, windings, points);
    free(windings);
    return status;
}
