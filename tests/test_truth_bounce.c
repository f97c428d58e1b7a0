// The truth's indirect light: estimators against each other, the reflective shadow map's model, scale, place, threads, and what is refused.
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

// --- estimators that share neither the way they look for light nor their random numbers

// One bounce by paths from the eye and by rays from the lights: of a point light, of a spot whose r0 reaches beyond a block, of the sun. At
// points of floor, ceiling, back and left wall that keep 0.4 m from the room's edges: nearer to an edge half of the light comes from the
// other wall from nearly no distance at all, and rays from the lights, which seldom fall there, say too little about their own error.
Test(truth_bounce, paths_and_flux_agree_in_cornell)
{
    Scene *scene = scene_open("cornell", 1);
    Truth *truth = truth_open(&scene->mesh);
    const Light lights[3] = {scene->lights[0],
                             {.kind = LIGHT_SPOT,
                              .position = vec3_make(0.5f, 5, 0.5f),
                              .direction = vec3_normalize(vec3_make(0.1f, -1, 0.2f)),
                              .intensity = vec3_make(30, 30, 30),
                              .half_angle_rad = 0.6f,
                              .radius = 4.0f},
                             {.kind = LIGHT_DIRECTIONAL,
                              .direction = vec3_normalize(vec3_make(0.3f, -0.5f, -1)),
                              .intensity = vec3_make(4, 4, 4)}};
    enum { SIDE = 6, COUNT = 4 * SIDE * SIDE };
    for (uint64_t i = 0; i < 3; i++) {
        scene->lights[0] = lights[i];
        double sums[2] = {0}, errors = 0.0;
        int within = 0;
        for (int p = 0; p < COUNT; p++) {
            const float u = 0.92f * (float)(p % SIDE) - 2.3f, v = 0.91f * (float)(p / SIDE % SIDE) - 2.29f;
            const vec3 points[4] = {vec3_make(u, 0, v), vec3_make(u, 5.5f, v),
                                    vec3_make(u, v + 2.75f, -2.75f), vec3_make(-2.75f, u + 2.75f, v)},
                       normals[4] = {vec3_make(0, 1, 0), vec3_make(0, -1, 0), vec3_make(0, 0, 1),
                                     vec3_make(1, 0, 0)};
            const int wall = p / (SIDE * SIDE);
            TruthPathSettings settings = {
                .samples = 512, .bounces = 1, .indirect_alone = true, .seed = 1000 * i + (uint64_t)p};
            const TruthIrradiance paths =
                truth_irradiance(truth, scene, points[wall], normals[wall], &settings);
            settings.bounce = TRUTH_BOUNCE_OF_FLUX;
            settings.samples = 4096;
            settings.seed += 1000000;
            const TruthIrradiance flux =
                truth_irradiance(truth, scene, points[wall], normals[wall], &settings);
            within += fabs(paths.mean[1] - flux.mean[1]) <= 3.0 * hypot(paths.error[1], flux.error[1]);
            sums[0] += paths.mean[1], sums[1] += flux.mean[1];
            errors += paths.error[1] * paths.error[1] + flux.error[1] * flux.error[1];
        }
        cr_assert(sqrt(errors) < 0.02 * sums[0], "light %d: an error of %g of %g says little", (int)i,
                  sqrt(errors), sums[0]);
        cr_assert(fabs(sums[0] - sums[1]) <= 3.0 * sqrt(errors),
                  "light %d: means %g and %g are %.2f errors apart", (int)i, sums[0], sums[1],
                  (sums[0] - sums[1]) / sqrt(errors));
        cr_assert(within >= 0.99 * COUNT, "light %d: only %d of %d points within 3 errors", (int)i, within,
                  COUNT);
    }
    scene_end(scene, truth);
}

