// Chapter 02: light gathered from every texel of a reflective shadow map against closed forms, the truth and at the extremes.
#include "rsm_bounce.h"
#include "truth.h"

#include <string.h>

// ---------------------------------------------------------------- closed forms

// A floor y = 0, a ceiling y = 3 and a wall x = 3, 8 m long, open elsewhere; the spot shines down from (0, 2, 0).
static void make_plates(Scene *scene, uint64_t seed)
{
    (void)seed;
    uint32_t grey = scene_add_material(scene, "grey", vec3_make(0.5f, 0.5f, 0.5f), vec3_make(0, 0, 0));
    const vec3 x = vec3_make(8, 0, 0), z = vec3_make(0, 0, 8), y = vec3_make(0, 3, 0);
    mesh_add_quad(&scene->mesh, vec3_make(-4, 0, -4), z, x, grey);
    mesh_add_quad(&scene->mesh, vec3_make(-4, 3, -4), x, z, grey);
    mesh_add_quad(&scene->mesh, vec3_make(3, 0, -4), z, y, grey);
    scene->camera = (Camera){.eye = vec3_make(-2, 1, 3.5f),
                             .target = vec3_make(2.5f, 2.2f, 0),
                             .up = vec3_make(0, 1, 0),
                             .vertical_fov_rad = 1.0f};
}
static Light light_on_plates(float half_angle)
{
    return (Light){.kind = LIGHT_SPOT,
                   .position = vec3_make(0, 2, 0),
                   .direction = vec3_make(0, -1, 0),
                   .intensity = vec3_make(40, 20, 10),
                   .half_angle_rad = half_angle,
                   .radius = 1e-3f};
}
// ∫ B(y)/π cos cos / r² over the lit disc in polar coordinates, midpoints; B = albedo · I · H / (H² + s²)^1.5.
static double irradiance_from_disc(double half_angle, const double point[3], const double normal[3])
{
    enum { RINGS = 100, SECTORS = 100 };
    const double height = 2, edge = height * tan(half_angle);
    double sum = 0;
    for (int i = 0; i < RINGS; i++)
        for (int k = 0; k < SECTORS; k++) {
            double s = edge * (i + 0.5) / RINGS, phi = 2 * M_PI * (k + 0.5) / SECTORS;
            double way[3] = {s * cos(phi) - point[0], -point[1], s * sin(phi) - point[2]};
            double square = way[0] * way[0] + way[1] * way[1] + way[2] * way[2];
            double leaves = -way[1], arrives = way[0] * normal[0] + way[1] * normal[1] + way[2] * normal[2];
            double radiosity = 0.5 * 40 * height / pow(height * height + s * s, 1.5);
            sum += radiosity / M_PI * fmax(leaves, 0) * fmax(arrives, 0) / (square * square) * s *
                   (edge / RINGS) * (2 * M_PI / SECTORS);
        }
    return sum;
}
// As raster_room.h's pixel_ray for a picture FEW pixels wide.
static vec3 ray_of(const Camera *camera, int x, int y)
{
    vec3 right = vec3_normalize(vec3_cross(camera->target - camera->eye, camera->up));
    vec3 forward = vec3_normalize(camera->target - camera->eye), up = vec3_cross(right, forward);
    float half = tanf(0.5f * camera->vertical_fov_rad);
    float u = 2 * ((float)x + 0.5f) / FEW - 1, v = 2 * ((float)y + 0.5f) / FEW - 1;
    return vec3_normalize(forward + half * (u * right + v * up));
}
static void check_plates(float half_angle)
{
    Bounce b = bounce_open(make_plates, 0, FEW);
    Light light = light_on_plates(half_angle);
    const Camera *camera = &b.stage.scene->camera;
    Image got = bounce_light(&b, &light, 256, 0, NULL);
    int parallel = 0, perpendicular = 0;
    for (int i = 0; i < FEW * FEW;
         i += 3) { // of every third pixel: the closed form takes longer than the gather
        vec3 ray = ray_of(camera, i % FEW, i / FEW);
        double to_ceiling = (3 - camera->eye[1]) / ray[1], to_wall = (3 - camera->eye[0]) / ray[0];
        bool ceiling = to_ceiling > 0 && to_ceiling < to_wall;
        double t = ceiling ? to_ceiling : to_wall, point[3];
        for (int c = 0; c < 3; c++)
            point[c] = camera->eye[c] + t * ray[c];
        if (!(t > 0) || point[1] < 0.01 || fabs(point[2]) > 3.99 || fabs(point[0]) > 3.99 ||
            fabs(to_ceiling - to_wall) < 0.01)
            continue; // the floor, the sky, edges
        double expected =
            0.5 / M_PI *
            irradiance_from_disc(half_angle, point, ceiling ? (double[]){0, -1, 0} : (double[]){-1, 0, 0});
        // Border texels count whole or not at all: 5e-4 of the disc by the reckoning of test_raster_reflective.c, 2e-4 here for the eye's position,
        // 1e-4 for midpoints; a wall sees the near side of the border more than the far one.
        cr_assert(fabs(got.pixels[4 * i] - expected) < 2e-3 * expected, "pixel %d, %d: %g, expected %g",
                  i % FEW, i / FEW, got.pixels[4 * i], expected);
        cr_assert(fabsf(got.pixels[4 * i + 1] - 0.5f * got.pixels[4 * i]) <= 1e-6f * got.pixels[4 * i],
                  "pixel %d: green is half of red", i);
        parallel += ceiling, perpendicular += !ceiling;
    }
    cr_assert(parallel > 33 && perpendicular > 33, "%d, %d pixels", parallel, perpendicular);
    image_free(&got);
    bounce_close(&b);
}
Test(rsm, small_patch_on_parallel_and_perpendicular_plates)
{
    check_plates(0.05f);
}
Test(rsm, wide_patch_on_parallel_and_perpendicular_plates)
{
    check_plates(0.8f);
}

