// shadow_judge_tables: the truth's light, and the rows of the sweep and of the stability table. See shadow_judge.h.
#include "shadow_judge.h"
#include "shadow_scenes.h"
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// A bounce's truth is noisy: at 256 samples a pixel by some per cent of a pixel's light, by a tenth of that in the mean of a picture. From the lights,
// near surfaces count by 1/r², so that nothing but a held distance and many samples make it smooth: so many of a picture, at least 256 a pixel.
enum { BOUNCE_SAMPLES = 256, FLUX_SAMPLES_A_PICTURE = 1 << 22 };

Image judge_light(const Asked *asked, const Truth *truth, JudgeLight what, float least_distance)
{
    const Scene *scene = asked->scene;
    const Camera *camera = &asked->camera;
    const int width = asked->gbuffer->width, height = asked->gbuffer->height;
    const int flux_samples = FLUX_SAMPLES_A_PICTURE / (width * height);
    const TruthPathSettings settings[] = {
        [DIRECT_LIGHT] = {.samples = 1, .bounces = 0},
        [BOUNCE_UNOCCLUDED] = {.samples = flux_samples > BOUNCE_SAMPLES ? flux_samples : BOUNCE_SAMPLES,
                               .least_distance = least_distance,
                               .bounces = 1,
                               .indirect_alone = true,
                               .bounce = TRUTH_BOUNCE_OF_FLUX_UNOCCLUDED},
        [BOUNCE_ALONE] = {.samples = BOUNCE_SAMPLES, .bounces = 1, .indirect_alone = true},
        [LIGHT_AND_BOUNCE] = {.samples = BOUNCE_SAMPLES, .bounces = 1},
    };
    const float view[] = {camera->eye[0],    camera->eye[1],          camera->eye[2], camera->target[0],
                          camera->target[1], camera->target[2],       camera->up[0],  camera->up[1],
                          camera->up[2],     camera->vertical_fov_rad};
    const int numbers[] = {width, height, (int)what, settings[what].samples,
                           (int)lroundf(1e6f * least_distance)};
    uint64_t inputs = hash_bytes(truth_hash_scene(scene), view, sizeof view);
    char *path = truth_cache_path("02_shadow_maps", hash_bytes(inputs, numbers, sizeof numbers), ".exr");
    Image image;
    if (access(path, R_OK) == 0) {
        image = image_read(path);
    } else {
        TruthPicture picture = truth_radiance(truth, scene, camera, width, height, &settings[what]);
        image = picture.mean;
        image_free(&picture.error);
        image_write(path, &image, 0.0f);
    }
    free(path);
    return image;
}

// The picture's texture as an image, top row first.
static Image image_of(GLuint picture, int width, int height)
{
    Image image = image_make(width, height, 3);
    const size_t row = 3 * (size_t)width, bytes = row * (size_t)height * sizeof(float);
    float *pixels = memory_new(row * (size_t)height, sizeof(float), "the picture");
    gl_texture_read(picture, 0, GL_RGB, GL_FLOAT, bytes, pixels);
    for (size_t y = 0; y < (size_t)height; y++)
        memcpy(image.pixels + y * row, pixels + ((size_t)height - 1 - y) * row, row * sizeof(float));
    free(pixels);
    return image;
}

// What the rows of one name and scene have measured so far.
enum { MOST_SERIES = 64, MOST_POINTS = 16 };
struct Series {
    struct {
        uint64_t key;
        size_t count;
        double side[MOST_POINTS], wrong[MOST_POINTS];
    } of[MOST_SERIES];
};

Series *judge_series_new(void)
{
    return memory_new(1, sizeof(Series), "the series of rows");
}

// The slope of log(wrong) over log(resolution) so far; 0 for a single row.
static double order_of(Series *series, const Run *run, const Scene *scene, double wrong)
{
    const char *name = run_case(run);
    uint64_t key = hash_bytes(hash_bytes(HASH_START, name, strlen(name)), scene->name, strlen(scene->name));
    key = key ? key : 1; // 0: a free place
    size_t i = 0;
    while (i + 1 < MOST_SERIES && series->of[i].key && series->of[i].key != key)
        i++;
    if (series->of[i].key != key)
        series->of[i].count = 0;
    series->of[i].key = key;
    if (series->of[i].count < MOST_POINTS) {
        series->of[i].side[series->of[i].count] = run_integer(run, "resolution");
        series->of[i].wrong[series->of[i].count++] = wrong;
    }
    const double order = measure_order(series->of[i].side, series->of[i].wrong, series->of[i].count);
    return isnan(order) ? 0.0 : order;
}

