// 06 rays: shadow rays at the grid's angles, against quadrature in double; the number that was sent; the bare loop.
#include "../chapters/06_epipolar_vsv/rays.h"
#include "../chapters/06_epipolar_vsv/vsv_scenes.h"

#include <criterion/criterion.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE = 22 }; // no multiple of a packet's 4 pixels

static const TruthPhase uniform = {"uniform", 0, 0};

// A block between eye and light in haze.
static void make_block(Scene *scene, uint64_t seed)
{
    (void)seed;
    const uint32_t grey = scene_add_material(scene, "grey", vec3_make(1, 1, 1), vec3_make(0, 0, 0));
    mesh_add_box(&scene->mesh, vec3_make(-0.4f, -0.5f, -0.3f), vec3_make(0.1f, 0.3f, 0.3f), grey);
    scene_add_light(scene, (Light){.kind = LIGHT_POINT,
                                   .position = vec3_make(1.1f, 0.2f, -0.2f),
                                   .intensity = vec3_make(4, 3, 2)});
    scene->medium = (Medium){vec3_make(0.4f, 0.3f, 0.2f), vec3_make(0.1f, 0.1f, 0.1f), 0};
    scene->camera = (Camera){vec3_make(-1, 0.1f, 0.7f), vec3_make(1, 0.1f, 0), vec3_make(0, 1, 0), 1, 0, 0};
}

typedef struct Bench {
    Scene *scene;
    Rays *rays;
    RaysView view;
    EpipolarRange range;
    float *distance, *angles;
    Image truth;
} Bench;

// Distances by the truth's own rays, through the pixels' middles.
static float *distances(const Scene *scene)
{
    Truth *truth = truth_open(&scene->mesh);
    float *distance = memory_new((size_t)SIDE * SIDE, sizeof *distance, "distances");
    const mat4 turn = camera_view(scene->camera);
    const float half = tanf(0.5f * scene->camera.vertical_fov_rad);
    for (int i = 0; i < SIDE * SIDE; i++) {
        const int row = i / SIDE;
        const float u = half * (2 * ((float)(i % SIDE) + 0.5f) / SIDE - 1),
                    v = half * (2 * ((float)row + 0.5f) / SIDE - 1);
        vec3 way = {0};
        for (int k = 0; k < 3; k++)
            way[k] = u * turn.column[k][0] + v * turn.column[k][1] - turn.column[k][2];
        distance[i] = truth_ray(truth, scene->camera.eye, vec3_normalize(way)).distance;
    }
    truth_close(truth);
    return distance;
}

static void bench_angles(Bench *bench, int phi, float phi_most, bool square)
{
    bench->range = epipolar_range_full(1, 1, phi);
    bench->range.phi_most = phi_most;
    free(bench->angles);
    bench->angles = rays_angles(&bench->range, square);
    bench->view.border = bench->angles;
    bench->view.middle = bench->angles + phi + 1;
    bench->view.phi = phi;
}

static Bench bench_open(Scene *scene, const TruthPhase *phase)
{
    Bench bench = {.scene = scene, .rays = rays_open(&scene->mesh), .distance = distances(scene)};
    bench.view = (RaysView){.scene = scene,
                            .light = &scene->lights[0],
                            .camera = &scene->camera,
                            .frame = epipolar_frame(&scene->camera, &scene->lights[0]),
                            .phase = phase,
                            .width = SIDE,
                            .height = SIDE,
                            .distance = bench.distance};
    bench.truth = truth_airlight_picture(scene, &scene->camera, SIDE, SIDE, 1, phase, -1);
    return bench;
}
static void bench_close(Bench *bench)
{
    image_free(&bench->truth);
    rays_close(bench->rays);
    free(bench->distance);
    free(bench->angles);
    scene_close(bench->scene);
}

static ImageError bench_error(const Bench *bench, RaysCount *count)
{
    float picture[SIDE * SIDE * 4] = {0};
    Image image = image_make(SIDE, SIDE, 4);
    *count = rays_draw(bench->rays, &bench->view, picture);
    for (size_t row = 0; row < SIDE; row++) // the picture's first row is the bottom one
        memcpy(image.pixels + 4 * SIDE * (SIDE - 1 - row), picture + 4 * SIDE * row,
               4 * SIDE * sizeof(float));
    const ImageError error = image_compare(&image, &bench->truth);
    image_free(&image);
    return error;
}

static const SceneKind block = {"block", "a block in haze", make_block};

// A shadow's border is met to within a sample, so the error of a ray goes as 1/N, and the picture's too.
Test(vsv_rays, come_closer_to_the_truth_with_their_number)
{
    Bench bench = bench_open(scene_from(&block, 1), &uniform);
    RaysCount count;
    double error[2];
    for (int i = 0; i < 2; i++) {
        bench_angles(&bench, i ? 2048 : 128, (float)M_PI, false);
        error[i] = bench_error(&bench, &count).nrmse;
    }
    cr_assert(error[0] < 0.03 && error[1] < 0.25 * error[0], "%g, then %g", error[0], error[1]);
    bench_close(&bench);
}