// Looking out from the lit patch in all directions, each pixel counted by the wall's area behind it: what the patch sends is what arrives.
static void make_room(Scene *scene, uint64_t seed)
{
    uint32_t grey = scene_add_material(scene, "grey", vec3_make(0.5f, 0.5f, 0.5f), vec3_make(0, 0, 0));
    mesh_add_box(&scene->mesh, place(seed, -4, 0, -5), place(seed, 4, 6, 5), grey);
    scene->camera = (Camera){.eye = place(seed, 0, 0.01f, 0),
                             .target = place(seed, 0, 6, 0),
                             .up = vec3_make(0, 0, 1),
                             .vertical_fov_rad = (float)M_PI / 2};
}
Test(rsm, all_of_the_patch_s_light_arrives)
{
    Bounce b = bounce_open(make_room, 0, SIZE);
    Light light = light_on_plates(0.05f);
    const vec3 targets[] = {vec3_make(0, 6, 0), vec3_make(9, 0.01f, 0), vec3_make(-9, 0.01f, 0),
                            vec3_make(0, 0.01f, 9), vec3_make(0, 0.01f, -9)};
    double sum = 0;
    for (int k = 0; k < 5; k++) {
        b.stage.scene->camera.target = targets[k];
        b.stage.scene->camera.up = k == 0 ? vec3_make(0, 0, 1) : vec3_make(0, 1, 0);
        Image got = bounce_light(&b, &light, 32, 0, NULL);
        for (int i = 0; i < SIZE * SIZE; i++) {
            vec3 ray = pixel_ray(&b.stage.scene->camera, i % SIZE, i / SIZE);
            double along = 0, from[3] = {0, 0.01, 0}, d[3] = {ray[0], ray[1], ray[2]};
            for (int c = 0; c < 3; c++) // the longest component of a 90° view's ray is along its axis
                along = fmax(along, fabs(d[c]));
            double t = INFINITY, cosine = 0; // to the nearest wall
            for (int c = 0; c < 3; c++) {
                double to_wall = ((d[c] > 0 ? ROOM.upper : ROOM.lower)[c] - from[c]) / d[c];
                if (to_wall < t)
                    t = to_wall, cosine = fabs(d[c]);
            }
            double angle = pow(2.0 / SIZE * along, 2) * along;
            sum += M_PI / 0.5 * got.pixels[4 * i] * angle * t * t / cosine;
        }
        image_free(&got);
    }
    double expected = 2 * M_PI * (1 - cos(0.05)) * 40 * 0.5;
    // The eye is 1 cm above the patch, 10 cm wide; the patch at 32² texels is off by 1 %.
    cr_assert(fabs(sum / expected - 1) < 0.02, "%g W arrive of %g", sum, expected);
    bounce_close(&b);
}

