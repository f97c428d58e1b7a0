// vsv_bench: what the tests of chapter 06's airlight share: a scene, how its volume is asked, and what the same map says without sampling.
#ifndef VSV_BENCH_H
#define VSV_BENCH_H

#include "../chapters/06_epipolar_vsv/render.h"
#include "../chapters/06_epipolar_vsv/vsv_scenes.h"

#include <criterion/criterion.h>
#include <string.h>

#ifndef BENCH_SIDE
#define BENCH_SIDE 24 // pixels
#endif

typedef struct Bench {
    Raster *raster;
    Scene *scene;
    RenderSettings settings;
} Bench;
// A scene of the chapter or of all chapters, by its name, asked with `phi` light rays a slice.
static inline Bench bench_open(const char *name, int phi)
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
                                                 .phi = phi,
                                                 .scan = "columns",
                                                 .warp = "even",
                                                 .slices = "uniform",
                                                 .shape = "cube"},
                                      .asked = {.integral = "runs", .slice = 8},
                                      .map = 256};
    return bench;
}
static inline Image bench_draw(const Bench *bench)
{
    return render_picture(bench->raster, bench->scene, &bench->scene->camera, BENCH_SIDE, BENCH_SIDE,
                          &bench->settings);
}
static inline Image bench_segments(const Bench *bench,
                                   bool shadowed) // what the same map says, without sampling
{
    AirlightSettings exact = bench->settings.airlight;
    exact.method = "segments";
    exact.nodes = 24;
    exact.shadowed = shadowed;
    return airlight_picture(bench->raster, bench->scene, &bench->scene->camera, BENCH_SIDE, BENCH_SIDE,
                            bench->settings.map, &exact);
}
static inline void bench_close(Bench *bench)
{
    scene_close(bench->scene);
    raster_close(bench->raster);
    gl_close();
}
static inline ImageError bench_error(const Bench *bench, const Image *expected)
{
    Image got = bench_draw(bench);
    const ImageError error = image_compare(&got, expected);
    image_free(&got);
    cr_assert_eq(error.nonfinite, 0);
    return error;
}

// Light at the eye: φ is the same along a ray, so that sums or spans over it say nothing; pixels ask by runs. Closes the bench.
static inline void bench_check_light_at_the_eye(Bench *bench)
{
    bench->scene->lights[0].position = bench->scene->camera.eye;
    Image exact = bench_segments(bench, true);
    cr_assert_lt(bench_error(bench, &exact).nrmse, 1e-3);
    image_free(&exact);
    bench_close(bench);
}

#endif
