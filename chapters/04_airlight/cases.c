// cases: what must come out of the stability cases: the truth, or an invariance.
#include "judge.h"

#include <stdlib.h>
#include <string.h>

// A scene of its own: what a case changes in it, nobody else sees.
typedef struct Copy {
    Scene scene;
    Camera camera;
} Copy;

static Copy copy_make(const Scene *scene, const Camera *camera, float scale)
{
    Copy copy = {*scene, *camera};
    const size_t floats = 3 * scene->mesh.vertex_count;
    copy.scene.lights = memory_new(scene->light_count + 1, sizeof(Light), "lights");
    copy.scene.mesh.positions = memory_new(floats + 1, sizeof(float), "positions");
    for (size_t i = 0; i < floats; i++)
        copy.scene.mesh.positions[i] = scale * scene->mesh.positions[i];
    for (size_t i = 0; i < scene->light_count; i++) {
        Light *light = &copy.scene.lights[i];
        *light = scene->lights[i];
        light->position *= scale;
        light->radius *= scale;
        light->intensity *= light->kind == LIGHT_DIRECTIONAL ? 1.0f : scale * scale;
    }
    copy.scene.lower *= scale;
    copy.scene.upper *= scale;
    copy.scene.medium.scattering /= scale;
    copy.scene.medium.absorption /= scale;
    copy.camera.eye *= scale;
    copy.camera.target *= scale;
    copy.camera.near_distance *= scale;
    return copy;
}

static void copy_free(Copy *copy)
{
    free(copy->scene.lights);
    free(copy->scene.mesh.positions);
}

static Image draw(Run *run, const Raster *raster, const Copy *copy, const AirlightSettings *settings,
                  int size)
{
    return airlight_picture(raster, &copy->scene, &copy->camera, size, size, run_integer(run, "map"),
                            settings);
}

// The largest |a/b - 1| where b is above `least` of its mean; NaN counts as infinite.
static double largest_ratio(const Image *a, const Image *b, double least)
{
    double mean = 0.0, largest = 0.0;
    const int values = a->width * a->height * 3;
    for (int i = 0; i < values; i++)
        mean += (double)b->pixels[i / 3 * 4 + i % 3] / values;
    for (int i = 0; i < values; i++) {
        const double x = (double)a->pixels[i / 3 * 4 + i % 3], y = (double)b->pixels[i / 3 * 4 + i % 3];
        const double error = fabs(x - y) / fmax(y, least * mean);
        if (y > 0.0 || x > 0.0)
            largest = isnan(error) ? INFINITY : fmax(largest, error);
    }
    return largest;
}

static double sum_of(const Image *image)
{
    double sum = 0.0;
    for (int i = 0; i < image->width * image->height * 3; i++)
        sum += (double)image->pixels[i / 3 * 4 + i % 3];
    return sum;
}

// Radiance over the sphere at the camera's eye, red, from six square views of 90°.
static double fluence(Run *run, const Raster *raster, Copy *copy, const AirlightSettings *settings)
{
    enum { SIDE = 96 };
    double sum = 0.0;
    for (int face = 0; face < 6; face++) {
        vec3 ahead = {0};
        ahead[face / 2] = face % 2 ? 1.0f : -1.0f;
        copy->camera.target = copy->camera.eye + ahead;
        copy->camera.vertical_fov_rad = (float)M_PI_2;
        Image image = draw(run, raster, copy, settings, SIDE);
        for (size_t i = 0; i < (size_t)SIDE * SIDE; i++) {
            const size_t column = i % SIDE, row = i / SIDE;
            const double u = 2.0 * ((double)column + 0.5) / SIDE - 1.0,
                         v = 2.0 * ((double)row + 0.5) / SIDE - 1.0;
            sum += (double)image.pixels[4 * i] * 4.0 / (SIDE * SIDE) / pow(1.0 + u * u + v * v, 1.5);
        }
        image_free(&image);
    }
    return sum;
}

