// 06 epipolar voxelized shadow volumes: how light rays are spread over φ, and what it gains where.
#define BENCH_SIDE 48
#include "vsv_bench.h"

// rel_rmse against the same map without a grid, by few light rays, many slices and view rays: φ is the axis that is too coarse.
typedef struct Spread {
    double even, square, borders;
} Spread;
static Spread spread_errors(const char *scene, const char *integral)
{
    Bench bench = bench_open(scene, 128);
    bench.settings.asked.integral = integral;
    bench.settings.asked.filtered = strcmp(integral, "prefix") == 0;
    bench.settings.volume.theta = 512;
    Image exact = bench_segments(&bench, true);
    const char *const warps[] = {"even", "square", "borders"};
    double errors[3];
    for (int i = 0; i < 3; i++) {
        bench.settings.volume.warp = warps[i];
        errors[i] = bench_error(&bench, &exact).rel_rmse;
    }
    image_free(&exact);
    bench_close(&bench);
    return (Spread){errors[0], errors[1], errors[2]};
}

// With the lamp in view φ goes on to π, and nearly all borders lie in the first tenth of it: squares and tables crowd rays there.
Test(spread, a_lamp_in_view_gains_by_squares_and_by_borders)
{
    const Spread runs = spread_errors("cell24", "runs");
    cr_assert(runs.square < 0.6 * runs.even && runs.borders < 0.8 * runs.even,
              "even %g, square %g, borders %g", runs.even, runs.square, runs.borders);
}
// A lamp beside the picture leaves a narrow range whose near end is no better than its far one: squares lose; a table of 16 bytes gains a little, one of 64 more.
Test(spread, a_lamp_beside_the_picture_loses_by_squares_and_gains_by_borders)
{
    const Spread runs = spread_errors("fence", "runs");
    cr_assert(runs.square > 1.1 * runs.even && runs.borders < runs.even, "even %g, square %g, borders %g",
              runs.even, runs.square, runs.borders);
}
Test(spread, sums_up_to_words_gain_by_borders_too)
{
    const Spread sums = spread_errors("cell24", "prefix");
    cr_assert(sums.borders < 0.8 * sums.even, "even %g, borders %g", sums.even, sums.borders);
}

// Where nothing casts, there are no borders, and the table is even to the last bits.
Test(spread, no_borders_leave_rays_even)
{
    Bench bench = bench_open("mist", 256);
    bench.settings.asked.integral = "prefix";
    Image even = bench_draw(&bench);
    bench.settings.volume.warp = "borders";
    const ImageError error = bench_error(&bench, &even);
    cr_assert(error.nrmse < 1e-5, "%g", error.nrmse);
    image_free(&even);
    bench_close(&bench);
}