// All bounces in a room lit by a lamp: found by points of the lamp alone, and by both ways.
Test(truth_bounce, lamp_by_area_and_by_both)
{
    Scene *scene = cornell_with_lamp();
    Truth *truth = scene_ready(scene);
    TruthPathSettings settings = {.samples = 256, .bounces = TRUTH_FULL, .seed = 1};
    TruthPicture both = picture_of(truth, scene, settings);
    settings.emitters = TRUTH_EMITTERS_BY_AREA;
    settings.seed = 2;
    TruthPicture area = picture_of(truth, scene, settings);
    check_same_mean(&both, &area, "lamp");
    truth_picture_free(&both);
    truth_picture_free(&area);
    scene_end(scene, truth);
}

// --- the reflective shadow map's model: the sun on a plate that faces down, on which light comes from below

enum { HIDDEN = 1 };
static Scene *plate_in_sun(int hidden)
{
    Scene *scene = scene_begin();
    uint32_t white = scene_add_material(scene, "white", vec3_make(0.5f, 0.5f, 0.5f), BLACK);
    uint32_t black = scene_add_material(scene, "black", BLACK, BLACK);
    mesh_add_quad(&scene->mesh, vec3_make(-1, 2, -0.75f), vec3_make(2, 0, 0), vec3_make(0, 0, 1.5f), white);
    if (hidden) // upright, between the plate and the points at x > 4, beside the sun's rays
        mesh_add_quad(&scene->mesh, vec3_make(3, -4, -3), vec3_make(0, 8, 0), vec3_make(0, 0, 6), black);
    scene_add_light(
        scene,
        (Light){.kind = LIGHT_DIRECTIONAL, .direction = vec3_make(0, 1, 0), .intensity = vec3_make(4, 4, 4)});
    return scene;
}

// Seen from straight ahead the room's edges are the picture's diagonals: every pixel there stands for a point that rounding puts on either
// side of the other wall. All of them are lit by all the room.
Test(truth_bounce, edges_of_a_room_are_not_dark)
{
    Scene *scene = furnace(vec3_make(1, 1, 1), vec3_make(0.5f, 0.5f, 0.5f));
    const vec3 middle = 0.5f * (vec3_make(-1, -2, -1.5f) + vec3_make(2, 1, 1));
    for (int axis = 0; axis < 3; axis++) {
        scene->camera.eye = scene->camera.target = middle;
        scene->camera.target[axis] += 1.0f;
        Truth *truth = scene_ready(scene);
        TruthPicture picture = truth_radiance(
            truth, scene, &scene->camera, 40, 40,
            &(TruthPathSettings){.samples = 16, .bounces = 3, .emitters = TRUTH_EMITTERS_BY_DIRECTION});
        for (size_t i = 0; i < 1600; i++) // Σ 0.5^i, i ≤ 4; to rounding
            cr_assert_float_eq((double)channel_of(&picture.mean, i, 0), 1.9375, 1e-5,
                               "axis %d, pixel %zu: %g", axis, i, (double)channel_of(&picture.mean, i, 0));
        truth_picture_free(&picture);
        truth_close(truth);
    }
    scene_end(scene, NULL);
}

