// 04 airlight: the methods in a scene: what they agree about, how fast they come closer, what may be left out.
#include "../chapters/04_airlight/closed_form.h"
#include "../chapters/04_airlight/judge.h"
#include "../chapters/04_airlight/scenes.h"

#include <criterion/criterion.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE = 24 };

typedef struct Bench {
    Raster *raster;
    Scene *scene;
    AirlightSettings settings;
    int map;
} Bench;
static Bench bench_open(const char *name)
{
    gl_open(GL_PLATFORM_OSMESA, 16, 16, "test");
    const SceneKind *kind = airlight_scenes;
    while (kind->name && strcmp(kind->name, name) != 0)
        kind++;
    Bench bench = {
        .raster = raster_open(), .scene = kind->name ? scene_from(kind, 1) : scene_open(name, 1), .map = 128};
    bench.settings = (AirlightSettings){.method = "segments",
                                        .variant = "intervals",
                                        .phase = "uniform",
                                        .steps = 64,
                                        .nodes = 16,
                                        .seed = 1,
                                        .shadowed = true,
                                        .grey = true};
    return bench;
}
static Image bench_draw(const Bench *bench)
{
    GLuint table = closed_form_table(64);
    const AirlightSettings settings = closed_form_settings(bench->settings, table);
    Image picture = airlight_picture(bench->raster, bench->scene, &bench->scene->camera, SIDE, SIDE,
                                     bench->map, &settings);
    gl_texture_delete(&table);
    return picture;
}
static void bench_close(Bench *bench)
{
    scene_close(bench->scene);
    raster_close(bench->raster);
    gl_close();
}
static ImageError method_error(Bench *bench, const char *method, int steps, const Image *expected)
{
    bench->settings.method = method;
    bench->settings.steps = steps;
    Image got = bench_draw(bench);
    ImageError error = image_compare(&got, expected);
    image_free(&got);
    return error;
}

// Both read the same map: 4096 samples a ray meet each border of a texel within 1/4096 of the ray. A walk that loses a texel is off by far more.
static void check_walk(const char *scene, double tolerance)
{
    Bench bench = bench_open(scene);
    Image walked = bench_draw(&bench);
    const ImageError error = method_error(&bench, "equiangular", 4096, &walked);
    cr_assert_eq(error.nonfinite, 0);
    cr_assert(error.nrmse < tolerance && fabs(error.mean_ratio - 1.0) < tolerance,
              "%s: nrmse %g, mean ratio %g", scene, error.nrmse, error.mean_ratio);
    image_free(&walked);
    bench_close(&bench);
}
Test(airlight, walking_a_cube_map_meets_what_sampling_meets)
{
    check_walk("blocks", 1e-3);
}
Test(airlight, walking_a_spots_map_meets_what_sampling_meets)
{
    check_walk("bunny", 1e-3);
}
Test(airlight, walking_the_suns_map_meets_what_sampling_meets)
{
    check_walk("colonnade", 1e-3);
}
Test(airlight, a_walk_through_a_pinhole)
{
    check_walk("pinhole", 2e-2); // a tenth of a ray is lit, in pieces of a texel
}

// What rows of a sweep are compared with is drawn once, and again for each thing that it depends on.
Test(airlight, a_kept_picture_is_the_one_that_was_asked_for)
{
    Bench bench = bench_open("blocks");
    AirlightKept kept = {0};
    Scene *scene = bench.scene;
    const float *last = NULL;
    for (int turn = 0; turn < 6; turn++) {
        scene->medium.scattering *= turn == 1 ? 0.5f : 1.0f;
        scene->camera.eye[0] += turn == 2 ? 0.1f : 0.0f;
        bench.map = turn == 3 ? 64 : bench.map;
        bench.settings.phase = turn == 4 ? "rayleigh" : bench.settings.phase;
        bench.settings.shadowed = turn < 5;
        Image anew = bench_draw(&bench);
        const uint64_t scene_hash = truth_hash_scene(scene);
        const Image *got = airlight_picture_kept(&kept, scene_hash, bench.raster, scene, &scene->camera, SIDE,
                                                 SIDE, bench.map, &bench.settings);
        cr_assert_eq(memcmp(got->pixels, anew.pixels, sizeof(float) * 4 * SIDE * SIDE), 0, "turn %d", turn);
        got->pixels[0] = turn == 5 ? -1.0f : got->pixels[0]; // a mark
        image_free(&anew);
        last = got->pixels;
    }
    const Image *again = airlight_picture_kept(&kept, truth_hash_scene(scene), bench.raster, scene,
                                               &scene->camera, SIDE, SIDE, bench.map, &bench.settings);
    cr_assert(again->pixels == last && again->pixels[0] == -1.0f, "the same again is not drawn again");
    image_free(&kept.image);
    bench_close(&bench);
}

