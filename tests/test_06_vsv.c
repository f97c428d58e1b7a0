// 06 epipolar voxelized shadow volumes: airlight from bits against what the same map says without sampling.
#include "vsv_bench.h"

#include <stdlib.h>

enum { SIDE = BENCH_SIDE };

// Nothing casts: a ray is one run, one closed form, whatever the integral.
Test(vsv, an_empty_volume_is_a_closed_form)
{
    Bench bench = bench_open("mist", 256);
    Image open = bench_segments(&bench, false);
    const char *const integrals[] = {"runs", "riemann", "factored"};
    for (int i = 0; i < 3; i++) {
        bench.settings.asked.integral = integrals[i];
        cr_assert(bench_error(&bench, &open).nrmse <= 1e-4, "%s", integrals[i]); // 16 nodes for 24
    }
    image_free(&open);
    bench_close(&bench);
}

// Against what the map says: 256 steps of φ and 128 of α; finer grids come closer, at least by half for twice the voxels along each axis twice.
static void check_converges(const char *scene, const char *integral, double tolerance)
{
    Bench bench = bench_open(scene, 256);
    Image exact = bench_segments(&bench, true);
    bench.settings.asked.integral = integral;
    const double coarse_phi[2] = {128, 512};
    double errors[2];
    for (int i = 0; i < 2; i++) {
        bench.settings.volume.phi = (int)coarse_phi[i];
        bench.settings.volume.alpha = (int)coarse_phi[i] / 2;
        bench.settings.volume.theta = (int)coarse_phi[i];
        errors[i] = bench_error(&bench, &exact).nrmse;
    }
    cr_assert(errors[1] < 0.5 * errors[0] && errors[1] < tolerance, "%s, %s: %g, then %g", scene, integral,
              errors[0], errors[1]);
    image_free(&exact);
    bench_close(&bench);
}
Test(vsv, runs_come_to_what_the_map_says)
{
    check_converges("stage", "runs", 1e-2);
}
Test(vsv, sums_over_bits_come_to_what_the_map_says)
{
    check_converges("stage", "riemann", 1e-2);
}
Test(vsv, factored_slices_come_to_what_the_map_says)
{
    check_converges("stage", "factored", 1e-2);
}
Test(vsv, a_directional_lights_runs_come_to_what_the_map_says)
{
    check_converges("stage_sun", "runs", 2e-2);
}

Test(vsv, a_sum_over_bits_ends_where_the_grid_does)
{
    check_converges("colonnade", "riemann", 3e-2); // whose sky goes on without end
}

static void check_same(Bench *bench, const Image *expected, double nrmse, const char *what)
{
    const ImageError error = bench_error(bench, expected);
    cr_assert(error.nrmse < nrmse, "%s: %g", what, error.nrmse);
}
// The same picture to within the grid's own error, by other ways; by both scans to the last bit.
Test(vsv, every_way_shows_the_same)
{
    Bench bench = bench_open("stage", 256);
    Image exact = bench_segments(&bench, true), first = bench_draw(&bench);
    const double error = image_compare(&first, &exact).nrmse;
    bench.settings.volume.scan = "logstep";
    cr_assert_eq(bench_error(&bench, &first).max_abs, 0.0);
    bench.settings.volume.scan = "columns";
    bench.settings.volume.warp = "square";
    check_same(&bench, &exact, 3 * error, "square");
    bench.settings.volume.warp = "even";
    bench.settings.volume.slices = "pixel";
    check_same(&bench, &exact, 3 * error, "pixel");
    bench.settings.volume.slices = "uniform";
    bench.settings.volume.shape = "paraboloid";
    check_same(&bench, &exact, 3 * error, "paraboloid");
    bench.settings.volume.shape = "cube";
    bench.settings.full = true;
    const double full = bench_error(&bench, &exact).nrmse;
    cr_assert(full > 1.2 * error && full < 20 * error, "all angles: %g, what is seen: %g", full, error);
    image_free(&exact);
    image_free(&first);
    bench_close(&bench);
}

// Rows that a pixel is between say together more than the nearest: steps from slice to slice are softened.
Test(vsv, a_filtered_pixel_is_nearer_to_what_the_map_says)
{
    Bench bench = bench_open("stage", 256);
    bench.settings.volume.theta = bench.settings.volume.alpha = 32;
    Image exact = bench_segments(&bench, true);
    const double nearest = bench_error(&bench, &exact).nrmse;
    bench.settings.asked.filtered = true;
    const double filtered = bench_error(&bench, &exact).nrmse;
    cr_assert(filtered < 0.95 * nearest, "filtered: %g, the nearest row: %g", filtered, nearest);
    image_free(&exact);
    bench_close(&bench);
}

