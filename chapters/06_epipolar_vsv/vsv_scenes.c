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
        const int column = i % SIDE, row = i / SIDE;
        const float x = APART * ((float)column - 0.5f * SIDE + random_between(&random, 0.2f, 0.8f));
        const float z = APART * ((float)row - 0.5f * SIDE + random_between(&random, 0.2f, 0.8f));
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

// Where the cases of the stability table take place: a floor, a wall, two blocks.
static void make_room(Scene *scene)
{
    const uint32_t stone = add_stone(scene);
    mesh_add_quad(&scene->mesh, vec3_make(-4, 0, -4), vec3_make(0, 0, 10), vec3_make(8, 0, 0), stone);
    mesh_add_quad(&scene->mesh, vec3_make(-4, 0, -4), vec3_make(8, 0, 0), vec3_make(0, 4, 0), stone);
    mesh_add_box(&scene->mesh, vec3_make(-0.9f, 0, -1.2f), vec3_make(0, 1.3f, -0.4f), stone);
    mesh_add_box(&scene->mesh, vec3_make(0.9f, 0, -0.6f), vec3_make(1.3f, 2.2f, -0.3f), stone);
    scene->medium = scene_haze(0.15f);
    scene->camera =
        (Camera){vec3_make(0.3f, 1.2f, 3.5f), vec3_make(0.2f, 1, -1), vec3_make(0, 1, 0), 0.9f, 0, 0};
}

static void make_stage(Scene *scene, uint64_t seed)
{
    (void)seed;
    make_room(scene);
    add_lamp(scene, vec3_make(0.8f, 1.6f, -2.2f), 8);
}

static void make_stage_sun(Scene *scene, uint64_t seed)
{
    (void)seed;
    make_room(scene);
    scene_add_light(scene, (Light){.kind = LIGHT_DIRECTIONAL,
                                   .direction = vec3_normalize(vec3_make(-0.5f, -0.6f, 0.4f)),
                                   .intensity = grey(3)});
}

static void make_mist(Scene *scene, uint64_t seed)
{
    (void)seed;
    add_lamp(scene, vec3_make(0.3f, 0.2f, -3), 4);
    scene->medium = scene_haze(0.25f);
    scene->camera = (Camera){grey(0), vec3_make(0, 0, -1), vec3_make(0, 1, 0), 1, 0, 0};
}

// The lamp's box is closed; another, closed too, stands where an eye may be put into it.
static void make_lamp_in_box(Scene *scene, uint64_t seed)
{
    make_stage(scene, seed);
    mesh_add_box(&scene->mesh, vec3_make(0.6f, 1.4f, -2.5f), vec3_make(1.1f, 1.9f, -1.9f), 0);
    mesh_add_box(&scene->mesh, vec3_make(-0.2f, 0.3f, 2.5f), vec3_make(0.4f, 0.9f, 3.2f), 0);
}

// A square across the way from eye to lamp.
static void make_plate(Scene *scene, uint64_t seed)
{
    (void)seed;
    mesh_add_quad(&scene->mesh, vec3_make(-0.4f, -0.3f, -1.5f), vec3_make(1, 0, 0), vec3_make(0, 0.8f, 0),
                  add_stone(scene));
    make_mist(scene, seed);
}

// A sheet in which eye and lamp both lie, from before the one to behind the other: it hides nothing of the air from either, and has no volume.
static void make_edge_on(Scene *scene, uint64_t seed)
{
    mesh_add_quad(&scene->mesh, vec3_make(-0.2f, 0, 2), vec3_make(0.3f, 0, 0), vec3_make(0, 0, -6),
                  add_stone(scene));
    make_mist(scene, seed);
    scene->lights[0].position = vec3_make(0, 0, -3);
    scene->camera.target = vec3_make(0.2f, 0.1f, -1);
}

static void make_in_one_box(Scene *scene, uint64_t seed)
{
    mesh_add_box(&scene->mesh, vec3_make(-1.2f, -0.9f, -4), vec3_make(1.1f, 1, 0.7f), add_stone(scene));
    mesh_add_box(&scene->mesh, vec3_make(-0.4f, -0.5f, -2), vec3_make(-0.1f, 0.3f, -1.6f), 0);
    make_mist(scene, seed);
}

// A pole before the open sky, beyond which the lamp's φ reaches up to π − α.
static void make_pole(Scene *scene, uint64_t seed)
{
    mesh_add_box(&scene->mesh, vec3_make(-0.2f, -2, -2.2f), vec3_make(0.1f, 0.6f, -1.9f), add_stone(scene));
    make_mist(scene, seed);
}

const SceneKind vsv_scenes[] = {
    {"cell24", "the 24-cell's edges before a lamp; --path deform turns it in four dimensions", cell24_make},
    {"crowd", "about a thousand figures, a million triangles, around a lamp", make_crowd},
    {"stage", "a floor, a wall, two blocks and a lamp between them", make_stage},
    {"stage_sun", "the same in the sun", make_stage_sun},
    {"mist", "a lamp in nothing but mist", make_mist},
    {"lamp_in_box", "the stage, its lamp in a closed box, and an empty one before the eye", make_lamp_in_box},
    {"plate", "a square across the way from eye to lamp", make_plate},
    {"edge_on", "a sheet in which eye and lamp both lie", make_edge_on},
    {"in_one_box", "eye and lamp in one closed box", make_in_one_box},
    {"pole", "a pole before a lamp and the open sky", make_pole},
    {NULL, NULL, NULL},
};
