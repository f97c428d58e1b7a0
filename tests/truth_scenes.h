// What the tests of the truth's light share: scenes of a few quads, closed forms, and how far two pictures with errors lie apart.
#ifndef TRUTH_SCENES_H
#define TRUTH_SCENES_H

#include "truth.h"

#include <criterion/criterion.h>
#include <stdlib.h>
#include <string.h>

static const vec3 BLACK = {0};

static inline Scene *scene_begin(void)
{
    Scene *scene = memory_new(1, sizeof *scene, "a scene");
    scene->name = text_format("test");
    return scene;
}

// Validated, so that normals and the box are there; opened for rays.
static inline Truth *scene_ready(Scene *scene)
{
    char *refused = scene_validate(scene, true);
    cr_assert(refused == NULL, "the scene is refused: %s", refused);
    return truth_open(&scene->mesh);
}

static inline void scene_end(Scene *scene, Truth *truth)
{
    truth_close(truth);
    scene_close(scene);
}

// A closed box all of whose walls emit and reflect alike; the camera is inside.
static inline Scene *furnace(vec3 emission, vec3 albedo)
{
    Scene *scene = scene_begin();
    uint32_t wall = scene_add_material(scene, "wall", albedo, emission);
    mesh_add_box(&scene->mesh, vec3_make(-1, -2, -1.5f), vec3_make(2, 1, 1), wall);
    scene->camera = (Camera){.eye = vec3_make(0.25f, 0, 0.5f),
                             .target = vec3_make(1, -0.5f, -1),
                             .up = vec3_make(0, 1, 0),
                             .vertical_fov_rad = 1.5f,
                             .near_distance = 0.001f};
    return scene;
}

// The scene cornell with a lamp that hangs in it instead of its light. Its normals are the triangles' own.
static inline Scene *cornell_with_lamp(void)
{
    Scene *scene = scene_open("cornell", 1);
    scene->light_count = 0;
    uint32_t lamp = scene_add_material(scene, "lamp", vec3_make(0.5f, 0.5f, 0.5f), vec3_make(9, 8, 6));
    mesh_add_quad(&scene->mesh, vec3_make(-0.7f, 4.3f, -0.6f), vec3_make(1.4f, 0, 0), vec3_make(0, 0, 1.2f),
                  lamp);
    return scene;
}

// Irradiance on a plane from a polygon of radiance 1 wholly above it (Lambert 1760): half the sum over its edges of the angle that each
// subtends, times the cosine between the edge's own plane through the point and the surface.
static inline double polygon_irradiance(const vec3 *corners, int count, vec3 point, vec3 normal)
{
    double sum = 0.0;
    for (int i = 0; i < count; i++) {
        double a[3], b[3], c[3], ab = 0, cc = 0, cn = 0;
        for (int k = 0; k < 3; k++) {
            a[k] = (double)corners[i][k] - (double)point[k];
            b[k] = (double)corners[(i + 1) % count][k] - (double)point[k];
        }
        for (int k = 0; k < 3; k++) {
            c[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
            ab += a[k] * b[k];
            cc += c[k] * c[k], cn += c[k] * (double)normal[k];
        }
        sum += atan2(sqrt(cc), ab) * cn / sqrt(cc);
    }
    return fabs(sum) / 2.0;
}

static inline float channel_of(const Image *image, size_t pixel, int channel)
{
    return image->pixels[3 * pixel + (size_t)channel];
}

// The mean of a channel over all pixels and its standard error: pixels are independent.
static inline void mean_of(const TruthPicture *picture, int channel, double *mean, double *error)
{
    size_t count = (size_t)picture->mean.width * (size_t)picture->mean.height;
    double sum = 0.0, squares = 0.0;
    for (size_t i = 0; i < count; i++) {
        sum += (double)channel_of(&picture->mean, i, channel);
        squares += pow((double)channel_of(&picture->error, i, channel), 2.0);
    }
    *mean = sum / (double)count;
    *error = sqrt(squares) / (double)count;
}

// Two estimates of one picture: their means must lie within 3 of the error of their difference, and so must 99 % of their pixels, in each
// channel. The reference's own error enters as if it were the other's: e² = e_a² + e_b².
static inline void check_same_mean(const TruthPicture *a, const TruthPicture *b, const char *what)
{
    size_t count = (size_t)a->mean.width * (size_t)a->mean.height, within = 0;
    for (int k = 0; k < 3; k++) {
        double ma, ea, mb, eb;
        mean_of(a, k, &ma, &ea);
        mean_of(b, k, &mb, &eb);
        cr_assert(ma > 0.0 && ea + eb > 0.0 && ea + eb < 0.1 * ma,
                  "%s: a mean of %g with an error of %g says little", what, ma, ea + eb);
        cr_assert(fabs(ma - mb) <= 3.0 * hypot(ea, eb), "%s: channel %d: %g and %g are %.2f errors apart",
                  what, k, ma, mb, (ma - mb) / hypot(ea, eb));
        for (size_t i = 0; i < count; i++) {
            double off = (double)channel_of(&a->mean, i, k) - (double)channel_of(&b->mean, i, k);
            within += fabs(off) <=
                      3.0 * hypot((double)channel_of(&a->error, i, k), (double)channel_of(&b->error, i, k));
        }
    }
    cr_assert((double)within >= 0.99 * 3.0 * (double)count, "%s: only %zu of %zu values within 3 errors",
              what, within, 3 * count);
}

#endif