// Where a ray ends at a surface, its last voxel is one whose middle is before it: airlight is neither lost nor won there.
Test(vsv, no_light_is_lost_at_surfaces)
{
    Bench bench = bench_open("stage", 256);
    bench.settings.volume.phi = 128;
    bench.settings.volume.alpha = 512;
    bench.settings.volume.theta = 512;
    Image exact = bench_segments(&bench, true);
    const double ratio = bench_error(&bench, &exact).mean_ratio;
    cr_assert(fabs(ratio - 1.0) < 6e-4, "mean ratio %g", ratio); // dark last voxels: 0.998
    image_free(&exact);
    bench_close(&bench);
}

Test(vsv, airlight_is_linear_in_the_light)
{
    Bench bench = bench_open("stage", 256);
    Image once = bench_draw(&bench);
    bench.scene->lights[0].intensity *= 2.0f;
    Image twice = bench_draw(&bench);
    double total = 0;
    for (int i = 0; i < 4 * SIDE * SIDE; i++) {
        total += (double)once.pixels[i];
        if (i % 4 < 3) // alpha
            cr_assert_eq(twice.pixels[i], 2.0f * once.pixels[i]);
    }
    cr_assert(total > 0);
    image_free(&once);
    image_free(&twice);
    bench_close(&bench);
}

// Wyman's equation 5 sums N + 1 terms, i from 0 to N, of N steps: of 16 equal ones that is 17/16 of what is there. Ours of the same bits is what runs give.
Test(vsv, a_sum_has_as_many_terms_as_steps)
{
    double printed = 0.0, corrected = 0.0;
    for (int i = 0; i <= 16; i++) {
        printed += 1.0 / 16.0;
        corrected += i < 16 ? 1.0 / 16.0 : 0.0;
    }
    cr_assert(printed > 1.06 && fabs(corrected - 1.0) < 1e-12);
    Bench bench = bench_open("stage", 256);
    bench.settings.volume.phi = 128;
    Image runs = bench_draw(&bench);
    bench.settings.asked.integral = "riemann";
    const double ratio = bench_error(&bench, &runs).mean_ratio;
    cr_assert(fabs(ratio - 1.0) < 1e-3, "mean ratio %g", ratio); // a term too many: above 1.003
    image_free(&runs);
    bench_close(&bench);
}

// Phase functions stand in all integrals alike.
Test(vsv, phase_functions)
{
    static const char *const phases[] = {"henyey_greenstein", "hoffman_preetham"};
    static const char *const integrals[] = {"runs", "riemann", "factored"};
    Bench bench = bench_open("stage", 256);
    bench.scene->medium.mean_cosine = 0.5f;
    bench.settings.airlight.rayleigh_share = 0.3f;
    for (int p = 0; p < 2; p++) {
        bench.settings.airlight.phase = phases[p];
        Image exact = bench_segments(&bench, true);
        for (int i = 0; i < 3; i++) {
            bench.settings.asked.integral = integrals[i];
            check_same(&bench, &exact, 3e-2, integrals[i]);
        }
        image_free(&exact);
    }
    bench_close(&bench);
}

// A window colours light rays: sums over bits against as many lookups in the map and the window.
Test(vsv, a_textured_light)
{
    Bench bench = bench_open("stage", 256);
    Image plain = bench_draw(&bench);
    bench.settings.asked.textured = true;
    bench.settings.asked.integral = "march";
    bench.settings.airlight.steps = 1024;
    Image exact = bench_draw(&bench);
    cr_assert(image_compare(&plain, &exact).nrmse > 0.2, "the window shows nowhere");
    bench.settings.asked.integral = "riemann";
    bench.settings.volume.phi = 512;
    check_same(&bench, &exact, 2e-2, "riemann");
    bench.settings.asked.integral = "factored";
    bench.settings.asked.slice = 4;
    check_same(&bench, &exact, 4e-2, "factored");
    image_free(&plain);
    image_free(&exact);
    bench_close(&bench);
}

// Factored slices of more bits are less exact; of as few as one they would be the sum.
Test(vsv, larger_slices_are_less_exact)
{
    Bench bench = bench_open("mist", 256);
    bench.scene->lights[0].position = vec3_make(0.2f, 0.3f, -2);
    mesh_add_quad(&bench.scene->mesh, vec3_make(9, 9, -9), vec3_make(0, 1, 0), vec3_make(0, 0, 1), 0);
    double last = 0;
    Image fine = {0};
    bench.settings.asked.integral = "riemann";
    bench.settings.asked.textured = true; // so that what is lit throughout is summed, too
    fine = bench_draw(&bench);
    bench.settings.asked.integral = "factored";
    for (int slice = 4; slice <= 32; slice *= 2) {
        bench.settings.asked.slice = slice;
        const double error = bench_error(&bench, &fine).nrmse;
        cr_assert(error > 1.2 * last, "slices of %d: %g after %g", slice, error, last);
        last = error;
    }
    image_free(&fine);
    bench_close(&bench);
}
