// 06 epipolar voxelized shadow volumes: airlight summed up to each word of the grid's view rays (integral=prefix) against closed forms over the same map.
#include "../chapters/06_epipolar_vsv/render.h"
#include "../chapters/06_epipolar_vsv/vsv_scenes.h"

#include <criterion/criterion.h>
#include <string.h>

enum { SIDE = 32 };

typedef struct Bench {
    Raster *raster;
    Scene *scene;
    RenderSettings settings;
} Bench;

static Bench bench_open(const char *name)
{
    gl_open(GL_PLATFORM_OSMESA, 16, 16, "test");
    const SceneKind *kind = vsv_scenes;
    while (kind->name && strcmp(kind->name, name) != 0)
        kind++;
    Bench bench = {.raster = raster_open(), .scene = kind->name ? scene_from(kind, 1) : scene_open(name, 1)};
    bench.settings = (RenderSettings){.airlight = {.method = "march",
                                                   .variant = "intervals",
                                                   .phase = "uniform",
                                                   .steps = 64,
                                                   .nodes = 16,
                                                   .shadowed = true,
                                                   .grey = true},
                                      .volume = {.alpha = 128,
                                                 .theta = 256,
                                                 .phi = 512,
                                                 .scan = "columns",
                                                 .warp = "even",
                                                 .slices = "uniform",
                                                 .shape = "cube"},
                                      .asked = {.integral = "prefix", .slice = 8, .filtered = true},
                                      .map = 256};
    return bench;
}
static void bench_close(Bench *bench)
{
    scene_close(bench->scene);
    raster_close(bench->raster);
    gl_close();
}

// What the same map says, in closed form.
static Image bench_exact(const Bench *bench)
{
    AirlightSettings exact = bench->settings.airlight;
    exact.method = "segments";
    exact.nodes = 24;
    return airlight_picture(bench->raster, bench->scene, &bench->scene->camera, SIDE, SIDE,
                            bench->settings.map, &exact);
}
static ImageError bench_error(const Bench *bench, const Image *expected)
{
    Image got =
        render_picture(bench->raster, bench->scene, &bench->scene->camera, SIDE, SIDE, &bench->settings);
    const ImageError error = image_compare(&got, expected);
    image_free(&got);
    cr_assert_eq(error.nonfinite, 0);
    return error;
}

// Nothing casts: all bits are lit, and what is left is the weights' own error. They are midpoint sums over a byte of φ (four a byte: 256 in [0, π], each
// off by (π/256)²/24 of the second derivative, about 1e-5 of the whole) and linear in α between rows ((π/128)²/8 of it, 1e-4, more beside the light).
static void check_unshadowed(const char *phase, float mean_cosine, bool grey, double tolerance)
{
    Bench bench = bench_open("mist");
    bench.settings.airlight.phase = phase;
    bench.scene->medium.mean_cosine = mean_cosine;
    bench.settings.airlight.grey = grey;
    if (!grey)
        bench.scene->medium.absorption += vec3_make(0.0f, 0.05f, 0.2f);
    Image exact = bench_exact(&bench);
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
    Bench bench = bench_open(scene);
    bench.settings.asked.filtered = false;
    bench.settings.volume.alpha = 1024;
    bench.settings.volume.phi = 128; // the last word is a quarter of a row
    bench.settings.asked.integral = "runs";
    Image runs = render_picture(bench.raster, bench.scene, &bench.scene->camera, SIDE, SIDE, &bench.settings);
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
    Bench bench = bench_open("stage");
    bench.settings.volume.alpha = bench.settings.volume.theta = 32;
    Image exact = bench_exact(&bench);
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
    Bench bench = bench_open("mist");
    Light *light = &bench.scene->lights[0];
    light->radius = 0.02f * sqrtf(vec3_dot(light->position - bench.scene->camera.eye,
                                           light->position - bench.scene->camera.eye));
    Image exact = bench_exact(&bench);
    const double held = bench_error(&bench, &exact).nrmse;
    cr_assert(held < 3e-2, "%g", held);
    image_free(&exact);
    bench_close(&bench);
}

// Light at the eye: φ is the same along a ray, so that sums over it say nothing; runs answer instead.
Test(prefix, a_light_at_the_eye)
{
    Bench bench = bench_open("mist");
    bench.scene->lights[0].position = bench.scene->camera.eye;
    Image exact = bench_exact(&bench);
    cr_assert_lt(bench_error(&bench, &exact).nrmse, 1e-3);
    image_free(&exact);
    bench_close(&bench);
}
