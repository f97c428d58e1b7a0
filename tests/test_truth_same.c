// The truth's picture where it may not change, by a bit: threads, scale, place, brightness; where it is black; what is refused.
#include "failure.h"
#include "truth_scenes.h"

enum { SIZE = 12 };

static TruthPicture picture_of(const Truth *truth, const Scene *scene, TruthPathSettings settings)
{
    return truth_radiance(truth, scene, &scene->camera, SIZE, SIZE, &settings);
}

static void check_equal(const TruthPicture *a, const TruthPicture *b, const char *what)
{
    const size_t bytes = 3 * SIZE * SIZE * sizeof(float);
    cr_assert(memcmp(a->mean.pixels, b->mean.pixels, bytes) == 0, "%s: the mean differs", what);
    cr_assert(memcmp(a->error.pixels, b->error.pixels, bytes) == 0, "%s: the error differs", what);
}

static double largest_of(const Image *image)
{
    double largest = 0.0;
    for (size_t i = 0; i < 3 * (size_t)image->width * (size_t)image->height; i++)
        largest = fmax(largest, fabs((double)image->pixels[i]));
    return largest;
}

// --- what must not change the picture

Test(truth_same, same_bits_on_any_number_of_threads)
{
    Scene *scene = cornell_with_lamp();
    Truth *truth = scene_ready(scene);
    TruthPathSettings settings = {.samples = 8, .bounces = TRUTH_FULL, .seed = 3, .threads = 1};
    TruthPicture one = picture_of(truth, scene, settings);
    for (settings.threads = 0; settings.threads < 6; settings.threads++) {
        TruthPicture many = picture_of(truth, scene, settings);
        check_equal(&one, &many, "threads");
        truth_picture_free(&many);
    }
    settings.seed++;
    TruthPicture other = picture_of(truth, scene, settings);
    cr_assert(memcmp(one.mean.pixels, other.mean.pixels, 64) != 0, "the seed changes nothing");
    truth_picture_free(&other);
    truth_picture_free(&one);
    scene_end(scene, truth);
}

// Doubling is exact in float32, so every path and every bit of the mean must follow.
Test(truth_same, linear_in_intensity_and_additive_over_lights)
{
    Scene *scene = scene_open("cornell", 1);
    Truth *truth = truth_open(&scene->mesh);
    scene_add_light(scene, (Light){.kind = LIGHT_DIRECTIONAL,
                                   .direction = vec3_normalize(vec3_make(0.3f, -0.5f, -1)),
                                   .intensity = vec3_make(1, 2, 4)});
    const TruthPathSettings settings = {.samples = 16, .bounces = 3, .seed = 3};
    TruthPicture both = picture_of(truth, scene, settings);
    const Light second = scene->lights[1];
    scene->light_count = 1;
    TruthPicture first = picture_of(truth, scene, settings);
    scene->lights[0].intensity *= 2.0f;
    TruthPicture doubled = picture_of(truth, scene, settings);
    scene->lights[0] = second;
    TruthPicture other = picture_of(truth, scene, settings);
    for (size_t p = 0; p < SIZE * SIZE; p++)
        for (int k = 0; k < 3; k++) {
            cr_assert(channel_of(&doubled.mean, p, k) == 2.0f * channel_of(&first.mean, p, k), "not doubled");
            double sum = (double)channel_of(&first.mean, p, k) + (double)channel_of(&other.mean, p, k);
            // the same paths: float32 sums of four bounces
            cr_assert(fabs(sum - (double)channel_of(&both.mean, p, k)) <= 1e-6 * sum, "lights do not add up");
        }
    truth_picture_free(&both);
    truth_picture_free(&first);
    truth_picture_free(&doubled);
    truth_picture_free(&other);
    scene_end(scene, truth);
}

// A room and a block whose coordinates are multiples of 1/8, centred on the origin: exact at every power of two and, shifted, up to 2^20.
static TruthPicture room_at(int power, vec3 shift, bool open)
{
    const float s = ldexpf(1.0f, power);
    Scene *scene = scene_begin();
    uint32_t walls = scene_add_material(scene, "walls", vec3_make(0.5f, 0.75f, 0.25f), BLACK);
    uint32_t lamp = scene_add_material(scene, "lamp", vec3_make(0.5f, 0.5f, 0.5f), vec3_make(1, 2, 3));
    mesh_add_box(&scene->mesh, s * vec3_make(-4, -3, -5) + shift, s * vec3_make(4, 3, 5) + shift, walls);
    mesh_add_box(&scene->mesh, s * vec3_make(-1, -1, -2.5f) + shift, s * vec3_make(1.125f, 0.5f, 0) + shift,
                 walls);
    if (open)
        mesh_add_quad(&scene->mesh, s * vec3_make(-2, 2.5f, 0) + shift, s * vec3_make(0, 0, 1),
                      s * vec3_make(1, 0, 0), lamp);
    scene_add_light(scene, (Light){.kind = LIGHT_POINT, // in the block, or in the room
                                   .position = s * vec3_make(0.25f, open ? 2.0f : 0.0f, -1.0f) + shift,
                                   .intensity = s * s * vec3_make(4, 4, 4),
                                   .radius = 0.125f * s});
    scene->camera = (Camera){.eye = s * vec3_make(3, 0.5f, 4.5f) + shift,
                             .target = s * vec3_make(0, 0, -1) + shift,
                             .up = vec3_make(0, 1, 0),
                             .vertical_fov_rad = 1.0f,
                             .near_distance = 0.01f * s};
    Truth *truth = scene_ready(scene);
    TruthPicture picture = picture_of(truth, scene, (TruthPathSettings){.samples = 8, .bounces = 4});
    scene_end(scene, truth);
    return picture;
}

