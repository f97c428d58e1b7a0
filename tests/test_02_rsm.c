// Chapter 02: light gathered from a reflective shadow map against closed forms, against itself and at the extremes. The room is raster_room.h's.
#include "../chapters/02_shadow_maps/rsm.h"
#include "image.h"
#include "raster_room.h"

#include <string.h>

enum { FEW = 32 }; // pixels a side where no closed form needs more

typedef struct Bounce {
    Stage stage;
    Rsm rsm;
    GBuffer gbuffer;
    GLuint picture;
    int side;
} Bounce;
static Bounce bounce_open(void (*maker)(Scene *, uint64_t), uint64_t seed, int side)
{
    Bounce b = {.stage = stage_open(maker, seed), .side = side};
    b.rsm = rsm_open();
    b.gbuffer = raster_gbuffer(side, side);
    b.picture = gl_texture(.label = "bounce", .format = GL_RGBA32F, .width = side, .height = side);
    return b;
}
static void bounce_close(Bounce *b)
{
    rsm_close(&b->rsm);
    raster_gbuffer_delete(&b->gbuffer);
    gl_texture_delete(&b->picture);
    stage_close(&b->stage);
}
// The bounced light as a picture, bottom row first; by every texel where `pattern` is NULL.
static Image bounce_light(const Bounce *b, const Light *light, int resolution, float clamp,
                          const RsmPattern *pattern)
{
    const Camera *camera = &b->stage.scene->camera;
    ReflectiveMap map = raster_reflective_map(b->stage.scene, light, resolution);
    raster_reflective_map_draw(b->stage.raster, &map, light, &b->stage.mesh);
    raster_gbuffer_draw(b->stage.raster, &b->gbuffer, camera, &b->stage.mesh);
    static const float black[4] = {0};
    gl.ClearTexImage(b->picture, 0, GL_RGBA, GL_FLOAT, black);
    RsmGather gather = {&b->gbuffer, camera, &map, clamp, b->picture};
    double asked =
        pattern ? rsm_gather_importance(&b->rsm, &gather, pattern) : rsm_gather_all(&b->rsm, &gather);
    int layers = map.depth.kind == LIGHT_POINT ? 6 : 1;
    cr_assert(asked == (pattern ? pattern->samples : (double)layers * resolution * resolution), "%g texels",
              asked);
    Image image = image_make(b->side, b->side, 4);
    gl_texture_read(b->picture, 0, GL_RGBA, GL_FLOAT, 4 * sizeof(float) * (size_t)(b->side * b->side),
                    image.pixels);
    for (int i = 0; i < 4 * b->side * b->side; i++)
        cr_assert(isfinite(image.pixels[i]) && image.pixels[i] >= 0, "value %d is %g", i, image.pixels[i]);
    raster_reflective_map_delete(&map);
    return image;
}
static double mean_of(const Image *image)
{
    double sum = 0;
    for (int i = 0; i < image->width * image->height; i++)
        sum += image->pixels[4 * i];
    return sum / image->width / image->height;
}

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
    for (int i = 0; i < FEW * FEW; i++) {
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
    cr_assert(parallel > 100 && perpendicular > 100, "%d, %d pixels", parallel, perpendicular);
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

// The sum does not depend on how it is divided into draws: 256 rows are two, 512 are eight; a cube's faces are drawn one by one.
Test(rsm, finer_maps_change_little)
{
    for (int kind = 0; kind < 3; kind++) {
        Bounce b = bounce_open(make, kind == LIGHT_DIRECTIONAL ? 0 : WALLS, 8);
        Light light = light_of((LightKind)kind, 0);
        Image coarse = bounce_light(&b, &light, 128, 0.5f, NULL);
        for (int side = 256; side <= (kind == LIGHT_POINT ? 256 : 512); side *= 2) {
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

// The same picture where all lengths are s times as long and the intensity s² times, and far away.
Test(rsm, bounce_is_the_same_far_away_tiny_and_giant)
{
    const uint64_t seeds[] = {FAR_AWAY, TINY, GIANT};
    RsmPattern pattern = {.samples = 64, .radius = 1, .rotated = true};
    for (int kind = 0; kind < 3; kind++)
        for (int k = 0; k < 3; k++)
            for (int way = 0; way < 2; way++) {
                uint64_t walls = kind == LIGHT_DIRECTIONAL ? 0 : WALLS;
                Bounce here = bounce_open(make, walls, FEW), there = bounce_open(make, walls | seeds[k], FEW);
                Light near = light_of((LightKind)kind, 0), far = light_of((LightKind)kind, seeds[k]);
                Image expected = bounce_light(&here, &near, 32, 0.25f, way ? &pattern : NULL);
                Image got = bounce_light(&there, &far, 32, 0.25f * scale_of(seeds[k]), way ? &pattern : NULL);
                ImageError error = image_compare(&got, &expected);
                // The sun's frame is rounded at 1e-7 of 10⁶ m, so its texels lie elsewhere by 0.2 of one; else a few texels on edges.
                double tolerance = kind == LIGHT_DIRECTIONAL && seeds[k] == FAR_AWAY ? 0.1
                                   : way                                             ? 0.02
                                                                                     : 2e-3;
                cr_assert(error.nrmse < tolerance, "light %d, seed %d, way %d: nrmse %g", kind, (int)seeds[k],
                          way, error.nrmse);
                image_free(&expected), image_free(&got);
                bounce_close(&here), bounce_close(&there);
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

// ---------------------------------------------------------------- importance

// Towards the sum over every texel as samples grow. A shift for each pixel makes each sample uniform, so the order is 1/2 or better.
Test(rsm, importance_converges_to_all)
{
    for (int k = 0; k < 4; k++) {
        LightKind kind = (LightKind)(k % 3);
        Bounce b = bounce_open(make, kind == LIGHT_DIRECTIONAL ? 0 : WALLS, FEW);
        Light light = light_of(kind, 0);
        if (k == 3) // a spot that looks up: most pixels lie behind it
            light.direction = vec3_normalize(vec3_make(0.5f, 0.25f, -0.5f)),
            light.position = vec3_make(-1, 3, 2);
        if (k == 3)
            light.kind = LIGHT_SPOT;
        Image all = bounce_light(&b, &light, 64, 0.5f, NULL);
        double first = 0;
        for (int samples = 64; samples <= 4096; samples *= 64) {
            RsmPattern pattern = {.samples = samples, .radius = 1, .rotated = true, .seed = 5};
            Image some = bounce_light(&b, &light, 64, 0.5f, &pattern);
            ImageError error = image_compare(&some, &all);
            if (samples == 64)
                first = error.nrmse;
            else {
                cr_assert(error.nrmse < first / 6, "light %d: nrmse %g from %g", k, error.nrmse, first);
                // 1024 pixels' means of independent signs, of which few hold most of the light: a tenth of a pixel's
                cr_assert(fabs(error.mean_ratio - 1) < 0.1 * error.nrmse + 1e-3, "light %d: mean ratio %g", k,
                          error.mean_ratio);
            }
            image_free(&some);
        }
        image_free(&all);
        bounce_close(&b);
    }
}

// Dachsbacher and Stamminger's weight ξ1² for samples at radius·ξ1 converges, but to another picture.
Test(rsm, the_printed_weight_is_biased)
{
    Bounce b = bounce_open(make, WALLS, FEW);
    Light light = light_of(LIGHT_SPOT, 0);
    Image all = bounce_light(&b, &light, 64, 0.5f, NULL);
    double error[2];
    for (int k = 0; k < 2; k++) {
        RsmPattern pattern = {.samples = 8192, .radius = 1, .rotated = true, .weight = (RsmWeight)k};
        Image some = bounce_light(&b, &light, 64, 0.5f, &pattern);
        error[k] = image_compare(&some, &all).nrmse;
        image_free(&some);
    }
    cr_assert(error[0] < 0.02 && error[1] > 0.2, "nrmse %g, as printed %g", error[0], error[1]);
    image_free(&all);
    bounce_close(&b);
}

Test(rsm, more_samples_than_one_draw_can_count)
{
    Bounce b = bounce_open(make, WALLS, 8);
    Light light = light_of(LIGHT_SPOT, 0);
    Image all = bounce_light(&b, &light, 64, 0.5f, NULL);
    RsmPattern pattern = {.samples = 100000, .radius = 1, .rotated = true};
    Image some = bounce_light(&b, &light, 64, 0.5f, &pattern);
    ImageError error = image_compare(&some, &all);
    cr_assert(error.nrmse < 5e-3, "nrmse %g", error.nrmse); // a third of the samples left out would be 0.3
    image_free(&all), image_free(&some);
    bounce_close(&b);
}

// A disc of the map round the pixel's place loses what lies outside it, and nothing is counted twice.
Test(rsm, smaller_radius_loses_light)
{
    for (int kind = 0; kind < 3; kind++) {
        Bounce b = bounce_open(make, kind == LIGHT_DIRECTIONAL ? 0 : WALLS, FEW);
        Light light = light_of((LightKind)kind, 0);
        double before = 0;
        for (int k = 0; k < 4; k++) {
            RsmPattern pattern = {.samples = 1024, .radius = 0.125f * (float)(1 << k), .rotated = true};
            Image some = bounce_light(&b, &light, 64, 0.5f, &pattern);
            cr_assert(mean_of(&some) > before * (k == 3 ? 0.98 : 1.02), "light %d, radius %g: %g after %g",
                      kind, (double)pattern.radius, mean_of(&some),
                      before); // a spot's texels are all within half of √2 sides for most pixels
            before = mean_of(&some);
            image_free(&some);
        }
        bounce_close(&b);
    }
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

// Finite everywhere, as bounce_light checks, with nothing held: texels on the very points that pixels see, lights at walls, one texel.
Test(rsm, lights_at_and_on_walls_give_finite_pictures)
{
    Bounce b = bounce_open(make, WALLS, FEW);
    const vec3 places[] = {vec3_make(0, 1.5f, 0), vec3_make(0, 0.001f, 0), vec3_make(-4, 6, -5),
                           b.stage.scene->camera.eye};
    RsmPattern pattern = {.samples = 16, .radius = 1};
    for (size_t p = 0; p < sizeof places / sizeof *places; p++)
        for (int kind = 0; kind < 2; kind++)
            for (int side = 1; side <= 32; side *= 32)
                for (int way = 0; way < 2; way++) {
                    Light light = light_of((LightKind)kind, 0);
                    light.position = places[p];
                    light.radius = 0;
                    Image got = bounce_light(&b, &light, side, 0, way ? &pattern : NULL);
                    image_free(&got);
                }
    bounce_close(&b);
}
