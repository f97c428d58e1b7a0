// inputs_01: what chapter 01's exercises are given.
#include "inputs.h"

#include <stdlib.h>

// --- 01.1: triangles of 9 numbers

static void corners_draw(int corner[9], int reach, uint64_t *random)
{
    for (int k = 0; k < 9; k++)
        corner[k] = input_between(random, -reach, reach);
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

// --- 01.2: the grid's size, then triangles. Corners in steps of 1/8 below 16: every product below 2^24 of its unit, so each sign is
// the same in any precision and order.

static void grid_head(Input *input, const Shape *shape)
{
    for (int k = 0; k < 3; k++)
        input_add(input, shape->size[k]);
}

// Whether the triangle's plane (corners in eighths) meets one of the three segments of a voxel in its box at an end exactly: there the answer is a rule's,
// which one check asks for and the others leave alone.
static bool meets_a_face_centre(const int corner[9], const int64_t normal[3])
{
    int low[3], high[3], voxel[3];
    for (int k = 0; k < 3; k++) {
        low[k] = high[k] = corner[k];
        for (int i = 1; i < 3; i++) {
            low[k] = corner[3 * i + k] < low[k] ? corner[3 * i + k] : low[k];
            high[k] = corner[3 * i + k] > high[k] ? corner[3 * i + k] : high[k];
        }
    }
    for (voxel[2] = low[2] / 8 - 1; voxel[2] <= high[2] / 8; voxel[2]++)
        for (voxel[1] = low[1] / 8 - 1; voxel[1] <= high[1] / 8; voxel[1]++)
            for (voxel[0] = low[0] / 8 - 1; voxel[0] <= high[0] / 8; voxel[0]++) {
                int64_t distance = 0;
                for (int k = 0; k < 3; k++)
                    distance += normal[k] * (corner[k] - 8 * voxel[k] - 4);
                for (int k = 0; k < 3; k++)
                    if (normal[k] && llabs(distance) == 4 * llabs(normal[k]))
                        return true;
            }
    return false;
}

static void triangle_turn(int corner[9])
{
    for (int k = 3; k < 6; k++) {
        int other = corner[k + 3];
        corner[k + 3] = corner[k];
        corner[k] = other;
    }
}

// Four triangles across the grid, slanted to every axis: no component of a normal below a quarter of the largest, which points along its axis and
// against it by turns.
static void thin_oblique(Input *input, const Shape *shape, uint64_t *random)
{
    enum { COUNT = 4 };
    grid_head(input, shape);
    for (int i = 0; i < COUNT; i++) {
        int corner[9];
        int64_t normal[3], most, least;
        do {
            for (int k = 0; k < 9; k++)
                corner[k] = input_between(random, 0, 8 * shape->size[k % 3]);
            normal_of(corner, normal);
            most = least = normal[0];
            for (int k = 1; k < 3; k++) {
                most = llabs(normal[k]) > llabs(most) ? normal[k] : most;
                least = llabs(normal[k]) < llabs(least) ? normal[k] : least;
            }
            // at least 16 square voxels, seen along its axis
        } while (4 * llabs(least) < llabs(most) || llabs(most) < 32 * 64 ||
                 meets_a_face_centre(corner, normal));
        if ((most > 0) != (i % 2 == 0))
            triangle_turn(corner);
        for (int k = 0; k < 9; k++)
            input_add(input, corner[k] / 8.0);
    }
}

// Triangles of about two voxels.
static void thin_small(Input *input, const Shape *shape, uint64_t *random)
{
    enum { COUNT = 40 };
    grid_head(input, shape);
    for (int i = 0; i < COUNT; i++) {
        int corner[9] = {0};
        int64_t normal[3];
        do {
            for (int k = 0; k < 9; k++) {
                int most = 8 * shape->size[k % 3];
                corner[k] =
                    k < 3 ? input_between(random, 0, most) : corner[k - 3] + input_between(random, -20, 20);
                corner[k] = corner[k] < 0 ? 0 : corner[k] > most ? most : corner[k];
            }
            normal_of(corner, normal);
        } while ((!normal[0] && !normal[1] && !normal[2]) || meets_a_face_centre(corner, normal));
        for (int k = 0; k < 9; k++)
            input_add(input, corner[k] / 8.0);
    }
}

// Walls of two triangles in the faces between voxels, one along each axis, their borders through voxel centres.
static void thin_walls(Input *input, const Shape *shape, uint64_t *random)
{
    grid_head(input, shape);
    bool turned = input_between(random, 0, 1); // every other wall
    for (int axis = 0; axis < 3; axis++) {
        int u = (axis + 1) % 3, v = (axis + 2) % 3;
        double corner[4][3];
        int at = input_between(random, 2, shape->size[axis] - 2);
        double low[2], high[2];
        for (int k = 0; k < 2; k++) {
            int size = shape->size[k ? v : u];
            low[k] = 0.5 + input_between(random, 0, size / 2 - 2);
            high[k] = 0.5 + input_between(random, size / 2 + 1, size - 1);
        }
        for (int i = 0; i < 4; i++) {
            corner[i][axis] = at;
            corner[i][u] = i == 1 || i == 2 ? high[0] : low[0];
            corner[i][v] = i >= 2 ? high[1] : low[1];
        }
        turned = !turned;
        static const int order[2][6] = {{0, 1, 2, 0, 2, 3}, {0, 2, 1, 0, 3, 2}};
        for (int i = 0; i < 6; i++)
            for (int k = 0; k < 3; k++)
                input_add(input, corner[order[turned][i]][k]);
    }
}

// --- 01.4: the number of voxels, then (voxel, distance) a fragment

enum { A_VOXEL = 24 }; // fragments, at most

// Every voxel but some gets a few fragments, `distance` says how far; all of them shuffled.
static void fragments_draw(Input *input, const Shape *shape, uint64_t *random,
                           double (*distance)(int fragment, uint64_t *random))
{
    input_add(input, shape->size[0]);
    size_t begin = input->count;
    for (int voxel = 0; voxel < shape->size[0]; voxel++) {
        int fragments = input_between(random, 0, 7) == 0 ? 0 : input_between(random, 6, A_VOXEL);
        for (int i = 0; i < fragments; i++) {
            input_add(input, voxel);
            input_add(input, distance(i, random));
        }
    }
    for (size_t i = (input->count - begin) / 2; i > 1; i--) {
        float *a = input->values + begin + 2 * (i - 1);
        float *b = input->values + begin + 2 * (size_t)input_between(random, 0, (int)i - 1);
        for (int k = 0; k < 2; k++) {
            float other = a[k];
            a[k] = b[k];
            b[k] = other;
        }
    }
}

static double distance_apart(int fragment, uint64_t *random)
{
    (void)random;
    return (fragment + 1) / 32.0;
}

static double distance_equal(int fragment, uint64_t *random)
{
    (void)fragment;
    return input_between(random, 1, 3) / 4.0;
}

static double distance_close(int fragment, uint64_t *random)
{
    (void)random;
    return 0.5 + (fragment + 1) / 1048576.0;
}

static void nearest_crowd(Input *input, const Shape *shape, uint64_t *random)
{
    fragments_draw(input, shape, random, distance_apart);
}

static void nearest_ties(Input *input, const Shape *shape, uint64_t *random)
{
    fragments_draw(input, shape, random, distance_equal);
}

static void nearest_close(Input *input, const Shape *shape, uint64_t *random)
{
    fragments_draw(input, shape, random, distance_close);
}

const Generator inputs_01[] = {{"triangles_random", triangles_random},
                               {"triangles_small", triangles_small},
                               {"triangles_ties", triangles_ties},
                               {"thin_oblique", thin_oblique},
                               {"thin_small", thin_small},
                               {"thin_walls", thin_walls},
                               {"nearest_crowd", nearest_crowd},
                               {"nearest_ties", nearest_ties},
                               {"nearest_close", nearest_close},
                               {NULL, NULL}};
