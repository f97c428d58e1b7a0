// shadow_scenes: see shadow_scenes.h.
#include "shadow_scenes.h"
#include <string.h>

static uint32_t add_stone(Scene *scene)
{
    return scene_add_material(scene, "stone", vec3_make(0.7f, 0.68f, 0.62f), vec3_make(0, 0, 0));
}

static void add_floor(Mesh *mesh, float half, float height, uint32_t material)
{
    mesh_add_quad(mesh, vec3_make(-half, height, -half), vec3_make(0, 0, 2 * half), vec3_make(2 * half, 0, 0),
                  material);
}

static void add_light(Scene *scene, LightKind kind, vec3 position, vec3 direction, float intensity)
{
    scene_add_light(scene, (Light){.kind = kind,
                                   .position = position,
                                   .direction = vec3_normalize(direction),
                                   .intensity = intensity * vec3_make(1, 1, 1),
                                   .half_angle_rad = 1.0f});
}

static Camera camera_at(vec3 eye, vec3 target, float fov_rad)
{
    return (Camera){eye, target, vec3_make(0, 1, 0), fov_rad, 0, 0};
}

// A square of 2 m, 2 m above a floor and 2 m under its light. The camera looks from the side, and not along an axis of the map.
static void make_plate(Scene *scene, uint64_t seed)
{
    (void)seed;
    const uint32_t stone = add_stone(scene);
    add_floor(&scene->mesh, 8, 0, stone);
    add_floor(&scene->mesh, 1, 2, stone);
    add_light(scene, LIGHT_SPOT, vec3_make(0, 4, 0), vec3_make(0, -1, 0), 50);
    scene->camera = camera_at(vec3_make(3, 6, 7), vec3_make(0, 0.5f, 0), 0.9f);
}

// A light a millimetre before a wall: it grazes nearly all of it.
static void make_wall(Scene *scene, uint64_t seed)
{
    (void)seed;
    mesh_add_quad(&scene->mesh, vec3_make(-2, 0, 0), vec3_make(4, 0, 0), vec3_make(0, 3, 0),
                  add_stone(scene));
    add_light(scene, LIGHT_POINT, vec3_make(0.1f, 1.4f, 1e-3f), vec3_make(0, -1, 0), 1);
    scene->camera = camera_at(vec3_make(0.7f, 1.9f, 4), vec3_make(0, 1.5f, 0), 0.8f);
}

// 89.99° from the floor's normal; nothing casts.
static void make_grazing(Scene *scene, uint64_t seed)
{
    (void)seed;
    add_floor(&scene->mesh, 2, 0, add_stone(scene));
    const float elevation = 0.01f * 3.14159265f / 180.0f;
    add_light(scene, LIGHT_DIRECTIONAL, vec3_make(0, 0, 0),
              vec3_make(cosf(elevation) * 0.8f, -sinf(elevation), cosf(elevation) * 0.6f), 1);
    scene->camera = camera_at(vec3_make(2, 3, 4), vec3_make(0, 0, 0), 0.9f);
}

// A square of a millimetre's half side, a millimetre under the light, and its shadow 1000 km below: nine decades.
static void make_near_and_far(Scene *scene, uint64_t seed)
{
    (void)seed;
    const uint32_t stone = add_stone(scene);
    add_floor(&scene->mesh, 4e6f, -1e6f, stone);
    add_floor(&scene->mesh, 1e-3f, -1e-3f, stone);
    add_light(scene, LIGHT_SPOT, vec3_make(0, 0, 0), vec3_make(0, -1, 0), 1e12f);
    scene->camera = camera_at(vec3_make(2e6f, 2e6f, 3e6f), vec3_make(0, -1e6f, 0), 0.8f);
}

// A light in a closed box on a floor: none of it comes out.
static void make_inside(Scene *scene, uint64_t seed)
{
    (void)seed;
    const uint32_t stone = add_stone(scene);
    add_floor(&scene->mesh, 4, 0, stone);
    mesh_add_box(&scene->mesh, vec3_make(-0.5f, 0.5f, -0.5f), vec3_make(0.5f, 1.5f, 0.5f), stone);
    add_light(scene, LIGHT_POINT, vec3_make(0.1f, 1.2f, 0.05f), vec3_make(0, -1, 0), 10);
    scene->camera = camera_at(vec3_make(3, 4, 5), vec3_make(0, 0.5f, 0), 0.8f);
}

// A box behind a spot casts nothing.
static void make_behind(Scene *scene, uint64_t seed)
{
    (void)seed;
    const uint32_t stone = add_stone(scene);
    add_floor(&scene->mesh, 4, 0, stone);
    mesh_add_box(&scene->mesh, vec3_make(-1, 2.25f, -1), vec3_make(1, 3, 1), stone);
    add_light(scene, LIGHT_SPOT, vec3_make(0, 2, 0), vec3_make(0, -1, 0), 10);
    scene->camera = camera_at(vec3_make(0.4f, 1.9f, 3.9f), vec3_make(0, 0, 0), 0.8f);
}

// Three floors in one plane, cut up otherwise: their depths differ by rounding alone.
static void make_ties(Scene *scene, uint64_t seed)
{
    (void)seed;
    Mesh *mesh = &scene->mesh;
    const uint32_t stone = add_stone(scene);
    const vec3 u = vec3_normalize(vec3_make(1, 0.3f, 0)), v = vec3_normalize(vec3_make(0.1f, 0.2f, -1));
    for (int i = 0; i < 3; i++) {
        const float half = 2.0f - 0.37f * (float)i;
        const vec3 a = half * u + 0.3f * half * v, b = 0.8f * half * v - 0.2f * half * u;
        mesh_add_quad(mesh, -0.5f * (a + b), a, b, stone);
    }
    add_light(scene, LIGHT_SPOT, vec3_make(0.5f, 3, 0.7f), vec3_make(-0.5f, -3, -0.7f), 10);
    scene->camera = camera_at(vec3_make(0.5f, 3, 4), vec3_make(0, 0, 0), 0.6f);
}

