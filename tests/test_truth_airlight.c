// truth: the lit stretches of a ray against shadows drawn by hand and against Embree; the integral against closed forms.
#include "truth.h"

#include <criterion/criterion.h>
#include <stdlib.h>
#include <string.h>

static const TruthPhase uniform = {.name = "uniform"};

typedef struct Shade {
    Mesh mesh;
    Truth *truth;
    TruthShadows *shadows;
} Shade;
static Shade shade_open(Mesh mesh)
{
    Shade shade = {.mesh = mesh, .truth = truth_open(&mesh)};
    shade.shadows = truth_shadows_open(&mesh, shade.truth);
    return shade;
}
static void shade_close(Shade *shade)
{
    truth_shadows_close(shade->shadows);
    truth_close(shade->truth);
}

static Mesh block(void)
{
    Mesh mesh = {0};
    mesh_add_box(&mesh, vec3_make(-0.5f, 0.75f, -1), vec3_make(0.5f, 1.0f, 1), 0);
    return mesh;
}
static const double FROM[3] = {-5, 0, 0.1}, ALONG[3] = {1, 0, 0};

static void check_spans(const Shade *shade, const Light *light, double length, size_t expected,
                        const double (*spans)[2])
{
    size_t count;
    TruthSpan *got = truth_lit_spans(shade->shadows, light, FROM, ALONG, length, &count);
    cr_assert_eq(count, expected, "%zu spans", count);
    for (size_t i = 0; i < count; i++) {
        cr_assert(got[i].t0 == spans[i][0] || fabs(got[i].t0 - spans[i][0]) < 1e-6, "span %zu begins at %.9g",
                  i, got[i].t0);
        cr_assert(got[i].t1 == spans[i][1] || fabs(got[i].t1 - spans[i][1]) < 1e-6, "span %zu ends at %.9g",
                  i, got[i].t1);
    }
    free(got);
}

// A block under a light 2 m above the ray: its upper corners at 1 m throw the shadow to ±0.5 · 2/(2 - 1).
Test(truth_airlight, a_blocks_shadow_from_a_point)
{
    Shade shade = shade_open(block());
    const Light light = {.kind = LIGHT_POINT, .position = vec3_make(0, 2, 0.1f)};
    check_spans(&shade, &light, INFINITY, 2, (const double[][2]){{0, 4}, {6, INFINITY}});
    check_spans(&shade, &light, 5, 1, (const double[][2]){{0, 4}});
    shade_close(&shade);
}
Test(truth_airlight, a_blocks_shadow_from_the_sun)
{
    Shade shade = shade_open(block());
    const Light light = {.kind = LIGHT_DIRECTIONAL, .direction = vec3_make(1, -1, 0)}; // unit or not
    check_spans(&shade, &light, INFINITY, 2, (const double[][2]){{0, 5.25}, {6.5, INFINITY}});
    shade_close(&shade);
}
Test(truth_airlight, a_light_inside_or_below_the_block)
{
    Shade shade = shade_open(block());
    const Light inside = {.kind = LIGHT_POINT, .position = vec3_make(0, 0.875f, 0.1f)};
    check_spans(&shade, &inside, INFINITY, 0, NULL);
    const Light below = {.kind = LIGHT_POINT, .position = vec3_make(0, 0.5f, 0.1f)};
    check_spans(&shade, &below, INFINITY, 1, (const double[][2]){{0, INFINITY}});
    const Light beside = {.kind = LIGHT_POINT,
                          .position =
                              vec3_make(1, 0.875f, 0.1f)}; // the block's lower edge: x falls 0.5 in 0.125
    check_spans(&shade, &beside, INFINITY, 1, (const double[][2]){{6 - 0.875 / 0.25, INFINITY}});
    shade_close(&shade);
}
// The cone's border is met where |x| = 2 tan: at ±2 for 45°. One that looks along the ray's way stays on it.
Test(truth_airlight, a_cone)
{
    Shade shade = shade_open((Mesh){0});
    Light light = {.kind = LIGHT_SPOT,
                   .position = vec3_make(0, 2, 0.1f),
                   .direction = vec3_make(0, -1, 0),
                   .half_angle_rad = (float)M_PI_4};
    check_spans(&shade, &light, INFINITY, 1, (const double[][2]){{3, 7}});
    light.direction = vec3_make((float)M_SQRT1_2, -(float)M_SQRT1_2, 0);
    light.half_angle_rad = (float)atan(1.0 / 3.0); // tan 45° ∓: 1/2 and 2
    check_spans(&shade, &light, INFINITY, 1, (const double[][2]){{6, 9}});
    light.half_angle_rad = (float)(M_PI_4 + atan(0.5)); // from -26.6° to beyond the ray's way
    check_spans(&shade, &light, INFINITY, 1, (const double[][2]){{4, INFINITY}});
    light.direction = vec3_make(0, 1, 0);
    check_spans(&shade, &light, INFINITY, 0, NULL);
    shade_close(&shade);
}
Test(truth_airlight, a_light_on_the_rays_line)
{
    Mesh mesh = {0};
    mesh_add_box(&mesh, vec3_make(1, -1, -1), vec3_make(2, 1, 1), 0);
    Shade shade = shade_open(mesh);
    Light light = {.kind = LIGHT_POINT, .position = vec3_make(0, 0, 0.1f)};
    check_spans(&shade, &light, INFINITY, 1, (const double[][2]){{0, 6}});
    light.position = vec3_make(3, 0, 0.1f);
    check_spans(&shade, &light, INFINITY, 1, (const double[][2]){{7, INFINITY}});
    Light sun = {.kind = LIGHT_DIRECTIONAL, .direction = vec3_make(1, 0, 0)};
    check_spans(&shade, &sun, 6, 1, (const double[][2]){{0, 6}});
    sun.direction = vec3_make(-1, 0, 0);
    check_spans(&shade, &sun, 6, 0, NULL);
    shade_close(&shade);
}