static void check_reciprocity(Run *run, const Raster *raster, const Camera *camera,
                              const AirlightSettings *settings)
{
    Copy copy = copy_make(run_scene(run), camera, 1.0f);
    const double there = fluence(run, raster, &copy, settings);
    const vec3 eye = copy.camera.eye;
    copy.camera.eye = copy.scene.lights[0].position;
    copy.scene.lights[0].position = eye;
    const double back = fluence(run, raster, &copy, settings);
    // 96² rays a side meet shadow borders by chance, and the maps of the two lights differ in theirs
    run_check(run, "fluence", there, back, 0.01 * there, 0);
    copy_free(&copy);
}

static void check_additive(Run *run, const Raster *raster, const Camera *camera,
                           const AirlightSettings *settings, const Image *got)
{
    Image sum = image_make(got->width, got->height, 4);
    for (size_t light = 0; light < run_scene(run)->light_count; light++) {
        Copy copy = copy_make(run_scene(run), camera, 1.0f);
        copy.scene.lights[0] = copy.scene.lights[light];
        copy.scene.light_count = 1;
        Image one = draw(run, raster, &copy, settings, got->width);
        for (int i = 0; i < got->width * got->height * 4; i++)
            sum.pixels[i] += one.pixels[i];
        image_free(&one);
        copy_free(&copy);
    }
    run_check(run, "largest relative change", 0.0, largest_ratio(got, &sum, 1e-6), 1e-6,
              image_count_nonfinite(got));
    image_free(&sum);
}

// Lengths times `scale`, σ over it, intensities times its square: the same radiance. Twice the light: twice the radiance.
static void check_scaled(Run *run, const Raster *raster, const Camera *camera,
                         const AirlightSettings *settings, const Image *got, float scale, float brighter)
{
    Copy copy = copy_make(run_scene(run), camera, scale);
    for (size_t i = 0; i < copy.scene.light_count; i++)
        copy.scene.lights[i].intensity *= brighter;
    Image image = draw(run, raster, &copy, settings, got->width);
    for (int i = 0; i < got->width * got->height * 4; i++)
        image.pixels[i] /= brighter;
    // Doubling is exact. Scaling by a power of ten rounds every length (2^-24 each); a ray that passes a texel's border or an edge within that rounding
    // may see another texel, which at the worst pixel changes a small part of the sum.
    run_check(run, "largest relative change", 0.0, largest_ratio(&image, got, 1e-2),
              brighter == 1.0f ? 2e-2 : 0.0, image_count_nonfinite(&image));
    run_check(run, "sum", sum_of(got), sum_of(&image), brighter == 1.0f ? 1e-4 * sum_of(got) : 0.0,
              image_count_nonfinite(&image));
    image_free(&image);
    copy_free(&copy);
}

