// raster: direct light through depth maps against closed forms. The room and its ground truth are in raster_room.h.
#include "raster_room.h"

// The lit picture, RGBA; the caller frees it.
static float *stage_light(const Stage *stage, const Light *light, int resolution, float ambient)
{
    DepthMap map = raster_depth_map(stage->scene, light, resolution, NULL, 1);
    raster_depth_map_draw(stage->raster, &map, light, &stage->mesh);
    raster_gbuffer_draw(stage->raster, &stage->gbuffer, &stage->scene->camera, &stage->mesh);
    raster_light_begin(stage->raster, &stage->gbuffer, stage->picture, ambient);
    raster_light_add(stage->raster, &stage->gbuffer, &stage->scene->camera, light, &map, stage->picture);
    raster_depth_map_delete(&map);
    return texels(stage->picture, GL_RGBA, 4, SIZE * SIZE);
}

// Irradiance (of the first channel) over cos θ at a point, with no regard to shadows, and the unit direction to the light; 0 outside a cone.
static double light_at(const Light *light, const double point[3], double to_light[3], double *distance)
{
    double square = 0, along = 0;
    for (int i = 0; i < 3; i++) {
        to_light[i] = light->kind == LIGHT_DIRECTIONAL ? -light->direction[i] : light->position[i] - point[i];
        square += to_light[i] * to_light[i];
    }
    *distance = sqrt(square);
    for (int i = 0; i < 3; i++) {
        to_light[i] /= *distance;
        along -= to_light[i] * light->direction[i];
    }
    if (light->kind == LIGHT_DIRECTIONAL)
        return *distance = INFINITY, light->intensity[0];
    if (light->kind == LIGHT_SPOT && acos(along) > light->half_angle_rad)
        return 0;
    return light->intensity[0] / pow(fmax(*distance, light->radius), 2);
}

// Every pixel against albedo/π·E·cos θ·visibility, but for those whose answer changes within a texel and a half of the map.
static void check_light(LightKind kind, float half_angle_rad, float radius, bool walls)
{
    Stage stage = stage_open(make, walls ? WALLS : 0);
    Light light = light_of(kind, 0);
    light.half_angle_rad = half_angle_rad;
    light.radius = radius;
    const int resolution = 512;
    float *picture = stage_light(&stage, &light, resolution, 0);
    const Camera *camera = &stage.scene->camera;
    DepthMap map = raster_depth_map(stage.scene, &light, resolution, NULL, 1);
    int lit = 0, dark = 0, left_out = 0;
    for (int i = 0; i < SIZE * SIZE; i++) {
        vec3 ray = pixel_ray(camera, i % SIZE, i / SIZE);
        double n[3], eye[3] = {camera->eye[0], camera->eye[1], camera->eye[2]},
                     d[3] = {ray[0], ray[1], ray[2]};
        double t = trace(walls, eye, d, n), p[3], to_light[3], distance;
        if (isinf(t)) {
            cr_assert(picture[4 * i] == 0 && picture[4 * i + 3] == 1, "pixel %d: the sky is black, alpha 1",
                      i);
            continue;
        }
        for (int c = 0; c < 3; c++)
            p[c] = eye[c] + t * d[c] + 1e-6 * n[c];
        double irradiance = light_at(&light, p, to_light, &distance);
        double cosine = n[0] * to_light[0] + n[1] * to_light[1] + n[2] * to_light[2];
        // The answer at the point and around it, at 1.5 texels and the bias that the slope asks for.
        double texel = map.texel_size * (isinf(distance) ? 1 : distance);
        double reach = 1.5 * texel * (1 + 1 / fmax(cosine, 0.05));
        int visible = 0, asked = 0;
        for (int k = 0; k < 27; k++) {
            double from[3], to[3], away[3], unused[3], gap, length = 0, same = 0;
            for (int c = 0, digit = k; c < 3; c++, digit /= 3)
                from[c] = p[c] + reach * (n[c] != 0 ? 0 : digit % 3 - 1);
            double e = light_at(&light, from, to, &gap);
            for (int c = 0; c < 3; c++)
                away[c] = to[c], length += to[c] * to[c], same += to[c] * n[c];
            bool in_room = !walls || (from[0] > -4 && from[0] < 4 && from[1] > 0 && from[1] < 6 &&
                                      from[2] > -5 && from[2] < 5);
            asked++;
            visible += in_room && same > 0 && e > 0 && trace(false, from, away, unused) >= gap;
        }
        if (cosine > 0 && visible != 0 && visible != asked) {
            left_out++;
            continue;
        }
        // block and walls by the blue share: 0.75 of a quarter and 0.5 of a quarter of the red
        bool block = p[1] > 0.9 && p[1] < 2.1 && fabs(p[0]) < 1.1 && p[2] > -0.6 && p[2] < 1.1;
        double expected = cosine > 0 && visible ? (block ? 0.25 : 0.5) / M_PI * irradiance * cosine : 0;
        double got = picture[4 * i] - 0.0;
        cr_assert(fabs(got - expected) <= 1e-4 * expected, "pixel %d, %d: %g, expected %g (cos %g)", i % SIZE,
                  i / SIZE, got, expected,
                  cosine); // position rounded at 2e-5 of the distance, squared, and the map's edge
        lit += expected > 0;
        dark += !(expected > 0);
    }
    cr_assert(lit > SIZE * SIZE / 50 && dark > SIZE * SIZE / 50, "%d lit, %d dark", lit, dark);
    cr_assert(left_out < SIZE * SIZE / 5, "%d pixels are too near a shadow's border", left_out);
    free(picture);
    raster_depth_map_delete(&map);
    stage_close(&stage);
}
Test(raster_light, point_light_and_its_shadow)
{
    check_light(LIGHT_POINT, 0, 1e-3f, true);
}
Test(raster_light, spot_light_its_cone_and_shadow)
{
    check_light(LIGHT_SPOT, 0.6f, 1e-3f, true);
}
Test(raster_light, wide_spot_takes_a_cube)
{
    check_light(LIGHT_SPOT, 1.5f, 1e-3f, true);
}
Test(raster_light, sun_and_its_shadow)
{
    check_light(LIGHT_DIRECTIONAL, 0, 1e-3f, false);
}
Test(raster_light, inverse_square_is_held_inside_the_radius)
{
    check_light(LIGHT_POINT, 0, 4.5f, true); // part of the room is nearer, part farther
}

