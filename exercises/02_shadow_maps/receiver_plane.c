// Exercise 02.2: where each texel's ray meets the receiver's plane.
//
// A filter compares one receiver with many texels. The lesson's bias makes room for the steepest of them and loses shadows where things touch.
// No guess is needed: the receiver lies on a plane that is known, and each texel has a ray of its own. Compare each texel with the distance
// at which its ray meets that plane (Isidoro 2006 takes the plane's slope in the map; here the rays are exact).
//
// INPUT   8 numbers a receiver: texels along the map's side; tangent of the map's half angle; a point on the surface (x, y, z); its normal
//         (x, y, z; any length, either side). The light stands at the origin and looks along +z; the map's x and y are the point's
// OUTPUT  9 numbers a receiver: Euclidean distances from the light, for the 3 by 3 texels about the one that holds the point, rows from low y
//         to high, each from low x to high
// Texel (i, j) of n by n covers the places 2i/n - 1 to 2(i + 1)/n - 1; place (u, v) lies on the ray through (u·tangent, v·tangent, 1).
// A ray that never meets the plane before the light takes the receiver's own distance.
//
// Check it with: make check EX=02.2
#include "exercise.h"
#include "linear.h"

#include <stdlib.h>

static float distance_on_plane(vec3 ray, vec3 point, vec3 normal)
{
    // Yours: this asks every texel for the receiver's own distance.
    (void)ray, (void)normal;
    return vec3_length(point);
}

static vec3 texel_ray(int i, int j, float texels, float tangent)
{
    // Yours: this is the axis, whatever the texel.
    (void)i, (void)j, (void)texels, (void)tangent;
    return vec3_make(0, 0, 1);
}

int main(int argc, char **argv)
{
    Exercise exercise = exercise_open(argc, argv);
    size_t receivers = exercise.count / 8;
    float *output = memory_new(9 * receivers, sizeof *output, "distances");
    for (size_t r = 0; r < receivers; r++) {
        const float *in = exercise.input + 8 * r;
        float texels = in[0], tangent = in[1];
        vec3 point = vec3_make(in[2], in[3], in[4]), normal = vec3_make(in[5], in[6], in[7]);
        int i = (int)floorf((0.5f * point[0] / (point[2] * tangent) + 0.5f) * texels);
        int j = (int)floorf((0.5f * point[1] / (point[2] * tangent) + 0.5f) * texels);
        for (int k = 0; k < 9; k++) {
            vec3 ray = texel_ray(i + k % 3 - 1, j + k / 3 - 1, texels, tangent);
            output[9 * r + (size_t)k] = distance_on_plane(ray, point, normal);
        }
    }
    int status = exercise_close(&exercise, output, 9 * receivers);
    free(output);
    return status;
}