// A map of 2048² texels gives the truth's picture to its texels' size.
Test(airlight, segments_come_to_the_truth)
{
    Bench bench = bench_open("two_lights");
    Image truth = airlight_truth(bench.scene, &bench.scene->camera, SIDE, SIDE, 1, &bench.settings, -1.0f);
    double last = INFINITY;
    for (bench.map = 64; bench.map <= 1024; bench.map *= 4) {
        const ImageError error = method_error(&bench, "segments", 0, &truth);
        cr_assert(error.rel_rmse < 0.5 * last, "map of %d: %g after %g", bench.map, error.rel_rmse, last);
        last = error.rel_rmse;
    }
    cr_assert(last < 5e-3, "%g", last);
    image_free(&truth);
    bench_close(&bench);
}

// Wires that are thinner than a texel, and a file's camera, spot, candle and moon: a finer map is nearer to the truth, and near it on the whole.
static void check_real(const char *name, double tolerance)
{
    Bench bench = bench_open(name);
    bench.scene->medium = (Medium){vec3_make(0.1f, 0.1f, 0.1f), vec3_make(0.02f, 0.02f, 0.02f), 0.0f};
    Image truth = airlight_truth(bench.scene, &bench.scene->camera, SIDE, SIDE, 1, &bench.settings, -1.0f);
    const ImageError coarse = method_error(&bench, "segments", 0, &truth);
    bench.map = 1024;
    const ImageError fine = method_error(&bench, "segments", 0, &truth);
    cr_assert(fine.nonfinite == 0 && fine.nrmse < tolerance && fine.nrmse < 0.5 * coarse.nrmse,
              "%s: nrmse %g with 1024² texels, %g with 128²", name, fine.nrmse, coarse.nrmse);
    cr_assert(fabs(fine.mean_ratio - 1.0) < 0.2 * tolerance, "%s: mean ratio %g", name, fine.mean_ratio);
    image_free(&truth);
    bench_close(&bench);
}
Test(airlight, a_fence_comes_to_the_truth)
{
    check_real("fence", 0.02);
}
Test(airlight, a_file_with_camera_and_lights_comes_to_the_truth)
{
    check_real("chapters/02_shadow_maps/lamps.gltf", 0.02);
}

// How the error falls with the number of samples: of the midpoint rule on a smooth ray as n^-2; where shadow borders cross the ray as n^-1; of one random sample in
// each of n strata as n^-1.5 on a smooth ray, and n^-1 with borders.
static double order_of(Bench *bench, const char *method, const Image *expected)
{
    double steps[4], errors[4];
    for (int i = 0; i < 4; i++) {
        steps[i] = 16 << (i * 2);
        errors[i] = method_error(bench, method, (int)steps[i], expected).nrmse;
    }
    return measure_order(steps, errors, 4);
}
Test(airlight, orders_of_convergence)
{
    Bench bench = bench_open("haze");
    bench.scene->lights[0].position = vec3_make(0.5f, 2, 1); // not before the eye: smooth
    bench.settings.nodes = 24;
    Image smooth = bench_draw(&bench);
    const double march = order_of(&bench, "march", &smooth), jittered = order_of(&bench, "jittered", &smooth);
    cr_assert(march < -1.7 && march > -2.5, "march, smooth: %g", march);
    cr_assert(jittered < -1.25 && jittered > -1.75, "jittered, smooth: %g", jittered);
    image_free(&smooth);
    bench_close(&bench);
    bench = bench_open("blocks");
    bench.settings.nodes = 24;
    bench.map = 512;
    Image shadowed = bench_draw(&bench);
    const double with_borders = order_of(&bench, "equiangular", &shadowed);
    cr_assert(with_borders < -0.75 && with_borders > -1.4, "equiangular, shadow borders: %g", with_borders);
    image_free(&shadowed);
    bench_close(&bench);
}