// Surfaces seen through a medium that only takes light away, against those in clear air.
static void check_absorption(Run *run, const Raster *raster, const AirlightHaze *haze, const Camera *camera,
                             const Image *got)
{
    const Scene *scene = run_scene(run);
    const int width = got->width, height = got->height;
    const Light *light = &scene->lights[0];
    RasterView view = raster_view_open(raster, scene, width, height, run_integer(run, "map"));
    RasterTarget clear = raster_target_open("clear", width, height),
                 dim = raster_target_open("dim", width, height);
    raster_view_draw_maps(&view);
    raster_gbuffer_draw(raster, &view.gbuffer, camera, &view.mesh);
    raster_light_add(raster, &view.gbuffer, camera, light, &view.maps[0], clear.texture);
    airlight_haze_attenuate(haze, &view.gbuffer, camera, scene, light, clear.texture, dim.texture);
    Image before = raster_target_read(&clear, width, height), after = raster_target_read(&dim, width, height);
    const size_t pixels = (size_t)width * (size_t)height;
    float *seen = memory_new(pixels, sizeof *seen, "distances");
    gl_texture_read(view.gbuffer.distance, 0, GL_RED, GL_FLOAT, sizeof *seen * pixels, seen);
    const double sigma = (double)scene->medium.absorption[0];
    const mat4 turn = camera_view(*camera);
    const double half = tan(0.5 * (double)camera->vertical_fov_rad);
    for (int i = 0; i < width * height; i++) { // expected, in place of `before`
        const int column = i % width, row = i / width;
        const double d = (double)seen[(height - 1 - row) * width + column];
        const double u = half * (2.0 * (column + 0.5) / width - 1.0),
                     v = half * (1.0 - 2.0 * (row + 0.5) / height);
        double leg = 0.0;
        for (int k = 0; k < 3; k++) {
            const double along =
                (u * (double)turn.column[k][0] + v * (double)turn.column[k][1] - (double)turn.column[k][2]) /
                sqrt(1 + u * u + v * v);
            leg = hypot(leg, (double)camera->eye[k] + d * along - (double)light->position[k]);
        }
        for (int k = 0; k < 3; k++)
            before.pixels[4 * i + k] *= isfinite(d) ? (float)exp(-sigma * (d + leg)) : 0.0f;
    }
    // the rounding of a distance of 4 m, times σ, and of exp
    run_check(run, "largest relative error of surfaces", 0.0, largest_ratio(&after, &before, 1e-3), 5e-6,
              image_count_nonfinite(&after));
    run_check(run, "airlight", 0.0, sum_of(got), 0.0, image_count_nonfinite(got));
    free(seen);
    image_free(&before);
    image_free(&after);
    raster_target_close(&clear);
    raster_target_close(&dim);
    raster_view_close(&view);
}

// σ = 0: what is attenuated is the very picture of the surfaces, and nothing is added.
static void check_clear(Run *run, const Raster *raster, const AirlightHaze *haze, const Camera *camera,
                        const Image *got)
{
    const Scene *scene = run_scene(run);
    RasterView view = raster_view_open(raster, scene, got->width, got->height, run_integer(run, "map"));
    RasterTarget clear = raster_target_open("clear", got->width, got->height),
                 dim = raster_target_open("dim", got->width, got->height);
    raster_view_draw_maps(&view);
    raster_gbuffer_draw(raster, &view.gbuffer, camera, &view.mesh);
    raster_light_add(raster, &view.gbuffer, camera, &scene->lights[0], &view.maps[0], clear.texture);
    airlight_haze_attenuate(haze, &view.gbuffer, camera, scene, &scene->lights[0], clear.texture,
                            dim.texture);
    Image before = raster_target_read(&clear, got->width, got->height),
          after = raster_target_read(&dim, got->width, got->height);
    run_check(run, "largest relative change of surfaces", 0.0, largest_ratio(&after, &before, 1e-3), 0.0,
              image_count_nonfinite(&after));
    run_check(run, "airlight", 0.0, sum_of(got), 0.0, image_count_nonfinite(got));
    image_free(&before);
    image_free(&after);
    raster_target_close(&clear);
    raster_target_close(&dim);
    raster_view_close(&view);
}

// Where nothing casts a shadow, every pixel is the truth's, to the closed form's own 1e-4, 3e-4 with a peaked phase function, and the rounding of
// vectors: 2^-24 times how many times nearer the light is to the ray than to the eye, here up to 10². A spot's cone can be met in a chord as short as you
// like, whose length is then all rounding: pixels count against a hundredth of the mean at least. Samples of the ray by their number. What comes through a
// depth map is the truth's in the mean alone, within the map's texels.
static void check_truth(Run *run, const Camera *camera, const AirlightSettings *settings, const Image *got)
{
    const Scene *scene = run_scene(run);
    Image truth = airlight_truth(scene, camera, got->width, got->height, 1, settings, -1.0f);
    const bool sampled = strcmp(settings->method, "equiangular") == 0,
               mapped = scene->mesh.triangle_count > 0;
    const double least = scene->lights[0].kind == LIGHT_SPOT ? 1e-2 : 1e-9;
    const double mean = mapped ? 2e-2 : sampled ? 1e-3 : 1e-4;
    if (!mapped)
        run_check(run, "largest relative error", 0.0, largest_ratio(got, &truth, least),
                  sampled ? 1e-3 : 3e-4, image_count_nonfinite(got));
    run_check(run, "sum", sum_of(&truth), sum_of(got), mean * sum_of(&truth), image_count_nonfinite(got));
    image_free(&truth);
}