// ---------------------------------------------------------------- invariants

Test(rsm, bounce_is_linear_in_the_light)
{
    for (int kind = 0; kind < 3; kind++) {
        Bounce b = bounce_open(make, kind == LIGHT_DIRECTIONAL ? 0 : WALLS, FEW);
        Light light = light_of((LightKind)kind, 0);
        Image one = bounce_light(&b, &light, 32, 0.1f, NULL);
        light.intensity *= 8.0f;
        Image eight = bounce_light(&b, &light, 32, 0.1f, NULL);
        cr_assert(mean_of(&one) > 1e-3, "there is light");
        for (int i = 0; i < 4 * FEW * FEW; i++) // a power of two: exact
            cr_assert(eight.pixels[i] == 8 * one.pixels[i], "light %d, value %d: %g, %g", kind, i,
                      eight.pixels[i], one.pixels[i]);
        image_free(&one), image_free(&eight);
        bounce_close(&b);
    }
}

// The sum does not depend on how it is divided into draws: 256 rows are two; a cube's faces are drawn one by one.
Test(rsm, finer_maps_change_little)
{
    for (int kind = 0; kind < 3; kind++) {
        Bounce b = bounce_open(make, kind == LIGHT_DIRECTIONAL ? 0 : WALLS, 8);
        Light light = light_of((LightKind)kind, 0);
        Image coarse = bounce_light(&b, &light, 128, 0.5f, NULL);
        for (int side = 256; side <= 256; side *= 2) {
            Image fine = bounce_light(&b, &light, side, 0.5f, NULL);
            ImageError error = image_compare(&fine, &coarse);
            // Borders of light fall on other texels: 1/128 of the floor's length at most, both ways
            cr_assert(error.nrmse < 0.015 && fabs(error.mean_ratio - 1) < 0.01,
                      "light %d, %d: nrmse %g, ratio %g", kind, side, error.nrmse, error.mean_ratio);
            image_free(&fine);
        }
        image_free(&coarse);
        bounce_close(&b);
    }
}

Test(rsm, clamp_holds_the_inverse_square)
{
    Bounce b = bounce_open(make, WALLS, FEW);
    Light light = light_of(LIGHT_POINT, 0);
    Image none = bounce_light(&b, &light, 32, 0, NULL),
          short_of_all = bounce_light(&b, &light, 32, 1e-3f, NULL),
          all = bounce_light(&b, &light, 32, 20, NULL), double_all = bounce_light(&b, &light, 32, 40, NULL);
    for (int i = 0; i < FEW * FEW;
         i++) { // the room's diagonal is 14 m: 20 m hold every texel, 40 a quarter of that
        cr_assert(fabsf(all.pixels[4 * i] - 4 * double_all.pixels[4 * i]) <= 1e-5f * all.pixels[4 * i],
                  "pixel %d: %g, %g", i, all.pixels[4 * i], double_all.pixels[4 * i]);
        cr_assert(all.pixels[4 * i] < none.pixels[4 * i], "pixel %d is held", i);
        cr_assert(short_of_all.pixels[4 * i] <= none.pixels[4 * i], "pixel %d", i);
    }
    image_free(&none), image_free(&short_of_all), image_free(&all), image_free(&double_all);
    bounce_close(&b);
}