// Inside a ball of 3 m whose middle is the light's: from any surface point the way to it is free. The eye stands beside the light and looks
// along an edge of the cube's faces or through its corner, so that the picture's middle column and pixel lie on them.
static void make_ball(Scene *scene, vec3 look)
{
    static const float RADIUS = 3.0f, PI = 3.14159265f;
    vec2 profile[25];
    for (int i = 0; i < 25; i++) {
        const float turn = PI * (float)i / 24;
        profile[i] = (vec2){i == 0 || i == 24 ? 0.0f : RADIUS * sinf(turn), RADIUS * cosf(turn)};
    }
    const uint32_t stone = add_stone(scene);
    for (int i = 0; i < 24; i++)
        for (int s = 0; s < 48; s++) {
            const float from = PI / 24 * (float)s, to = PI / 24 * (float)((s + 1) % 48);
            const vec2 a = profile[i], b = profile[i + 1];
            const vec3 p[] = {vec3_make(a[0] * cosf(from), a[1], a[0] * sinf(from)),
                              vec3_make(a[0] * cosf(to), a[1], a[0] * sinf(to)),
                              vec3_make(b[0] * cosf(to), b[1], b[0] * sinf(to)),
                              vec3_make(b[0] * cosf(from), b[1], b[0] * sinf(from))};
            uint32_t v[4];
            for (int k = 0; k < 4; k++)
                v[k] = mesh_add_vertex(&scene->mesh, p[k], -1.0f / RADIUS * p[k]);
            if (i > 0)
                mesh_add_triangle(&scene->mesh, v[0], v[2], v[1], stone);
            if (i < 23)
                mesh_add_triangle(&scene->mesh, v[0], v[3], v[2], stone);
        }
    add_light(scene, LIGHT_POINT, vec3_make(0, 0, 0), vec3_make(0, -1, 0), 10);
    scene->camera = camera_at(vec3_make(0, 0, 0), look, 1.2f);
}
static void make_edge(Scene *scene, uint64_t seed)
{
    (void)seed;
    make_ball(scene, vec3_make(1, 0, 1));
}
static void make_corner(Scene *scene, uint64_t seed)
{
    (void)seed;
    make_ball(scene, vec3_make(1, 1, 1));
}

// A closed room with a lamp, all lengths `scale` times as long and the lamp scale² times as strong: the same picture.
static void make_scaled_room(Scene *scene, float scale)
{
    mesh_add_box(&scene->mesh, scale * vec3_make(-2, 0, -1.5f), scale * vec3_make(2, 3, 1.5f),
                 add_stone(scene));
    add_light(scene, LIGHT_POINT, scale * vec3_make(0.3f, 1.7f, 0.2f), vec3_make(0, -1, 0),
              10 * scale * scale);
    scene->camera = camera_at(scale * vec3_make(1.8f, 2.6f, 1.3f), scale * vec3_make(-1, 0.8f, -0.6f), 1.2f);
}
static void make_room(Scene *scene, uint64_t seed)
{
    (void)seed;
    make_scaled_room(scene, 1);
}
static void make_tiny_room(Scene *scene, uint64_t seed)
{
    (void)seed;
    make_scaled_room(scene, 1e-3f);
}
static void make_giant_room(Scene *scene, uint64_t seed)
{
    (void)seed;
    make_scaled_room(scene, 1e6f);
}

const SceneKind shadow_scenes[] = {
    {"plate", "a plate that floats above a floor under a spot", make_plate},
    {"wall", "a light a millimetre off a wall", make_wall},
    {"grazing", "a sun 0.01 degrees above a floor", make_grazing},
    {"decades", "a caster 10^-3 m and a receiver 10^6 m from a light", make_near_and_far},
    {"inside", "a light in a closed box", make_inside},
    {"behind", "a box behind a spot", make_behind},
    {"ties", "three surfaces in one plane", make_ties},
    {"edge", "a ball about a light, seen along an edge of the cube map", make_edge},
    {"corner", "the same through the cube map's corner", make_corner},
    {"room", "a closed room about a lamp", make_room},
    {"tiny_room", "the same, a thousand times smaller", make_tiny_room},
    {"giant_room", "the same, a million times larger", make_giant_room},
    {NULL, NULL, NULL},
};

double scenes_lit(const char *scene)
{
    static const char *const all[] = {"wall", "grazing", "behind", "ties", "edge", "corner"};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        if (strcmp(scene, all[i]) == 0)
            return 1.0;
    return strcmp(scene, "inside") == 0 ? 0.0 : -1.0;
}

double scenes_lit_at(const char *scene, LightKind kind, vec3 point)
{
    if (strcmp(scene, "decades") != 0 || kind == LIGHT_DIRECTIONAL || point[1] > -1e5f)
        return -1.0;
    return fabsf(point[0]) < 1e6f && fabsf(point[2]) < 1e6f ? 0.0 : 1.0; // a plate under 45° to each side
}

double scenes_reflected_flux(const Scene *scene)
{
    if (!strstr(scene->name, "room") || scene->light_count == 0)
        return -1.0;
    return 4.0 * M_PI * (double)scene->lights[0].intensity[0] * (double)scene->materials[0].albedo[0];
}
