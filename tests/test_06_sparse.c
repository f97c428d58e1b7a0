// 06 epipolar voxelized shadow volumes: airlight of the grid's own view rays, and pixels between them (integral=sparse), against runs and against closed forms over
// the same map.
#define BENCH_SIDE 48
#include "vsv_bench.h"

static Bench sparse_bench(const char *name)
{
    Bench bench = bench_open(name, 512);
    bench.settings.asked.integral = "sparse";
    return bench;
}

// Nothing casts, and all rays end alike: what is left is the interpolation's own error, ((π/128)²/8 of the second derivative, 1e-4, more beside the light).
Test(sparse, between_rows_that_are_lit_it_is_a_closed_form)
{
    Bench bench = sparse_bench("mist");
    bench.scene->medium.absorption += vec3_make(0.0f, 0.05f, 0.2f);
    bench.settings.airlight.grey = false;
    Image exact = bench_segments(&bench, true);
    const ImageError error = bench_error(&bench, &exact);
    cr_assert(error.nrmse < 2e-3 && error.rel_rmse < 2e-3, "%g, %g", error.nrmse, error.rel_rmse);
    image_free(&exact);
    bench_close(&bench);
}

// Shadows, and surfaces that end rays: as near to what the map says as the runs of every pixel's nearest row are.
static void check_near(const char *scene)
{
    Bench bench = sparse_bench(scene);
    Image exact = bench_segments(&bench, true);
    const double sparse = bench_error(&bench, &exact).rel_rmse;
    bench.settings.asked.integral = "runs";
    const double runs = bench_error(&bench, &exact).rel_rmse;
    cr_assert(sparse < 1.1 * runs, "%s: %g, runs %g", scene, sparse, runs);
    image_free(&exact);
    bench_close(&bench);
}
Test(sparse, a_point_light)
{
    check_near("stage");
}
Test(sparse, a_directional_light)
{
    check_near("stage_sun");
}
Test(sparse, a_spot_lights_cone)
{
    check_near("fence");
}

// A pole before a lamp and the open sky, asked by few rows: no pixel of the one takes a row of the other. Nothing else is in the picture, so that the greatest error
// is that of its outline.
Test(sparse, no_row_speaks_across_the_edge_of_a_surface)
{
    Bench bench = sparse_bench("pole");
    bench.settings.volume.alpha = bench.settings.volume.theta = 64;
    Image exact = bench_segments(&bench, true);
    const ImageError sparse = bench_error(&bench, &exact);
    bench.settings.asked.integral = "runs";
    const ImageError runs = bench_error(&bench, &exact);
    cr_assert(sparse.rel_rmse < 1.1 * runs.rel_rmse, "%g, runs %g", sparse.rel_rmse, runs.rel_rmse);
    image_free(&exact);
    bench_close(&bench);
}

// A light whose radius is a fiftieth of the way to it: inside, the inverse square is held, and airlight goes no more as 1/D. Its pixels ask for themselves.
Test(sparse, rays_through_the_lights_radius)
{
    Bench bench = sparse_bench("mist");
    Light *light = &bench.scene->lights[0];
    light->position = bench.scene->camera.target;
    light->radius = 0.02f * vec3_length(light->position - bench.scene->camera.eye);
    bench.settings.asked.integral = "runs";
    Image exact = bench_draw(&bench);
    bench.settings.asked.integral = "sparse";
    const double held = bench_error(&bench, &exact).nrmse;
    cr_assert(held < 3e-3, "%g", held);
    image_free(&exact);
    bench_close(&bench);
}

Test(sparse, a_light_at_the_eye)
{
    Bench bench = sparse_bench("mist");
    bench_check_light_at_the_eye(&bench);
}

// Of sixteen rows few end as a pixel's ray does: most pixels ask for themselves, and get what runs of the same bits give; none stays dark.
Test(sparse, what_no_row_speaks_for_asks_the_volume)
{
    Bench bench = sparse_bench("stage");
    bench.settings.volume.alpha = bench.settings.volume.theta = 4;
    Image sparse = bench_draw(&bench);
    bench.settings.asked.integral = "runs";
    Image runs = bench_draw(&bench);
    int same = 0, dark = 0;
    for (int i = 0; i < BENCH_SIDE * BENCH_SIDE; i++) {
        same += fabsf(sparse.pixels[4 * i] - runs.pixels[4 * i]) <= 1e-5f * runs.pixels[4 * i];
        dark += sparse.pixels[4 * i] == 0.0f && runs.pixels[4 * i] > 0.0f;
    }
    cr_assert(same > BENCH_SIDE * BENCH_SIDE / 4 && dark == 0, "%d as runs, %d dark", same, dark);
    image_free(&sparse);
    image_free(&runs);
    bench_close(&bench);
}
