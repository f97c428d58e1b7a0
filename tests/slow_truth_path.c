// The truth's light at the number of samples that chapters use: unbiased, and its errors are what they say.
#include "truth_scenes.h"

enum { SIZE = 16, VALUES = 3 * SIZE * SIZE };

static TruthPicture picture_of(const Truth *truth, const Scene *scene, TruthPathSettings settings)
{
    return truth_radiance(truth, scene, &scene->camera, SIZE, SIZE, &settings);
}

static void free_both(TruthPicture *a, TruthPicture *b)
{
    truth_picture_free(a);
    truth_picture_free(b);
}

// A reference that is exact enters with no error of its own.
static TruthPicture uniform_picture(vec3 radiance)
{
    TruthPicture picture = {image_make(SIZE, SIZE, 3), image_make(SIZE, SIZE, 3)};
    for (size_t i = 0; i < VALUES; i++)
        picture.mean.pixels[i] = radiance[i % 3];
    return picture;
}

Test(truth_slow, furnace_at_1024_and_4096_samples, .timeout = 300)
{
    const vec3 emission = vec3_make(1, 0.5f, 2), albedo = vec3_make(0.2f, 0.5f, 0.9f);
    Scene *scene = furnace(emission, albedo);
    Truth *truth = scene_ready(scene);
    const vec3 limit = emission / (vec3_make(1, 1, 1) - albedo + (vec3){0, 0, 0, 1});
    for (int samples = 1024; samples <= 4096; samples *= 4) {
        TruthPicture picture = picture_of(
            truth, scene, (TruthPathSettings){.samples = samples, .bounces = TRUTH_FULL, .seed = 11});
        TruthPicture reference = uniform_picture(limit);
        check_same_mean(&picture, &reference, "furnace");
        free_both(&picture, &reference);
    }
    scene_end(scene, truth);
}

// Against 16 times as many samples of another seed: the reference's own error, a quarter of the judged one's, widens the bound by 3 %.
Test(truth_slow, cornell_at_1024_and_4096_samples, .timeout = 300)
{
    Scene *scene = scene_open("cornell", 1);
    Truth *truth = truth_open(&scene->mesh);
    TruthPathSettings settings = {.samples = 65536, .bounces = TRUTH_FULL, .seed = 1};
    TruthPicture reference = picture_of(truth, scene, settings);
    for (settings.samples = 1024; settings.samples <= 4096; settings.samples *= 4) {
        settings.seed++;
        TruthPicture picture = picture_of(truth, scene, settings);
        check_same_mean(&picture, &reference, "cornell");
        truth_picture_free(&picture);
    }
    truth_picture_free(&reference);
    scene_end(scene, truth);
}

// An estimator that never looks for the lamp, only meets it, against one that finds it by area too.
Test(truth_slow, lamp_by_direction_and_by_both, .timeout = 300)
{
    Scene *scene = cornell_with_lamp();
    Truth *truth = scene_ready(scene);
    TruthPicture both =
        picture_of(truth, scene, (TruthPathSettings){.samples = 1024, .bounces = TRUTH_FULL, .seed = 21});
    TruthPicture direction = picture_of(
        truth, scene,
        (TruthPathSettings){
            .samples = 16384, .bounces = TRUTH_FULL, .emitters = TRUTH_EMITTERS_BY_DIRECTION, .seed = 22});
    check_same_mean(&both, &direction, "lamp");
    free_both(&both, &direction);
    scene_end(scene, truth);
}
