// Exercise 06.2: triangles across the seam of θ, and around the axis.
//
// θ goes round: slice 31 of 32 and slice 0 are neighbours. A triangle that lies in both looks, by its corners' θ, as wide as the grid. And one that the axis
// pierces between eye and light lies in every slice: it covers all φ from 0, which is the axis, up to its edges. Draw both right (Wyman 2011, section 4.1.1:
// the wrap split, and the epipole's two virtual vertices).
//
// INPUT   6 numbers a triangle: (θ, φ) of its three corners, θ from 0 to 32 in slices, φ from 0 to 16 in voxels
// OUTPUT  1 number a voxel, 32 θ by 16 φ, θ fastest: 1 where its middle (i + ½, j + ½) lies in any triangle, else 0
// An edge goes straight from corner to corner in (θ, φ), the short way round: by less than 16 slices. No middle lies on an edge.
//
// Check it with: make check EX=06.2
#include "exercise.h"

#include <math.h>
#include <stdlib.h>

enum { SLICES = 32, PHI = 16 };

typedef struct Corner {
    float theta, phi;
} Corner;

#ifdef SOLUTION
// From one θ to another the short way round.
static float turn(float from, float to)
{
    float straight = to - from;
    return straight - (float)SLICES * roundf(straight / (float)SLICES);
}

#endif
// The polygon that a triangle is once θ is allowed to leave [0, SLICES). Returns how many corners it has.
static int unrolled(const Corner triangle[3], Corner polygon[6])
{
#ifdef SOLUTION
    Corner at = triangle[0];
    for (int i = 0; i < 3; i++) {
        polygon[i] = at;
        at.theta += turn(triangle[i].theta, triangle[(i + 1) % 3].theta);
        at.phi = triangle[(i + 1) % 3].phi;
    }
    if (fabsf(at.theta - triangle[0].theta) < 0.5f * (float)SLICES)
        return 3; // back where it began
    // Once around: the first corner again, a whole turn on, and back along the axis.
    polygon[3] = at;
    polygon[4] = (Corner){at.theta, 0.0f};
    polygon[5] = (Corner){triangle[0].theta, 0.0f};
    return 6;
#else
    // Yours: this is a polygon without corners, and covers nothing.
    (void)triangle, (void)polygon;
    return 0;
#endif
}

// By parity: whether a ray from here towards +θ crosses an odd number of edges.
static bool inside(const Corner *polygon, int corners, float theta, float phi)
{
    bool odd = false;
    for (int i = 0; i < corners; i++) {
        Corner a = polygon[i], b = polygon[(i + 1) % corners];
        if ((a.phi > phi) == (b.phi > phi))
            continue;
        float left = (a.theta - theta) * (b.phi - phi) - (b.theta - theta) * (a.phi - phi);
        odd ^= (b.phi > a.phi) == (left > 0.0f);
    }
    return odd;
}

static bool covers(const Corner triangle[3], float theta, float phi)
{
    Corner polygon[6];
    int corners = unrolled(triangle, polygon);
#ifdef SOLUTION
    // What was unrolled reaches a turn to either side: each voxel stands at three places.
    return inside(polygon, corners, theta, phi) || inside(polygon, corners, theta + (float)SLICES, phi) ||
           inside(polygon, corners, theta - (float)SLICES, phi);
#else
    // Yours, too, where the polygon has left the grid.
    return inside(polygon, corners, theta, phi);
#endif
}

int main(int argc, char **argv)
{
    Exercise exercise = exercise_open(argc, argv);
    size_t triangles = exercise.count / 6;
    float *voxels = memory_new(SLICES * PHI, sizeof *voxels, "voxels");
    for (size_t t = 0; t < triangles; t++) {
        const float *in = exercise.input + 6 * t;
        Corner triangle[3] = {{in[0], in[1]}, {in[2], in[3]}, {in[4], in[5]}};
        for (int j = 0; j < PHI; j++)
            for (int i = 0; i < SLICES; i++)
                if (covers(triangle, (float)i + 0.5f, (float)j + 0.5f))
                    voxels[j * SLICES + i] = 1.0f;
    }
    int status = exercise_close(&exercise, voxels, SLICES * PHI);
    free(voxels);
    return status;
}