// Up to a wall's foot the floor fills half of its view with a radiosity B, so the irradiance is B/2 there and at most a few % more above, where
// the light is nearer. Texels are 6 cm wide, pixels at heights of 1 to 11 cm.
Test(rsm, discs_do_not_outshine_their_floor)
{
    Bounce b = bounce_open(make_plates, 0, FEW);
    Light light = light_on_plates(1.0f);
    light.position = vec3_make(2, 2, 0);
    Camera *camera = &b.stage.scene->camera;
    camera->eye = vec3_make(2.8f, 0.06f, 0);
    camera->target = vec3_make(3, 0.06f, 0);
    camera->vertical_fov_rad = 0.5f;
    const double expected = 0.5 / M_PI * 0.5 * (0.5 * 40 * 2 / pow(2 * 2 + 1 * 1, 1.5));
    Image points = bounce_light(&b, &light, 100, 0, NULL), discs = bounce_light(&b, &light, 100, -1, NULL);
    double most[2] = {0};
    for (int i = 0; i < FEW * FEW; i++) {
        most[0] = fmax(most[0], points.pixels[4 * i] / expected);
        most[1] = fmax(most[1], discs.pixels[4 * i] / expected);
        if (i / FEW >= FEW / 2) // more than a texel above the floor
            cr_assert(fabs(discs.pixels[4 * i] / expected - 1) < 0.05, "pixel %d: %g of B/2", i,
                      discs.pixels[4 * i] / expected);
    }
    cr_assert(most[0] > 1.1 && most[1] < 1.05, "points up to %g, discs up to %g of B/2", most[0], most[1]);
    image_free(&points), image_free(&discs);
    bounce_close(&b);
}

// ---------------------------------------------------------------- the truth

// The same model by rays from the light (Embree), and what it leaves out: shadows of the bounced light.
Test(rsm, cornell_has_the_truth_s_mean)
{
    const SceneKind *cornell = scene_kinds;
    while (strcmp(cornell->name, "cornell") != 0)
        cornell++;
    Bounce b = bounce_open(cornell->make, 0, FEW);
    const Scene *scene = b.stage.scene;
    Truth *truth = truth_open(&scene->mesh);
    const float clamp = 0.3f;
    for (int kind = 0; kind < 3; kind++) {
        Light light = scene->lights[0];
        light.kind = (LightKind)kind;
        light.half_angle_rad = 0.9f;
        light.direction =
            kind == LIGHT_SPOT ? vec3_make(0, -1, 0) : vec3_normalize(vec3_make(0.5f, -0.3f, -1));
        Scene lit = *scene;
        lit.lights = &light, lit.light_count = 1;
        Image got = bounce_light(&b, &light, 64, clamp, NULL);
        for (int shadows = 0; shadows < 2; shadows++) {
            TruthPathSettings settings = {.samples = 256,
                                          .bounces = 1,
                                          .indirect_alone = true,
                                          .bounce = shadows ? TRUTH_BOUNCE_OF_FLUX
                                                            : TRUTH_BOUNCE_OF_FLUX_UNOCCLUDED,
                                          .least_distance = clamp,
                                          .seed = 7};
            TruthPicture picture = truth_radiance(truth, &lit, &scene->camera, FEW, FEW, &settings);
            double mean = 0, square = 0;
            for (int i = 0; i < FEW * FEW; i++) {
                mean += picture.mean.pixels[picture.mean.channels * i] / FEW / FEW;
                square += pow(picture.error.pixels[picture.error.channels * i] / FEW / FEW, 2);
            }
            double ratio = mean_of(&got) / mean, noise = sqrt(square) / mean;
            if (shadows)
                cr_assert(ratio > 1.03, "light %d: %g times the light with shadows", kind, ratio);
            else // texels of 1/64: light's borders fall on other ones, a share of them
                cr_assert(fabs(ratio - 1) < 4 * noise + 0.01, "light %d: %g times the truth, noise %g", kind,
                          ratio, noise);
            truth_picture_free(&picture);
        }
        image_free(&got);
    }
    truth_close(truth);
    bounce_close(&b);
}

// ---------------------------------------------------------------- extremes

Test(rsm, empty_scene_stays_black)
{
    RsmPattern pattern = {.samples = 8, .radius = 1};
    for (int kind = 0; kind < 3; kind++)
        for (int way = 0; way < 2; way++) {
            Bounce b = bounce_open(make_nothing, 0, FEW);
            Light light = light_of((LightKind)kind, 0);
            Image got = bounce_light(&b, &light, 8, 0, way ? &pattern : NULL);
            cr_assert(mean_of(&got) == 0, "light %d", kind);
            image_free(&got);
            bounce_close(&b);
        }
}
