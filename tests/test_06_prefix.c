// 06 epipolar voxelized shadow volumes: airlight summed up to each word of the grid's view rays (integral=prefix) against closed forms over the same map.
#define BENCH_SIDE 32
#include "vsv_bench.h"

static Bench prefix_bench(const char *name)
{
    Bench bench = bench_open(name, 512);
    bench.settings.asked.integral = "prefix";
    bench.settings.asked.filtered = true;
    return bench;
}

// Nothing casts: all bits are lit, and what is left is the weights' own error. They are midpoint sums over a byte of φ (four a byte: 256 in [0, π], each
// off by (π/256)²/24 of the second derivative, about 1e-5 of the whole) and linear in α between rows ((π/128)²/8 of it, 1e-4, more beside the light).
static void check_unshadowed(const char *phase, float mean_cosine, bool grey, double tolerance)
{
    Bench bench = prefix_bench("mist");
    bench.settings.airlight.phase = phase;
    bench.scene->medium.mean_cosine = mean_cosine;
    bench.settings.airlight.grey = grey;
    if (!grey)
        bench.scene->medium.absorption += vec3_make(0.0f, 0.05f, 0.2f);
    Image exact = bench_segments(&bench, true);
    for (int square = 0; square < 2; square++) {
        bench.settings.volume.warp = square ? "square" : "even";
        const ImageError error = bench_error(&bench, &exact);
        cr_assert(error.nrmse < tolerance, "%s, %s: %g", phase, bench.settings.volume.warp, error.nrmse);
    }
    image_free(&exact);
    bench_close(&bench);
}
Test(prefix, an_empty_volume_is_a_closed_form)
{
    check_unshadowed("uniform", 0.0f, true, 2e-3);
}
Test(prefix, an_empty_volume_of_three_channels_and_a_peaked_phase)
{
    check_unshadowed("henyey_greenstein", 0.7f, false, 5e-3);
}

// The nearest row's sums are the runs of the same bits, weighted at the row's α in place of the pixel's and by the byte; bits are the same, so no error of visibility
// is in it. With 128 φ a byte is 0.2 rad wide, which leaves 7e-3 beside the light of the stage; one weight for the word in which a ray ends would leave 2e-2.
static void check_same_as_runs(const char *scene, double tolerance)
{
    Bench bench = prefix_bench(scene);
    bench.settings.asked.filtered = false;
    bench.settings.volume.alpha = 1024;
    bench.settings.volume.phi = 128; // the last word is a quarter of a row
    bench.settings.asked.integral = "runs";
    Image runs = render_picture(bench.raster, bench.scene, &bench.scene->camera, BENCH_SIDE, BENCH_SIDE,
                                &bench.settings);
    bench.settings.asked.integral = "prefix";
    const ImageError error = bench_error(&bench, &runs);
    cr_assert(error.nrmse < tolerance, "%s: %g", scene, error.nrmse);
    image_free(&runs);
    bench_close(&bench);
}
Test(prefix, a_point_lights_nearest_row_is_the_runs_of_the_same_bits)
{
    check_same_as_runs("stage", 1e-2);
}
Test(prefix, a_directional_lights_nearest_row_is_the_runs_of_the_same_bits)
{
    check_same_as_runs("stage_sun", 1.5e-3);
}
Test(prefix, a_spot_lights_nearest_row_is_the_runs_of_the_same_bits)
{
    check_same_as_runs("fence", 1.5e-3);
}

// Between four rows the sum is nearer to what the map says than the nearest row is: the steps from row to row are gone. Coarse, so that they are the error.
Test(prefix, interpolated_sums_are_nearer_than_the_nearest)
{
    Bench bench = prefix_bench("stage");
    bench.settings.volume.alpha = bench.settings.volume.theta = 32;
    Image exact = bench_segments(&bench, true);
    const double between = bench_error(&bench, &exact).nrmse;
    bench.settings.asked.filtered = false;
    const double nearest = bench_error(&bench, &exact).nrmse;
    cr_assert(between < 0.8 * nearest, "%g, the nearest row %g", between, nearest);
    image_free(&exact);
    bench_close(&bench);
}

// A light whose radius is a fiftieth of the way to it: inside, the inverse square is held, and D no measure of it any more.
Test(prefix, rays_through_the_lights_radius)
{
    Bench bench = prefix_bench("mist");
    Light *light = &bench.scene->lights[0];
    light->radius = 0.02f * sqrtf(vec3_dot(light->position - bench.scene->camera.eye,
                                           light->position - bench.scene->camera.eye));
    Image exact = bench_segments(&bench, true);
    const double held = bench_error(&bench, &exact).nrmse;
    cr_assert(held < 3e-2, "%g", held);
    image_free(&exact);
    bench_close(&bench);
}

Test(prefix, a_light_at_the_eye)
{
    Bench bench = prefix_bench("mist");
    bench_check_light_at_the_eye(&bench);
}

// All lights are summed up before the first is asked, so each needs sums of its own: the last one's in place of the first's would be off by the whole picture.
Test(prefix, each_of_two_lights_has_its_own_sums)
{
    Bench bench = prefix_bench("stage");
    Light second = bench.scene->lights[0];
    second.position = vec3_make(-2, 2.5f, 1);
    scene_add_light(bench.scene, second);
    Image exact = bench_segments(&bench, true);
    const double error = bench_error(&bench, &exact).nrmse;
    cr_assert(error < 5e-2, "%g", error);
    image_free(&exact);
    bench_close(&bench);
}
