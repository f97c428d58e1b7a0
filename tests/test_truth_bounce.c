// The truth's indirect light: estimators against each other, and the reflective shadow map's model against closed forms.
#include "truth_scenes.h"

enum { SIZE = 12 };

static TruthPicture picture_of(const Truth *truth, const Scene *scene, TruthPathSettings settings)
{
    return truth_radiance(truth, scene, &scene->camera, SIZE, SIZE, &settings);
}

// --- estimators that share neither the way they look for light nor their random numbers

// One bounce by paths from the eye and by rays from the lights: of a point light, of a spot whose r0 reaches beyond a block, of the sun. At
// points of floor, ceiling, back and left wall that keep 0.4 m from the room's edges: nearer to an edge half of the light comes from the
// other wall from nearly no distance at all, and rays from the lights, which seldom fall there, say too little about their own error.
// Of 144 normal values 0.4 lie beyond 3 errors; 4 or more in one case of 1500, a little oftener since samples are skewed.
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
        cr_assert(within >= COUNT - 3, "light %d: only %d of %d points within 3 errors", (int)i, within,
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

// Seen from straight ahead the edges of a room as deep as it is wide are the picture's diagonals: every pixel there stands for a point that
// rounding puts on either side of the other wall. All of them are lit by all the room.
Test(truth_bounce, edges_of_a_room_are_not_dark)
{
    for (int i = 0; i < 12; i++) {
        Scene *scene = scene_begin();
        uint32_t wall = scene_add_material(scene, "wall", vec3_make(0.5f, 0.5f, 0.5f), vec3_make(1, 1, 1));
        const vec3 lower = vec3_make(-0.3f, 0.1f * (float)i, -0.7f) * (float)(i + 1),
                   side = (0.7f + 0.9f * (float)i) * vec3_make(1, 1, 1);
        mesh_add_box(&scene->mesh, lower, lower + side, wall);
        vec3 forward = BLACK;
        forward[i % 3] = side[0];
        scene->camera = (Camera){.eye = lower + 0.5f * side,
                                 .target = lower + 0.5f * side + forward,
                                 .up = i % 3 == 1 ? vec3_make(0, 0, 1) : vec3_make(0, 1, 0),
                                 .vertical_fov_rad = 2.0f};
        Truth *truth = scene_ready(scene);
        TruthPicture picture = truth_radiance(
            truth, scene, &scene->camera, 40, 40,
            &(TruthPathSettings){.samples = 8, .bounces = 3, .emitters = TRUTH_EMITTERS_BY_DIRECTION});
        for (size_t p = 0; p < 1600; p++) // Σ 0.5^i, i ≤ 4; to rounding
            cr_assert_float_eq((double)channel_of(&picture.mean, p, 0), 1.9375, 1e-5,
                               "room %d, pixel %zu: %g", i, p, (double)channel_of(&picture.mean, p, 0));
        truth_picture_free(&picture);
        scene_end(scene, truth);
    }
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
            const int row = p / STEPS;
            double x = 2.0 * (p % STEPS + 0.5) / STEPS - 1.0, z = 1.5 * (row + 0.5) / STEPS - 0.75,
                   dd = below * below + x * x + z * z;
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
