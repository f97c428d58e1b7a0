// epipolar_scene: a whole scene voxelized, scanned, and asked by shadow rays (Embree) whether what it says of light is so.
#ifndef EPIPOLAR_SCENE_H
#define EPIPOLAR_SCENE_H

#include "../chapters/06_epipolar_vsv/vsv_scenes.h"
#include "epipolar_voxels.h"

typedef struct SceneBench {
    VoxelBench voxels;
    Scene *scene;
    Truth *truth;
    uint64_t state;
} SceneBench;

// The scene's own light and camera, cut to what the camera sees; φ is full.
static inline SceneBench scene_bench(const char *name, int alpha, int theta, int phi)
{
    SceneBench bench = {.state = 5};
    bench.voxels = voxels_bench(vec3_make(0, 0, 0), vec3_make(0, 0, 1), alpha, theta, phi);
    const SceneKind *kind = vsv_scenes;
    while (kind->name && strcmp(kind->name, name) != 0)
        kind++;
    bench.scene = kind->name ? scene_from(kind, 1) : scene_open(name, 1);
    bench.truth = truth_open(&bench.scene->mesh);
    bench.voxels.scene = *bench.scene;
    bench.voxels.camera = bench.scene->camera;
    bench.voxels.light = bench.scene->lights[0];
    voxels_grid(&bench.voxels);
    bench.voxels.range =
        epipolar_range_seen(&bench.voxels.frame, &bench.voxels.camera, 1.5f, alpha, theta, phi);
    if (bench.voxels.frame.at_infinity)
        bench.voxels.range.phi_most = 2 * vec3_length(bench.scene->upper - bench.scene->lower);
    return bench;
}
static inline void scene_bench_close(SceneBench *bench)
{
    bench->voxels.scene.mesh = (Mesh){0}; // the scene's
    truth_close(bench->truth);
    scene_close(bench->scene);
    voxels_close(&bench->voxels);
}

static inline double scene_uniform(SceneBench *bench)
{
    bench->state = bench->state * 6364136223846793005u + 1442695040888963407u;
    return (double)(bench->state >> 11) * 0x1p-53;
}

// Whether the light reaches a place in the grid: 1 or 0, or -1 where it cannot be asked: view ray and light ray do not meet or very far away, or the point's
// rounding to single precision takes it out of the voxel.
static inline int scene_lit(SceneBench *bench, const double place[3])
{
    double p[3], back[3];
    if (!voxels_point(&bench->voxels, place, p))
        return -1;
    const vec3 point = vec3_make((float)p[0], (float)p[1], (float)p[2]);
    const double rounded[3] = {(double)point[0], (double)point[1], (double)point[2]};
    const float size = vec3_length(bench->scene->upper - bench->scene->lower);
    if (!(vec3_length(point - bench->voxels.camera.eye) < 10 * size))
        return -1;
    voxels_place(&bench->voxels, rounded, back);
    for (int k = 0; k < 3; k++)
        if (floor(back[k]) != floor(place[k]))
            return -1;
    const vec3 light = bench->voxels.frame.at_infinity ? point - 30 * size * bench->voxels.light.direction
                                                       : bench->voxels.light.position;
    return !truth_occluded(bench->truth, light, point);
}

typedef struct SceneCounts {
    size_t asked, leaks;           // points of lit voxels, those in shadow
    size_t dark, dark_though_lit;  // voxels in shadow, those of which all 27 points are lit
    size_t middles_wrong, middles; // voxels whose middle's light differs from the voxel's, all
} SceneCounts;

// Random voxels of the scanned volume. Corners are taken 1 % inside: nearer, Embree's single precision would decide.
static inline SceneCounts scene_ask(SceneBench *bench, int voxel_count)
{
    static const double offsets[3] = {0.01, 0.5, 0.99};
    const EpipolarRange *range = &bench->voxels.range;
    SceneCounts counts = {0};
    for (int n = 0; n < voxel_count; n++) {
        const int v[3] = {(int)(scene_uniform(bench) * range->alpha),
                          (int)(scene_uniform(bench) * range->theta),
                          (int)(scene_uniform(bench) * range->phi)};
        const bool dark = voxels_get(&bench->voxels, v);
        int lit = 0, asked = 0;
        for (int i = 0; i < 27; i++) {
            const double place[3] = {v[0] + offsets[i % 3], v[1] + offsets[i / 3 % 3], v[2] + offsets[i / 9]};
            const int light = scene_lit(bench, place);
            asked += light >= 0;
            lit += light == 1;
            if (i == 13 && light >= 0) {
                counts.middles++;
                counts.middles_wrong += (light == 0) != dark;
            }
        }
        counts.asked += dark ? 0 : (size_t)asked;
        counts.leaks += dark ? 0 : (size_t)(asked - lit);
        counts.dark += dark && asked > 0;
        counts.dark_though_lit += dark && asked > 0 && lit == asked;
    }
    return counts;
}

#endif
