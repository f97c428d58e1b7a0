// vsv_boundaries: whether a volume's voxels differ from the truth only beside true borders of shadow. For tests of scenes.
#ifndef VSV_BOUNDARIES_H
#define VSV_BOUNDARIES_H

#include "../chapters/06_epipolar_vsv/rays.h"
#include "../chapters/06_epipolar_vsv/vsv.h"
#include "../chapters/06_epipolar_vsv/vsv_scenes.h"
#include "raster.h"

#include <criterion/criterion.h>
#include <stdlib.h>
#include <string.h>

typedef struct Boundaries {
    const Scene *scene;
    const Light *light;
    Truth *truth;
    TruthShadows *shadows;
    Vsv vsv;
    uint32_t *voxels;
    float *phi;   // rays_angles
    double texel; // radians, at a face's middle, where it is largest; directional: metres
    double voxel[3];
} Boundaries;

static inline double boundaries_dot(vec3 a, const double b[3])
{
    return (double)a[0] * b[0] + (double)a[1] * b[1] + (double)a[2] * b[2];
}

// Whether all of a view ray's φ between two are lit, all dark (0), or neither (-1); by exact spans. Beyond π − α there is nothing: -2.
static inline int boundaries_state(const Boundaries *b, double alpha, double theta, double phi0, double phi1)
{
    const EpipolarFrame *f = &b->vsv.frame;
    double way[3], eye[3], t[2];
    for (int k = 0; k < 3; k++) {
        way[k] = cos(alpha) * (double)f->axis[k] +
                 sin(alpha) * (cos(theta) * (double)f->up[k] + sin(theta) * (double)f->side[k]);
        eye[k] = (double)f->eye[k];
    }
    for (int i = 0; i < 2; i++) {
        const double phi = i ? phi1 : phi0;
        if (!f->at_infinity && (alpha + phi >= M_PI || alpha <= 0.0))
            return -2;
        t[i] = f->at_infinity ? phi / sin(alpha) : (double)f->distance * sin(phi) / sin(alpha + phi);
    }
    size_t count;
    TruthSpan *spans = truth_lit_spans(b->shadows, b->light, eye, way, t[1], &count);
    double lit = 0.0;
    for (size_t i = 0; i < count; i++)
        lit += fmax(fmin(spans[i].t1, t[1]) - fmax(spans[i].t0, t[0]), 0.0);
    free(spans);
    const double all = t[1] - t[0], rounding = 1e-9 * t[1];
    return lit >= all - rounding ? 1 : lit <= rounding ? 0 : -1;
}

// Whether the truth says `lit` anywhere within a voxel of the place, or a texel of the map, in α, θ and φ.
static inline bool boundaries_near(const Boundaries *b, double alpha, double theta, double phi, int lit)
{
    const double sine = b->vsv.frame.at_infinity ? phi : sin(phi);
    const double reach_phi = fmax(b->voxel[2], b->texel);
    const double reach_theta = fmin(fmax(b->voxel[1], b->texel / sine), M_PI);
    for (int probes = 1; probes <= 8; probes *= 2) // coarse first: most borders are found at once
        for (int i = -probes; i <= probes; i++)
            for (int j = -1; j <= 1; j++) {
                const double a = alpha + j * b->voxel[0], from = fmax(phi - reach_phi, 0.0);
                const double most = b->vsv.frame.at_infinity ? INFINITY : M_PI - a - 1e-6;
                const int state = boundaries_state(b, a, theta + reach_theta * i / probes, from,
                                                   fmin(phi + reach_phi, most));
                if (state == -1 || state == lit)
                    return true;
            }
    return false;
}

