// Exercise 02.3: how wide is the penumbra?
//
// A lamp has a size, and the shadow of a thing far above the floor is blurred. The map knows only the lamp's middle, yet the width can be
// estimated (Fernando 2005): take the mean depth of what blocks the light near the receiver, and similar triangles do the rest.
//
// INPUT   lamp's width in metres; texels along the map's side, n; n·n depths in metres, x fastest; then 4 numbers a receiver: its place x, y in
//         texels (texel (i, j) has its centre at (i + ½, j + ½)), its depth, and the search's radius r in texels
// OUTPUT  1 number a receiver: the penumbra's width in metres, 0 where nothing blocks
// Lamp, blockers and receiver lie in parallel planes; depths count from the lamp's. A texel is asked where its centre lies in the square of
// side 2r about the place, border included, and blocks where it is nearer to the lamp than the receiver: as near does not block.
//
// Check it with: make check EX=02.3
#include "exercise.h"

#include <math.h>
#include <stdlib.h>

static float penumbra_width(float lamp, const float *depths, int texels, float x, float y, float depth,
                            float radius)
{
    // Yours: this is as wide as the lamp everywhere.
    (void)depths, (void)texels, (void)x, (void)y, (void)depth, (void)radius;
    return lamp;
}

int main(int argc, char **argv)
{
    Exercise exercise = exercise_open(argc, argv);
    const float *in = exercise.input;
    int texels = exercise.count > 2 ? (int)in[1] : 0;
    size_t map = (size_t)texels * (size_t)texels;
    if (exercise.count < 2 + map)
        fail_work("the input is too short");
    size_t receivers = (exercise.count - 2 - map) / 4;
    float *widths = memory_new(receivers, sizeof *widths, "widths");
    for (size_t r = 0; r < receivers; r++) {
        const float *one = in + 2 + map + 4 * r;
        widths[r] = penumbra_width(in[0], in + 2, texels, one[0], one[1], one[2], one[3]);
    }
    int status = exercise_close(&exercise, widths, receivers);
    free(widths);
    return status;
}