void judge_sweep(Run *run, Series *series, const Asked *asked, const Truth *truth, GLuint picture,
                 GLuint all_texels)
{
    const int width = asked->gbuffer->width, height = asked->gbuffer->height;
    Image got = image_of(picture, width, height);
    if (all_texels) {
        Image converged = image_of(all_texels, width, height);
        Image own = judge_light(asked, truth, BOUNCE_UNOCCLUDED,
                                run_chosen(run, "falloff", "clamp") ? (float)run_number(run, "clamp") : 0.0f);
        Image whole = judge_light(asked, truth, BOUNCE_ALONE, 0);
        run_image_errors(run, "converged", &got, &converged, "all_texels_");
        run_image_errors(run, "truth", &got, &own, "own_model_");
        run_image_errors(run, "truth", &got, &whole, "");
        image_free(&converged);
        image_free(&own);
        image_free(&whole);
    } else {
        const Judgement j = judge_all(asked, truth);
        run_error(run, "truth", "wrong", j.wrong);
        run_error(run, "truth", "wrong_dark", j.dark);
        run_error(run, "truth", "wrong_lit", j.leaked);
        run_error(run, "truth", "turned_away", j.turned_away);
        run_error(run, "truth", "mean_difference", j.difference);
        run_error(run, "truth", "edge_distance_mean", j.distance_mean);
        run_error(run, "truth", "edge_distance_p99", j.distance_p99);
        run_error(run, "truth", "edge_distance_max", j.distance_most);
        const double order = order_of(series, run, asked->scene, j.wrong);
        if (order != 0.0)
            run_error(run, "truth", "order", order);
        Image direct = judge_light(asked, truth, DIRECT_LIGHT, 0);
        run_image_errors(run, "truth", &got, &direct, "");
        image_free(&direct);
    }
    image_free(&got);
}

// Of all pixels that are judged: the share that is lit, by the technique and by the truth.
static void lit_shares(const Asked *asked, const Truth *truth, double *got, double *expected)
{
    double count = 0;
    *got = *expected = 0;
    for (size_t l = 0; l < asked->scene->light_count; l++) {
        Visibility v = judge_visibility(asked, truth, l);
        for (size_t i = 0; i < (size_t)v.width * (size_t)v.height; i++)
            if (v.truth[i] >= 0.0f && !v.turned_away[i]) {
                count++;
                *got += v.got[i];
                *expected += v.truth[i];
            }
        judge_visibility_free(&v);
    }
    *got /= fmax(count, 1);
    *expected /= fmax(count, 1);
}

// How far beyond a true shadow's border a wrong pixel may lie: a texel covers less than a pixel in these cases, a filter of radius 1
// reads a texel and a half to each side, and the border lies half a pixel before the pixel that is counted to.
static const double BORDER_PIXELS = 3;
// Light that is on a shadow's border may count as either: of about 400 border pixels of some 9000 a filter leaves a twentieth's difference.
static const double BORDER_SHARE = 0.01;

// Texels add up in single precision and read solid angles of their own: 24 576 of them leave 1e-5.
static const double FLUX_SHARE = 1e-4;
// The mean of 1680 pixels of 400 texels each, and the truth's of 256 samples, both within 1/2 %; light close to the room's edges comes from texels wider
// than its distance from them.
static const double MEAN_SHARE = 0.02;

static double mean_red(const Image *image)
{
    const size_t pixels = (size_t)image->width * (size_t)image->height, channels = (size_t)image->channels;
    double sum = 0;
    for (size_t i = 0; i < pixels; i++)
        sum += (double)image->pixels[channels * i];
    return sum / (double)pixels;
}

static void check_bounce(Run *run, const Asked *asked, const Truth *truth, const Image *image,
                         const ReflectiveMap *map)
{
    const long nonfinite = image_count_nonfinite(image);
    const size_t texels = 6 * (size_t)map->depth.resolution * (size_t)map->depth.resolution;
    float *flux = memory_new(4 * texels, sizeof *flux, "the reflective map");
    gl_texture_read(map->flux, 0, GL_RGBA, GL_FLOAT, 4 * texels * sizeof *flux, flux);
    double sum = 0;
    for (size_t i = 0; i < texels; i++)
        sum += (double)flux[4 * i];
    free(flux);
    run_check(run, "reflected flux, of 4 pi I rho", 1.0, sum / scenes_reflected_flux(asked->scene),
              FLUX_SHARE, nonfinite);
    if (map->depth.resolution == 1)
        return; // six texels keep the flux, not the picture
    Image expected = judge_light(asked, truth, BOUNCE_UNOCCLUDED, 0);
    run_check(run, "mean radiance, of the truth's", 1.0, mean_red(image) / mean_red(&expected), MEAN_SHARE,
              nonfinite);
    image_free(&expected);
}

void judge_stability(Run *run, const Asked *asked, const Truth *truth, GLuint picture,
                     const ReflectiveMap *reflective)
{
    Image image = image_of(picture, asked->gbuffer->width, asked->gbuffer->height);
    const long nonfinite = image_count_nonfinite(&image);
    const char *scene = asked->scene->name;
    if (asked->scene->mesh.triangle_count == 0) {
        double brightest = 0;
        for (int i = 0; i < 3 * image.width * image.height; i++)
            brightest = fmax(brightest, image.pixels[i]);
        run_check(run, "brightest", 0.0, brightest, 0.0, nonfinite); // nothing reflects
        image_free(&image);
        return;
    }
    if (reflective && scenes_reflected_flux(asked->scene) > 0) {
        check_bounce(run, asked, truth, &image, reflective);
        image_free(&image);
        return;
    }
    double got, expected;
    lit_shares(asked, truth, &got, &expected);
    const double closed = strcmp(run_case(run), "one texel") == 0 ? 0.0 : scenes_lit(scene);
    if (closed >= 0.0) {
        // Every pixel or none: nothing is rounded, so nothing is tolerated.
        run_check(run, "lit", closed, got, 0.0, nonfinite);
    } else {
        const Judgement j = judge_all(asked, truth);
        run_check(run, "lit", expected, got, BORDER_SHARE, nonfinite);
        run_check(run, "farthest wrong", 0.0, j.distance_most, BORDER_PIXELS, nonfinite);
    }
    image_free(&image);
}
