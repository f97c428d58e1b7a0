// inputs_01: what chapter 01's exercises are given.
#include "inputs.h"

#include <stdlib.h>

// --- 01.1: triangles of 9 numbers

static void corners_draw(int corner[9], int reach, uint64_t *random)
{
    for (int k = 0; k < 9; k++)
        corner[k] = random_between(random, -reach, reach);
}

static void normal_of(const int corner[9], int64_t normal[3])
{
    int64_t u[3], v[3];
    for (int k = 0; k < 3; k++) {
        u[k] = corner[3 + k] - corner[k];
        v[k] = corner[6 + k] - corner[k];
    }
    for (int k = 0; k < 3; k++)
        normal[k] = u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];
}

// The second largest of |n| is below 7/8 of the largest: far from a tie in any precision.
static bool is_clear(const int64_t normal[3])
{
    int64_t x = llabs(normal[0]), y = llabs(normal[1]), z = llabs(normal[2]);
    int64_t most = x > y ? x : y, middle = x > y ? y : x;
    middle = z > most ? most : z > middle ? z : middle;
    most = z > most ? z : most;
    return 8 * middle < 7 * most;
}

// Corners in steps of `unit`, a power of two, from -1024 to 1024 of them.
static void triangles_clear(Input *input, const Shape *shape, uint64_t *random, double unit)
{
    input->stride = 9;
    for (int i = 0; i < shape->size[0]; i++) {
        int corner[9];
        int64_t normal[3];
        do {
            corners_draw(corner, 1024, random);
            normal_of(corner, normal);
        } while (!is_clear(normal));
        for (int k = 0; k < 9; k++)
            input_add(input, unit * corner[k]);
    }
}

static void triangles_random(Input *input, const Shape *shape, uint64_t *random)
{
    triangles_clear(input, shape, random, 1.0 / 64);
}

static void triangles_small(Input *input, const Shape *shape, uint64_t *random)
{
    triangles_clear(input, shape, random, 1.0 / 16777216);
}

// Two or three components of equal size, and the largest: corners are drawn until the exact normal says so.
static void triangles_ties(Input *input, const Shape *shape, uint64_t *random)
{
    input->stride = 9;
    for (int i = 0; i < shape->size[0]; i++) {
        int corner[9];
        int64_t normal[3];
        bool tie;
        do {
            corners_draw(corner, 6, random);
            normal_of(corner, normal);
            int64_t x = llabs(normal[0]), y = llabs(normal[1]), z = llabs(normal[2]);
            // by turns: x and y, y and z, z and x, all three
            tie = i % 4 == 0   ? x == y && x > z
                  : i % 4 == 1 ? y == z && y > x
                  : i % 4 == 2 ? z == x && z > y
                               : x == y && y == z && x > 0;
        } while (!tie);
        for (int k = 0; k < 9; k++)
            input_add(input, corner[k]);
    }
}

const Generator inputs_01[] = {{"triangles_random", triangles_random},
                               {"triangles_small", triangles_small},
                               {"triangles_ties", triangles_ties},
                               {NULL, NULL}};
