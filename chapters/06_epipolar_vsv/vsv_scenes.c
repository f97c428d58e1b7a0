// vsv_scenes: see vsv_scenes.h.
#include "vsv_scenes.h"
#include "cell24.h"
#include "scene_builtin.h"

static vec3 grey(float value)
{
    return vec3_make(value, value, value);
}

static uint32_t add_stone(Scene *scene)
{
    return scene_add_material(scene, "stone", vec3_make(0.6f, 0.58f, 0.53f), grey(0));
}

static void add_lamp(Scene *scene, vec3 position, float intensity)
{
    scene_add_light(scene, (Light){.kind = LIGHT_POINT,
                                   .position = position,
                                   .intensity = intensity * vec3_make(1, 0.94f, 0.82f)});
}

// 1 000 figures of 1 000 triangles around a lamp on a square: more triangles than pixels.
static void make_crowd(Scene *scene, uint64_t seed)
{
    enum { SIDE = 34, TURNS = 32 };
    static const float APART = 0.8f;
    static const vec2 figure[] = {{0, 0},         {0.17f, 0},     {0.19f, 0.1f},  {0.15f, 0.5f},
                                  {0.16f, 0.85f}, {0.21f, 1.2f},  {0.2f, 1.36f},  {0.12f, 1.44f},
                                  {0.06f, 1.47f}, {0.06f, 1.52f}, {0.1f, 1.57f},  {0.11f, 1.66f},
                                  {0.1f, 1.74f},  {0.08f, 1.79f}, {0.05f, 1.82f}, {0, 1.83f}};
    enum { POINTS = sizeof figure / sizeof *figure };
    Random random = {seed};
    uint32_t cloth[4];
    static const float colours[4][3] = {
        {0.5f, 0.2f, 0.16f}, {0.2f, 0.3f, 0.45f}, {0.45f, 0.42f, 0.36f}, {0.25f, 0.36f, 0.22f}};
    for (int i = 0; i < 4; i++)
        cloth[i] = scene_add_material(scene, "cloth", vec3_make(colours[i][0], colours[i][1], colours[i][2]),
                                      grey(0));
    for (int i = 0; i < SIDE * SIDE; i++) {
        const float x = APART * ((float)(i % SIDE) - 0.5f * SIDE + random_between(&random, 0.2f, 0.8f));
        const float z = APART * ((float)(i / SIDE) - 0.5f * SIDE + random_between(&random, 0.2f, 0.8f));
        const float size = random_between(&random, 0.85f, 1.1f), width = random_between(&random, 0.9f, 1.15f);
        vec2 body[POINTS];
        for (int p = 0; p < POINTS; p++)
            body[p] = (vec2){size * width * figure[p][0], size * figure[p][1]};
        const Frame foot = frame_at(vec3_make(x, 0, z), random_between(&random, 0, 6.28f));
        if (hypotf(x, z + 2) > 1.2f)
            frame_revolve(&scene->mesh, &foot, body, POINTS, TURNS, cloth[i * 7 % 4]);
    }
    const float half = 0.6f * APART * SIDE;
    mesh_add_quad(&scene->mesh, vec3_make(-half, 0, -half), vec3_make(0, 0, 2 * half),
                  vec3_make(2 * half, 0, 0), add_stone(scene));
    add_lamp(scene, vec3_make(0, 1.5f, -2), 24);
    scene->medium = scene_haze(0.09f);
    scene->camera =
        (Camera){vec3_make(1.4f, 3.4f, 7.5f), vec3_make(0, 1.5f, -1.5f), vec3_make(0, 1, 0), 0.8f, 0, 0};
}

const SceneKind vsv_scenes[] = {
    {"cell24", "the 24-cell's edges before a lamp; --path deform turns it in four dimensions", cell24_make},
    {"crowd", "about a thousand figures, a million triangles, around a lamp", make_crowd},
    {NULL, NULL, NULL},
};