// The plate's radiosity is uniform, so its light is a polygon's: radiance 0.5 · 4 / π. The wall's share changes with the model alone.
Test(truth_bounce, flux_of_a_plate_is_a_polygons_light)
{
    const vec3 corners[4] = {vec3_make(-1, 2, -0.75f), vec3_make(1, 2, -0.75f), vec3_make(1, 2, 0.75f),
                             vec3_make(-1, 2, 0.75f)};
    const TruthBounce bounces[] = {TRUTH_BOUNCE_OF_PATHS, TRUTH_BOUNCE_OF_FLUX,
                                   TRUTH_BOUNCE_OF_FLUX_UNOCCLUDED};
    for (int hidden = 0; hidden < 2; hidden++) {
        Scene *scene = plate_in_sun(hidden);
        Truth *truth = scene_ready(scene);
        for (int i = 0; i < 6; i++) {
            const vec3 point = vec3_make(4.5f + 0.25f * (float)i, 0.2f * (float)i, 0.5f),
                       normal = vec3_normalize(vec3_make(-0.3f * (float)i, 1, 0.1f));
            for (size_t b = 0; b < 3; b++) {
                const TruthPathSettings settings = {
                    .samples = 8192, .bounces = 1, .indirect_alone = true, .bounce = bounces[b], .seed = 7};
                TruthIrradiance got = truth_irradiance(truth, scene, point, normal, &settings);
                double expected = 2.0 / M_PI * polygon_irradiance(corners, 4, point, normal);
                if (hidden && bounces[b] != TRUTH_BOUNCE_OF_FLUX_UNOCCLUDED) {
                    cr_assert(got.mean[0] == 0.0, "light passes through the wall");
                    continue;
                }
                cr_assert(got.error[0] > 0.0 && got.error[0] < 0.2 * expected, "error %g of %g", got.error[0],
                          expected);
                cr_assert(fabs(got.mean[0] - expected) < 3.0 * got.error[0],
                          "model %zu, point %d: %g, not %g ± %g", b, i, got.mean[0], expected, got.error[0]);
            }
            // Above the plate it is its dark side that is seen: the sun shines on the other.
            const TruthPathSettings above = {.samples = 256,
                                             .bounces = 1,
                                             .bounce = TRUTH_BOUNCE_OF_FLUX_UNOCCLUDED,
                                             .indirect_alone = true};
            cr_assert(
                truth_irradiance(truth, scene, vec3_make(0.1f * (float)i, 5, 0), vec3_make(0, -1, 0), &above)
                        .mean[0] == 0.0,
                "the plate shines through");
        }
        scene_end(scene, truth);
    }
}

// The clamp: E = ρE_sun/π · ∫ cos² / max(d, D)² dA over the plate, h below its middle, by the midpoint rule.
Test(truth_bounce, least_distance_holds_the_inverse_square)
{
    Scene *scene = plate_in_sun(0);
    Truth *truth = scene_ready(scene);
    const double least[] = {0.0, 0.5, 0.8, 3.0}, below = 0.4;
    for (size_t i = 0; i < 4; i++) {
        double sum = 0.0;
        enum { STEPS = 400 };
        for (int p = 0; p < STEPS * STEPS; p++) {
            double x = 2.0 * (p % STEPS + 0.5) / STEPS - 1.0,
                   z = 1.5 * ((double)(p / STEPS) + 0.5) / STEPS - 0.75, dd = below * below + x * x + z * z;
            sum += below * below / dd / fmax(dd, least[i] * least[i]);
        }
        const double expected = 2.0 / M_PI * sum * 3.0 / (STEPS * STEPS);
        const TruthPathSettings settings = {.samples = 200000,
                                            .bounces = 1,
                                            .indirect_alone = true,
                                            .bounce = TRUTH_BOUNCE_OF_FLUX_UNOCCLUDED,
                                            .least_distance = (float)least[i]};
        TruthIrradiance got =
            truth_irradiance(truth, scene, vec3_make(0, 2.0f - 0.4f, 0), vec3_make(0, 1, 0), &settings);
        cr_assert(got.error[0] < 0.01 * expected && fabs(got.mean[0] - expected) < 3.0 * got.error[0],
                  "held at %g m: %g, not %g ± %g", least[i], got.mean[0], expected, got.error[0]);
    }
    scene_end(scene, truth);
}

// --- what must not change the picture

Test(truth_bounce, same_bits_on_any_number_of_threads)
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
Test(truth_bounce, linear_in_intensity_and_additive_over_lights)
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

Test(truth_bounce, same_bits_at_every_scale_and_place)
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

Test(truth_bounce, dark_where_there_is_no_light)
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

Test(truth_bounce, many_segments_are_occluded_as_one)
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

Test(truth_bounce, settings_without_sense_are_refused)
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