static inline Boundaries boundaries_open(const Scene *scene, const VsvSettings *settings, int map_resolution)
{
    gl_open(GL_PLATFORM_OSMESA, 16, 16, "test");
    const Light *light = &scene->lights[0];
    Boundaries b = {.scene = scene, .light = light, .truth = truth_open(&scene->mesh)};
    b.shadows = truth_shadows_open(&scene->mesh, b.truth);
    Raster *raster = raster_open();
    RasterMesh mesh = raster_mesh(scene);
    DepthMap map = raster_depth_map(scene, light, map_resolution, NULL, 1.0f);
    raster_depth_map_draw(raster, &map, light, &mesh);
    const EpipolarFrame frame = epipolar_frame(&scene->camera, light);
    EpipolarRange range = epipolar_range_full(settings->alpha, settings->theta, settings->phi);
    if (frame.at_infinity)
        range.phi_most = vec3_length(scene->upper - scene->lower);
    b.vsv = vsv_open(settings, &map);
    vsv_aim(&b.vsv, &frame, &range, &scene->camera, 64, 64);
    vsv_clear(&b.vsv);
    vsv_voxelize_map(&b.vsv, light, &map);
    vsv_scan(&b.vsv);
    const size_t words = (size_t)settings->alpha * (size_t)settings->theta * (size_t)settings->phi / 32;
    b.voxels = memory_new(words, sizeof *b.voxels, "voxels");
    gl_buffer_read(b.vsv.voxels, 0, words * sizeof *b.voxels, b.voxels);
    b.phi = rays_angles(&b.vsv.range, false);
    b.texel = (double)map.texel_size;
    b.voxel[0] = M_PI / settings->alpha;
    b.voxel[1] = 2 * M_PI / settings->theta;
    b.voxel[2] = (double)range.phi_most / settings->phi;
    raster_depth_map_delete(&map);
    raster_mesh_delete(&mesh);
    raster_close(raster);
    return b;
}

static inline void boundaries_close(Boundaries *b)
{
    vsv_close(&b->vsv);
    free(b->voxels);
    free(b->phi);
    truth_shadows_close(b->shadows);
    truth_close(b->truth);
    gl_close();
}

// Every voxel of every `stride`-th view ray, at its middle. Returns the share that differs.
static inline double boundaries_check(const Boundaries *b, int stride)
{
    const VsvSettings *size = &b->vsv.settings;
    size_t asked = 0, differ = 0;
    for (int row = stride / 2; row < size->alpha * size->theta; row += stride) {
        const double alpha = (row / size->theta + 0.5) * b->voxel[0],
                     theta = -M_PI + (row % size->theta + 0.5) * b->voxel[1];
        for (int k = 0; k < size->phi; k++) {
            const double phi = (double)b->phi[size->phi + 1 + k], thin = 1e-7 * phi;
            const int truth = boundaries_state(b, alpha, theta, phi - thin, phi + thin);
            if (truth < 0) // beyond the ray's end, or the middle itself is a border
                continue;
            if (b->light->kind == LIGHT_SPOT) { // outside its cone nothing asks
                const double turn[3] = {sin(phi) * cos(theta), sin(phi) * sin(theta), -cos(phi)};
                const vec3 d = b->light->direction;
                const double along = turn[0] * (double)vec3_dot(b->vsv.frame.up, d) +
                                     turn[1] * (double)vec3_dot(b->vsv.frame.side, d) +
                                     turn[2] * (double)vec3_dot(b->vsv.frame.axis, d);
                if (along < cos((double)b->light->half_angle_rad - b->texel - b->voxel[2]))
                    continue;
            }
            const size_t word = (size_t)row * (size_t)(size->phi / 32) + (size_t)(k / 32);
            const int lit = !(b->voxels[word] >> (k % 32) & 1);
            asked++;
            differ += lit != truth;
            if (lit != truth)
                cr_assert(boundaries_near(b, alpha, theta, phi, lit),
                          "%s: voxel (%d %d %d) is %s, and all within a voxel and a texel is not",
                          b->scene->name, row / size->theta, row % size->theta, k, lit ? "lit" : "dark");
        }
    }
    cr_assert(asked > 1000, "%s: only %zu voxels", b->scene->name, asked);
    return (double)differ / (double)asked;
}

// The share of voxels that differ: some (more than `least`), or nothing was asked; few (less than `most`), since borders are few.
static inline void boundaries_check_scene(const char *name, int map, int stride, double least, double most)
{
    static const VsvSettings settings = {.alpha = 64,
                                         .theta = 64,
                                         .phi = 128,
                                         .scan = "columns",
                                         .warp = "even",
                                         .slices = "uniform",
                                         .shape = "cube"};
    const SceneKind *kind = vsv_scenes;
    while (kind->name && strcmp(kind->name, name) != 0)
        kind++;
    Scene *scene = kind->name ? scene_from(kind, 1) : scene_open(name, 1);
    Boundaries b = boundaries_open(scene, &settings, map);
    const double share = boundaries_check(&b, stride);
    cr_assert(share > least && share < most, "%s: %g of the voxels differ", name, share);
    boundaries_close(&b);
    scene_close(scene);
}

#endif