// How wrong a method was at worst among 10^5 random rays (build/worst), and half as much again: what can happen, not what is wanted. Sampling with 64 samples misses a
// peak or meets it alone. Sun and Pegoraro know no radius inside which the inverse square is held. Gauss and intervals are right to 1e-4 and the rounding of vectors;
// signed sums cancel.
static double worst_bound(const char *name)
{
    static const struct {
        const char *method;
        double error;
    } bounds[] = {{"march", 20},     {"jittered", 4000}, {"equiangular", 1.5},
                  {"factored", 1.5}, {"gauss", 1.2e-3},  {"sun", 850},
                  {"pegoraro", 850}, {"segments", 7e-3}, {"signed", 1.1e7}};
    for (size_t i = 0; i < sizeof bounds / sizeof *bounds; i++) {
        const size_t length = strlen(bounds[i].method);
        if (strncmp(name, bounds[i].method, length) == 0 && name[length] == ',')
            return bounds[i].error;
    }
    fail_work("no bound for the case 'worst of %s'", name);
}

static void check_worst(Run *run, const Camera *camera, const AirlightSettings *settings, const Image *got)
{
    const Scene *scene = run_scene(run);
    const Light *light = &scene->lights[0];
    const int width = got->width, height = got->height;
    Image truth = airlight_truth(scene, camera, width, height, 1, settings, -1.0f);
    uint32_t *first = memory_new((size_t)(width * height) + 1, sizeof *first, "lit spans");
    TruthSpan *spans = truth_lit_picture(scene, light, camera, width, height, first);
    const double far = (double)vec3_length(light->position - camera->eye);
    double largest = 0.0;
    for (int i = 0; i < width * height; i++) { // bottom row first, as spans are
        const int row = height - 1 - i / width;
        const size_t pixel = (size_t)row * (size_t)width + (size_t)(i % width);
        const double expected = (double)truth.pixels[4 * pixel],
                     error = fabs((double)got->pixels[4 * pixel] - expected) / expected;
        if (first[i] < first[i + 1] && expected >= 1.2e-38 && airlight_chord_counts(spans[first[i]], far))
            largest = isnan(error) ? INFINITY : fmax(largest, error);
    }
    run_check(run, "largest relative error", 0.0, largest, worst_bound(run_case(run) + strlen("worst of ")),
              image_count_nonfinite(got));
    image_free(&truth);
    free(first);
    free(spans);
}

void airlight_case(Run *run, const Raster *raster, const AirlightHaze *haze, const Camera *camera,
                   const AirlightSettings *settings, const Image *got)
{
    const char *name = run_case(run);
    if (strcmp(name, "linear") == 0)
        check_scaled(run, raster, camera, settings, got, 1.0f, 2.0f);
    else if (strcmp(name, "larger") == 0)
        check_scaled(run, raster, camera, settings, got, 1e6f, 1.0f);
    else if (strcmp(name, "smaller") == 0)
        check_scaled(run, raster, camera, settings, got, 1e-6f, 1.0f);
    else if (strcmp(name, "additive") == 0)
        check_additive(run, raster, camera, settings, got);
    else if (strcmp(name, "reciprocal") == 0)
        check_reciprocity(run, raster, camera, settings);
    else if (strncmp(name, "worst of ", 9) == 0)
        check_worst(run, camera, settings, got);
    else if (strcmp(name, "no medium") == 0)
        check_clear(run, raster, haze, camera, got);
    else if (strcmp(name, "pure absorption") == 0)
        check_absorption(run, raster, haze, camera, got);
    else
        check_truth(run, camera, settings, got);
}