Test(truth_same, same_bits_at_every_scale_and_place)
{
    TruthPicture here = room_at(0, BLACK, true);
    cr_assert(largest_of(&here.mean) > 0.1, "the room is dark");
    const struct {
        int power;
        vec3 shift;
        const char *what;
    } cases[] = {
        {20, BLACK, "10^6 times the size"},
        {-20, BLACK, "10^-6 times the size"},
        {0, vec3_make(0x1p20f, -0x1p20f, 0x1p19f), "10^6 m from the origin"},
        {-17, vec3_make(8, 4, -8), "10^6 times its size from the origin"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        TruthPicture there = room_at(cases[i].power, cases[i].shift, true);
        check_equal(&here, &there, cases[i].what);
        truth_picture_free(&there);
    }
    truth_picture_free(&here);
}

// --- nothing to see, nothing that lights

Test(truth_same, dark_where_there_is_no_light)
{
    TruthPicture inside = room_at(0, BLACK, false);
    cr_assert(largest_of(&inside.mean) == 0.0 && largest_of(&inside.error) == 0.0,
              "light leaves the closed block it is in");
    truth_picture_free(&inside);
    const char *names[] = {"empty", "cornell"};
    for (size_t i = 0; i < 2; i++) {
        Scene *scene = scene_open(names[i], 1);
        if (i == 1)
            scene->light_count = 0;
        Truth *truth = truth_open(&scene->mesh);
        for (int flux = 0; flux < 2; flux++) {
            TruthPicture picture = picture_of(
                truth, scene,
                (TruthPathSettings){.samples = 2,
                                    .bounces = 1,
                                    .bounce = flux ? TRUTH_BOUNCE_OF_FLUX : TRUTH_BOUNCE_OF_PATHS});
            cr_assert(largest_of(&picture.mean) == 0.0, "%s: light out of nothing", names[i]);
            truth_picture_free(&picture);
        }
        scene_end(scene, truth);
    }
}

Test(truth_same, many_segments_are_occluded_as_one)
{
    Scene *scene = scene_open("cornell", 1);
    Truth *truth = truth_open(&scene->mesh);
    enum { COUNT = 10001 };
    vec3 *from = memory_new(COUNT, sizeof *from, "points"), *to = memory_new(COUNT, sizeof *to, "points");
    for (uint64_t i = 0; i < COUNT; i++) {
        uint64_t bits = hash_bytes(HASH_START, &i, sizeof i);
        from[i] =
            vec3_make((float)(bits & 1023), (float)(bits >> 10 & 1023), (float)(bits >> 20 & 1023)) / 180.0f;
        to[i] =
            vec3_make((float)(bits >> 30 & 1023), (float)(bits >> 40 & 1023), (float)(bits >> 50 & 1023)) /
            180.0f;
        from[i][0] -= 2.8f, to[i][0] -= 2.8f;
    }
    uint32_t *bits = truth_occluded_many(truth, from, to, COUNT);
    int hidden = 0;
    for (size_t i = 0; i < COUNT; i++) {
        bool expected = truth_occluded(truth, from[i], to[i]);
        cr_assert_eq((bool)(bits[i >> 5] >> (i & 31) & 1), expected, "segment %zu", i);
        hidden += expected;
    }
    cr_assert(hidden > COUNT / 10 && hidden < 9 * COUNT / 10, "%d of %d are hidden: too one-sided", hidden,
              COUNT);
    free(bits);
    free(from);
    free(to);
    scene_end(scene, truth);
}

// --- what is refused

static void ask(TruthPathSettings settings)
{
    Scene *scene = scene_open("cornell", 1);
    picture_of(truth_open(&scene->mesh), scene, settings);
}
static void no_samples(void)
{
    ask((TruthPathSettings){0});
}
static void bounces_below_full(void)
{
    ask((TruthPathSettings){.samples = 1, .bounces = -2});
}
static void flux_twice(void)
{
    ask((TruthPathSettings){.samples = 1, .bounces = 2, .bounce = TRUTH_BOUNCE_OF_FLUX});
}
static void not_a_distance(void)
{
    ask((TruthPathSettings){.samples = 1, .least_distance = -1.0f});
}
static void less_than_no_thread(void)
{
    ask((TruthPathSettings){.samples = 1, .threads = -1});
}
static void no_pixels(void)
{
    Scene *scene = scene_open("empty", 1);
    truth_radiance(truth_open(&scene->mesh), scene, &scene->camera, 0, 4, &(TruthPathSettings){.samples = 1});
}
static void another_mesh(void)
{
    Scene *scene = scene_open("cornell", 1);
    picture_of(truth_open(&(Mesh){0}), scene, (TruthPathSettings){.samples = 1});
}

Test(truth_same, settings_without_sense_are_refused)
{
    const struct {
        void (*function)(void);
        int status;
        const char *says;
    } cases[] = {
        {no_samples, 2, "samples is 0; the truth needs at least 1"},
        {bounces_below_full, 2, "bounces is -2"},
        {flux_twice, 2, "bounces is 2; flux from the lights bounces once"},
        {not_a_distance, 2, "least_distance is -1 m"},
        {less_than_no_thread, 2, "threads is -1"},
        {no_pixels, 2, "0x4 pixels"},
        {another_mesh, 1, "is asked about one of"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        Failure failure = failure_of(cases[i].function);
        cr_expect_eq(failure.status, cases[i].status, "case %zu: status %d", i, failure.status);
        cr_expect(failure_says(&failure, cases[i].says), "case %zu says: %s", i, failure.message);
    }
}