// Ten thousand random triangles: what Embree says of points on random rays, except within its rounding of a border (5e-6 of 1 m).
static void check_embree(LightKind kind)
{
    Scene *scene = scene_open("slivers", 3);
    Shade shade = shade_open(scene->mesh);
    const vec3 size = scene->upper - scene->lower, centre = 0.5f * (scene->upper + scene->lower);
    const float diagonal = vec3_length(size);
    srand(5);
#define DRAW ((float)rand() / (float)RAND_MAX - 0.5f)
    int lit = 0, dark = 0;
    for (int ray = 0; ray < 150; ray++) {
        const vec3 eye = centre + 1.2f * vec3_make(DRAW, DRAW, DRAW) * size;
        const vec3 along = vec3_normalize(vec3_make(DRAW, DRAW, DRAW));
        const Light light = {.kind = kind,
                             .position = centre + 1.5f * vec3_make(DRAW, DRAW, DRAW) * size,
                             .direction = vec3_normalize(vec3_make(DRAW, DRAW, DRAW))};
        const double from[3] = {(double)eye[0], (double)eye[1], (double)eye[2]};
        const double way[3] = {(double)along[0], (double)along[1], (double)along[2]};
        size_t count;
        TruthSpan *spans = truth_lit_spans(shade.shadows, &light, from, way, (double)diagonal, &count);
        for (int i = 0; i < 20; i++) {
            const double t = (double)diagonal * rand() / RAND_MAX;
            const vec3 point = eye + (float)t * along;
            bool in = false, border = false;
            for (size_t k = 0; k < count; k++) {
                in = in || (t > spans[k].t0 && t < spans[k].t1);
                border =
                    border || fmin(fabs(t - spans[k].t0), fabs(t - spans[k].t1)) < 1e-4 * (double)diagonal;
            }
            const vec3 to =
                kind == LIGHT_DIRECTIONAL ? point - 3.0f * diagonal * light.direction : light.position;
            if (!border)
                cr_assert_eq(in, !truth_occluded(shade.truth, point, to), "ray %d, t %g: %s", ray, t,
                             in ? "lit" : "dark");
            lit += in;
            dark += !in;
        }
        free(spans);
    }
    cr_assert(lit > 300 && dark > 300, "%d lit, %d dark", lit, dark);
    shade_close(&shade);
    scene_close(scene);
}
Test(truth_airlight, embree_agrees_about_points)
{
    check_embree(LIGHT_POINT);
}
Test(truth_airlight, embree_agrees_about_the_sun)
{
    check_embree(LIGHT_DIRECTIONAL);
}