Test(raster_light, below_the_light_is_intensity_albedo_over_pi_distance_squared)
{
    Stage stage = stage_open(make, WALLS);
    Light light = light_of(LIGHT_POINT, 0);
    light.position = vec3_make(2.5f, 3, -2); // the floor at (2.5, 0, -2) faces it
    stage.scene->camera.eye = vec3_make(2.5f, 2.5f, -2);
    stage.scene->camera.target = vec3_make(2.5f, 0, -2);
    stage.scene->camera.vertical_fov_rad =
        0.02f; // all pixels are within 25 mm: cos⁴ falls by 4·(0.025/3)²/2 = 1.4e-4
    float *picture = stage_light(&stage, &light, MAP, 0);
    const double expected = 40 * 0.5 / (M_PI * 3 * 3);
    for (int i = 0; i < SIZE * SIZE; i++)
        cr_assert(fabs(picture[4 * i] / expected - 1) < 4e-4, "pixel %d: %g, expected %g", i,
                  (double)picture[4 * i], expected);
    free(picture);
    stage_close(&stage);
}

// In a map of 16² texels the block still shadows the floor 2 m below its top: the bias stays below a texel (0.7 m).
Test(raster_light, bias_does_not_lift_a_shadow_three_texels_below)
{
    Stage stage = stage_open(make, 0);
    Light light = light_of(LIGHT_DIRECTIONAL, 0);
    light.direction = vec3_make(0, -1, 0);
    stage.scene->camera.eye = vec3_make(0, 0.9f, 0.25f);
    stage.scene->camera.target =
        vec3_make(0, 0, 0.25f); // sees 0.3 m to each side of the middle of the block's underside
    stage.scene->camera.vertical_fov_rad = 0.6f;
    float *picture = stage_light(&stage, &light, 16, 0);
    for (int i = 0; i < SIZE * SIZE; i++)
        cr_assert(picture[4 * i] == 0, "pixel %d is lit", i);
    free(picture);
    stage_close(&stage);
}

