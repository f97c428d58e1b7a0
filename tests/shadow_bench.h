// What the tests of chapter 02 share: a scene made by the test, its G-buffer, a light's map, and the visibilities that come out.
#ifndef SHADOW_BENCH_H
#define SHADOW_BENCH_H

#include "../chapters/02_shadow_maps/shadow_judge.h"
#include "../chapters/02_shadow_maps/map.h"

#include <criterion/criterion.h>
#include <stdlib.h>

enum { SIDE = 128 }; // pixels

typedef struct ShadowBench {
    Raster *raster;
    MapShaders shaders;
    Scene *scene;
    RasterMesh mesh;
    GBuffer gbuffer;
    Camera camera;
    GLuint visibility;
} ShadowBench;

static inline ShadowBench shadow_bench(void (*make)(Scene *, uint64_t), uint64_t seed)
{
    gl_open(gl_headless_platform(), 0, 0, "test_02");
    shader_search_first("tests/data/shadow");
    const SceneKind kind = {"test", "a test", make};
    ShadowBench bench = {
        .raster = raster_open(), .shaders = map_shaders_open(), .scene = scene_from(&kind, seed)};
    bench.mesh = raster_mesh(bench.scene);
    bench.gbuffer = raster_gbuffer(SIDE, SIDE);
    bench.camera = bench.scene->camera;
    bench.visibility = gl_texture(.label = "visibility", .format = GL_R32F, .width = SIDE, .height = SIDE);
    raster_gbuffer_draw(bench.raster, &bench.gbuffer, &bench.camera, &bench.mesh);
    return bench;
}

static inline float *shadow_read(GLuint texture, GLenum format, int channels, size_t pixels)
{
    float *data = malloc((size_t)channels * pixels * sizeof *data);
    gl_texture_read(texture, 0, format, GL_FLOAT, (size_t)channels * pixels * sizeof *data, data);
    return data;
}

// Everything from the receivers to the visibilities, bottom row first.
static inline float *shadow_ask(ShadowBench *bench, const ShadowMap *map, const MapLookup *lookup,
                                float tessellation)
{
    const Light *light = &bench->scene->lights[0];
    map_shaders_add(&bench->shaders, map->shape);
    map_find_receivers(&bench->shaders, map, light, &bench->gbuffer, &bench->camera, lookup);
    const MapCasters casters =
        map_find_casters(&bench->shaders, map, light, &bench->mesh, lookup, tessellation);
    map_draw(&bench->shaders, map, light, &bench->mesh, &casters);
    if (lookup->filter == FILTER_VARIANCE)
        map_filter_moments(&bench->shaders, map, light, lookup);
    map_visibility(&bench->shaders, map, light, &bench->gbuffer, &bench->camera, lookup, bench->visibility);
    return shadow_read(bench->visibility, GL_RED, 1, SIDE * SIDE);
}

// The point that each pixel sees, from the camera's own definition (target straight ahead, square picture), in double.
static inline void shadow_points(const ShadowBench *bench, double (*points)[3])
{
    float *distance = shadow_read(bench->gbuffer.distance, GL_RED, 1, SIDE * SIDE);
    const Camera *c = &bench->camera;
    const vec3 ahead = vec3_normalize(c->target - c->eye), right = vec3_normalize(vec3_cross(ahead, c->up));
    const vec3 up = vec3_cross(right, ahead);
    const double half = tan(0.5 * (double)c->vertical_fov_rad);
    for (int i = 0; i < SIDE * SIDE; i++) {
        const int column = i % SIDE, row = i / SIDE;
        const double x = half * (2 * (column + 0.5) / SIDE - 1), y = half * (2 * (row + 0.5) / SIDE - 1);
        const double length = sqrt(1 + x * x + y * y);
        for (int k = 0; k < 3; k++)
            points[i][k] = c->eye[k] + (double)distance[i] / length * (ahead[k] + x * right[k] + y * up[k]);
    }
    free(distance);
}

#endif