static double point(double nearest, double foot, double radius, double from, double to, double sigma)
{
    return 4.0 * M_PI * truth_airlight_point(nearest, foot, radius, from, to, sigma, &uniform);
}
// Clear air: the angle that the light sees the ray under, over its distance. On the ray's line: 1/distance. Inside r0: the length.
Test(truth_airlight, closed_forms)
{
    static const double feet[] = {-1e6, -1e3, -1, 0.3, 300, 3e5};
    for (int power = -6; power <= 6; power++)
        for (size_t i = 0; i < sizeof feet / sizeof *feet; i++) {
            const double h = pow(10, power), f = feet[i];
            const double angle = atan2(h * 1.0, h * h + (0 - f) * (1 - f));
            cr_assert_float_eq(point(h, f, 1e-9, 0, 1, 0) / (angle / h), 1.0, 1e-8, "h %g f %g", h, f);
            const double endless = atan2(h, -f) / h;
            cr_assert_float_eq(point(h, f, 1e-9, 0, INFINITY, 0) / endless, 1.0, 1e-8, "h %g f %g, endless",
                               h, f);
        }
    cr_assert_float_eq(point(0, 3, 1e-3, 0, 1, 2.0), exp(-6.0) * (1 / 2.0 - 1 / 3.0), 1e-12);
    cr_assert_float_eq(point(0, 0, 1.0, 0, 0.5, 1e-9), 0.5, 1e-8);
    cr_assert_float_eq(point(0, 0, 1.0, 0, 0.5, 2.0), (1 - exp(-2.0)) / 4, 1e-10); // e^(-σ 2t)
    cr_assert_float_eq(point(0, 0.5, 1.0, 0, 0.5, 2.0), 0.5 * exp(-1.0), 1e-10);
}
// Midpoints by the million, in nothing but the definition.
Test(truth_airlight, midpoints_by_the_million)
{
    const TruthPhase peaked = {"henyey_greenstein", 0.9, 0};
    const double h = 0.1, f = 1.0, sigma = 3.0, r0 = 0.15, a = 0.2, b = 4.0;
    enum { STEPS = 1000000 };
    double sum = 0.0;
    for (int i = 0; i < STEPS; i++) {
        const double t = a + (b - a) * (i + 0.5) / STEPS, r = hypot(h, t - f);
        sum += truth_phase(&peaked, (f - t) / r) * exp(-sigma * (t + r)) / fmax(r * r, r0 * r0);
    }
    cr_assert_float_eq(truth_airlight_point(h, f, r0, a, b, sigma, &peaked) / (sum * (b - a) / STEPS), 1.0,
                       1e-7);
}

// Two lights, three extinctions, half of one light's way in shadow.
Test(truth_airlight, a_ray_through_a_scene)
{
    Shade shade = shade_open(block());
    Light lights[2] = {
        {.kind = LIGHT_POINT,
         .position = vec3_make(0, 2, 0.1f),
         .intensity = vec3_make(1, 2, 3),
         .radius = 1e-3f},
        {.kind = LIGHT_DIRECTIONAL, .direction = vec3_make(0, 1, 0), .intensity = vec3_make(3, 2, 1)}};
    Scene scene = {
        .lights = lights,
        .light_count = 2,
        .medium = {.scattering = vec3_make(0.1f, 0.2f, 0), .absorption = vec3_make(0.4f, 0.3f, 1)}};
    double got[3];
    truth_airlight(shade.shadows, &scene, &uniform, FROM, ALONG, 10.0, got);
    const double lit = point(2, 5, 1e-3, 0, 4, 0.5) + point(2, 5, 1e-3, 6, 10, 0.5),
                 sun = (1 - exp(-5.0)) / 0.5;
    cr_assert_float_eq(got[0] * 4 * M_PI / ((double)0.1f * (lit + 3 * sun)), 1.0, 1e-6);
    cr_assert_float_eq(got[1] * 4 * M_PI / ((double)0.2f * (2 * lit + 2 * sun)), 1.0, 1e-6);
    cr_assert_eq(got[2], 0.0);
    shade_close(&shade);
}

// A picture of the room: as one thread draws it, so do many; and of every third pixel it has the very values of the whole.
Test(truth_airlight, threads_and_pixels_left_out_change_no_value)
{
    enum { WIDTH = 23, HEIGHT = 16, EVERY = 3 };
    Scene *scene = scene_open("cornell", 1);
    const TruthPhase peaked = {"henyey_greenstein", 0.7, 0};
    scene->medium = (Medium){vec3_make(0.1f, 0.2f, 0.3f), vec3_make(0.05f, 0, 0), 0.7f};
    Image one = truth_airlight_draw(scene, &scene->camera, WIDTH, HEIGHT, 1, &peaked, 0.1f, 1);
    Image many = truth_airlight_draw(scene, &scene->camera, WIDTH, HEIGHT, 1, &peaked, 0.1f, 7);
    Image some = truth_airlight_draw(scene, &scene->camera, WIDTH, HEIGHT, EVERY, &peaked, 0.1f, 7);
    Image taken = image_every(&one, EVERY);
    cr_assert_eq(memcmp(one.pixels, many.pixels, sizeof(float) * 4 * WIDTH * HEIGHT), 0, "seven threads");
    cr_assert(some.width == 8 && some.height == 6 && taken.width == 8 && taken.height == 6);
    cr_assert_eq(memcmp(some.pixels, taken.pixels, sizeof(float) * 4 * 8 * 6), 0, "every third pixel");
    cr_assert(one.pixels[4 * WIDTH * HEIGHT / 2] > 0.0f, "there is light in it");
    image_free(&one);
    image_free(&many);
    image_free(&some);
    image_free(&taken);
    scene_close(scene);
}
Test(truth_airlight, large_pictures_are_asked_at_some_256_rows)
{
    static const int rows[][2] = {{1, 1}, {256, 1}, {511, 1}, {512, 2}, {1024, 4}, {16384, 64}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        cr_assert_eq(truth_every(rows[i][0]), rows[i][1], "%d rows", rows[i][0]);
}