Test(raster_light, emission_and_ambient_are_there_before_any_light)
{
    Stage stage = stage_open(make, WALLS);
    Light dark = light_of(LIGHT_POINT, 0);
    dark.intensity = vec3_make(0, 0, 0);
    float *picture = stage_light(&stage, &dark, MAP, 0.5f);
    int block = 0;
    for (int i = 0; i < SIZE * SIZE; i++) { // exact: all are short binary fractions
        const float *p = picture + 4 * i;
        bool is_block = p[0] == 0.125f && p[1] == 0.375f && p[2] == 0.375f;
        cr_assert((is_block || (p[0] == 0.25f && p[1] == 0.25f && p[2] == 0.25f)) && p[3] == 1, "pixel %d",
                  i);
        block += is_block;
    }
    cr_assert(block > SIZE, "the emitting block is in view");
    free(picture);
    stage_close(&stage);
}

// The same picture far from the origin, a million times smaller and larger.
static void check_same(LightKind kind, uint64_t seed)
{
    uint64_t walls = kind == LIGHT_DIRECTIONAL ? 0 : WALLS;
    Stage here = stage_open(make, walls), there = stage_open(make, walls | seed);
    Light light_here = light_of(kind, 0), light_there = light_of(kind, seed);
    float *expected = stage_light(&here, &light_here, 512, 0.25f),
          *got = stage_light(&there, &light_there, 512, 0.25f);
    int different = 0;
    for (int i = 0; i < 4 * SIZE * SIZE; i++) {
        cr_assert(isfinite(got[i]), "value %d is %g", i, (double)got[i]);
        different += !(fabsf(got[i] - expected[i]) <= 1e-4f * expected[i]);
    }
    // A shadow's border may fall on the other side of a pixel where rounding differs: less than one pixel in 500.
    cr_assert(different <= 4 * SIZE * SIZE / 500, "%d of %d values differ", different, 4 * SIZE * SIZE);
    free(expected), free(got);
    stage_close(&here), stage_close(&there);
}
#define SAME(kind, KIND)                                                                                     \
    Test(raster_light, kind##_picture_is_the_same_far_away_tiny_and_giant)                                   \
    {                                                                                                        \
        check_same(KIND, FAR_AWAY);                                                                          \
        check_same(KIND, TINY);                                                                              \
        check_same(KIND, GIANT);                                                                             \
    }
SAME(point, LIGHT_POINT)
SAME(spot, LIGHT_SPOT)
SAME(sun, LIGHT_DIRECTIONAL)

Test(raster_light, empty_scene_is_black)
{
    Stage stage = stage_open(make_nothing, 0);
    for (int kind = 0; kind < 3; kind++) {
        Light light = light_of((LightKind)kind, 0);
        float *picture = stage_light(&stage, &light, MAP, 1);
        for (int i = 0; i < SIZE * SIZE; i++)
            cr_assert(picture[4 * i] == 0 && picture[4 * i + 3] == 1, "light %d, pixel %d", kind, i);
        free(picture);
    }
    stage_close(&stage);
}

Test(raster_light, lights_in_at_and_on_surfaces_give_finite_pictures)
{
    Stage stage = stage_open(make, WALLS);
    const vec3 places[] = {vec3_make(0, 1.5f, 0), vec3_make(1, 2, 1),     vec3_make(0, 0, 0),
                           vec3_make(-4, 6, -5),  vec3_make(0, 2, 0.25f), stage.scene->camera.eye};
    for (size_t place_number = 0; place_number < sizeof places / sizeof *places; place_number++)
        for (int kind = 0; kind < 2; kind++) {
            Light light = light_of((LightKind)kind, 0);
            light.position = places[place_number];
            light.radius = 0; // nothing holds the inverse square
            float *picture = stage_light(&stage, &light, MAP, 0);
            for (int i = 0; i < 4 * SIZE * SIZE; i++)
                cr_assert(isfinite(picture[i]) && picture[i] >= 0, "place %zu, value %d: %g", place_number, i,
                          (double)picture[i]);
            free(picture);
        }
    stage_close(&stage);
}