// In the open every sample is lit: midpoints in φ, over which the integrand is smooth but for its end at the first surface or far away.
Test(vsv_rays, integrate_what_is_lit_with_any_phase_function)
{
    static const TruthPhase phases[] = {
        {"uniform", 0, 0}, {"henyey_greenstein", 0.7, 0}, {"hoffman_preetham", 0.3, 0.4}};
    for (size_t i = 0; i < 3; i++) {
        Scene *scene = scene_from(&block, 1);
        scene->mesh.triangle_count = 0;
        scene->medium.mean_cosine = (float)phases[i].mean_cosine;
        Bench bench = bench_open(scene, &phases[i]);
        bench_angles(&bench, 2048, (float)M_PI, i == 2);
        RaysCount count;
        const ImageError error = bench_error(&bench, &count);
        cr_assert(error.rel_rmse < 2e-4, "%s: %g", phases[i].name, error.rel_rmse);
        bench_close(&bench);
    }
}

// A sample where α + φ < π, and none beyond: the sky's rays have all of them, those on a surface as many as lie before it.
Test(vsv_rays, are_as_many_as_lie_before_the_first_surface)
{
    Bench bench = bench_open(scene_from(&block, 1), &uniform);
    bench_angles(&bench, 256, (float)M_PI, false);
    double expected = 0;
    const EpipolarFrame *frame = &bench.view.frame;
    const mat4 turn = camera_view(bench.scene->camera);
    const double half = tan(0.5 * (double)bench.scene->camera.vertical_fov_rad);
    for (int i = 0; i < SIDE * SIDE; i++) {
        const int row = i / SIDE;
        const double u = half * (2 * (i % SIDE + 0.5) / SIDE - 1), v = half * (2 * (row + 0.5) / SIDE - 1);
        double along = 0, length = 0;
        for (int k = 0; k < 3; k++) {
            const double way =
                u * (double)turn.column[k][0] + v * (double)turn.column[k][1] - (double)turn.column[k][2];
            along += way * (double)frame->axis[k];
            length = hypot(length, way);
        }
        const double alpha = acos(along / length), end = (double)bench.distance[i];
        const double last =
            isinf(end) ? M_PI - alpha : atan2(end * sin(alpha), (double)frame->distance - end * cos(alpha));
        expected += floor(last / M_PI * 256 + 0.5);
    }
    RaysCount count;
    bench_error(&bench, &count);
    // a sample within rounding of the end, here and there
    cr_assert(fabs(count.rays - expected) <= 3, "%g rays, expected %g", count.rays, expected);
    const RaysCount bare = rays_bare(bench.rays, &bench.view, 1);
    cr_assert_eq(bare.rays, count.rays, "the bare loop sends %g", bare.rays);
    cr_assert(bare.processor_seconds > 0 && count.processor_seconds > 0, "and takes its time");
    bench_close(&bench);
}

// Light of the sun: φ is the distance from the axis. A cone: nothing is sent outside it.
Test(vsv_rays, know_directional_lights_and_cones)
{
    for (int kind = 1; kind < 3; kind++) {
        Scene *scene = scene_from(&block, 1);
        Light *light = &scene->lights[0];
        light->kind = kind == 1 ? LIGHT_SPOT : LIGHT_DIRECTIONAL;
        light->direction = vec3_normalize(vec3_make(-1, -0.2f, 0.3f));
        light->half_angle_rad = 0.5f;
        // a wall behind, so that rays end
        mesh_add_box(&scene->mesh, vec3_make(2, -9, -9), vec3_make(3, 9, 9), 0);
        Bench bench = bench_open(scene, &uniform);
        bench_angles(&bench, 1024, kind == 1 ? (float)M_PI : 4.0f, false);
        RaysCount count;
        const ImageError error = bench_error(&bench, &count);
        cr_assert(error.nrmse < 0.02, "%d: %g", kind, error.nrmse);
        bench_close(&bench);
    }
}

Test(vsv_rays, angles_are_the_grid_s)
{
    EpipolarRange range = epipolar_range_full(1, 1, 128);
    range.phi_least = 0.5f;
    range.phi_most = 2.5f;
    float *even = rays_angles(&range, false), *square = rays_angles(&range, true);
    cr_assert_float_eq(even[0], 0.5f, 1e-7f);
    cr_assert_float_eq(even[128], 2.5f, 1e-6f);
    cr_assert_float_eq(even[129 + 64], 0.5f + 2.0f * 64.5f / 128, 1e-6f);
    cr_assert_float_eq(square[129 + 64], 0.5f + 2.0f * (64.5f / 128) * (64.5f / 128), 1e-6f);
    free(even);
    free(square);
}