// Near the light equal steps meet the inverse square or miss it; equal angles take it out of the integrand.
Test(airlight, equal_angles_beat_equal_steps_near_the_light)
{
    Bench bench = bench_open("haze");
    bench.scene->lights[0].position = vec3_make(0.0683f, 0.0683f, -3); // 1 mm beside a pixel's ray
    bench.settings.nodes = 24;
    Image exact = bench_draw(&bench);
    const double steps = method_error(&bench, "march", 1024, &exact).nrmse,
                 angles = method_error(&bench, "equiangular", 64, &exact).nrmse;
    cr_assert(angles < 1.0 && steps > 10.0 * angles, "march 1024: %g, equiangular 64: %g", steps, angles);
    image_free(&exact);
    bench_close(&bench);
}

// The eye at the light: every ray has the light on its line, where the distance that angles are taken over must not become 0.
Test(airlight, equal_angles_with_the_light_on_the_ray)
{
    Bench bench = bench_open("haze");
    bench.scene->lights[0].position = bench.scene->camera.eye;
    bench.settings.nodes = 24;
    Image exact = bench_draw(&bench);
    const ImageError error = method_error(&bench, "equiangular", 256, &exact);
    cr_assert(error.nonfinite == 0 && error.nrmse < 1e-3, "%ld not finite, nrmse %g", error.nonfinite,
              error.nrmse);
    image_free(&exact);
    bench_close(&bench);
}

// Four lookups share one evaluation of the rest: as many samples, nearly the same picture.
Test(airlight, factored_is_nearly_equiangular)
{
    Bench bench = bench_open("blocks");
    bench.map = 512;
    Image exact = bench_draw(&bench);
    const double factored = method_error(&bench, "factored", 256, &exact).nrmse,
                 all = method_error(&bench, "equiangular", 256, &exact).nrmse;
    cr_assert(factored < 2.0 * all && factored > 0.2 * all, "factored %g, equiangular %g", factored, all);
    image_free(&exact);
    bench_close(&bench);
}

// A coloured medium costs three exponentials, and a grey one may be taken for one.
Test(airlight, a_grey_medium_is_a_coloured_one_with_equal_colours)
{
    Bench bench = bench_open("two_lights");
    const char *const methods[] = {"march", "gauss"};
    for (int i = 0; i < 2; i++) {
        bench.settings.method = methods[i];
        bench.settings.grey = true;
        Image one = bench_draw(&bench);
        bench.settings.grey = false;
        Image three = bench_draw(&bench);
        cr_assert_eq(image_compare(&one, &three).max_abs, 0.0, "%s", methods[i]);
        bench.scene->medium.absorption[0] = 0.5f;
        Image coloured = bench_draw(&bench);
        cr_assert(image_compare(&coloured, &three).mean_ratio < 0.99, "%s", methods[i]);
        bench.scene->medium.absorption[0] = bench.scene->medium.absorption[1];
        image_free(&one);
        image_free(&three);
        image_free(&coloured);
    }
    bench_close(&bench);
}

// The box's shadow misses the view, or just does not.
Test(airlight, what_can_cast_into_the_view)
{
    Bench bench = bench_open("blocks");
    Scene *scene = bench.scene; // box: x from -0.7 to 0.8; the light at (1.1, 0.15, -0.2)
    Camera camera = scene->camera;
    camera.eye = vec3_make(3, 0, 0);
    camera.target = vec3_make(4, 0, 0);
    cr_assert(!raster_can_shadow(scene, &scene->lights[0], &camera, 1.0f), "the shadow goes the other way");
    camera.target = vec3_make(2, 0, 0);
    cr_assert(raster_can_shadow(scene, &scene->lights[0], &camera, 1.0f), "the box is in view");
    camera.eye = vec3_make(-3, 0, 0);
    camera.target = vec3_make(-4, 0, 0);
    cr_assert(raster_can_shadow(scene, &scene->lights[0], &camera, 1.0f),
              "the shadow is in view, the box is not");
    Light sun = {.kind = LIGHT_DIRECTIONAL, .direction = vec3_make(1, 0, 0)};
    cr_assert(!raster_can_shadow(scene, &sun, &camera, 1.0f), "the sun's shadow goes the other way");
    sun.direction = vec3_make(-1, 0, 0);
    cr_assert(raster_can_shadow(scene, &sun, &camera, 1.0f), "the sun's shadow is in view");
    bench_close(&bench);
}
