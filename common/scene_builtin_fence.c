// scene_builtin_fence: a chain-link fence before a statue: thousands of thin wires, each thinner than a texel of most shadow maps.
#include "scene_builtin.h"

static const float PI = 3.14159265f;
static const float WIDTH = 4.8f, HEIGHT = 2.2f; // of the fence, metres
static const float LINK = 0.12f;                // a diamond's half diagonals
static const float WIRE = 0.012f, POST = 0.05f; // radii
static const float FENCE_Z = 1.2f;              // the statue stands in the origin
enum { WIRE_SIDES = 5, POST_SIDES = 12 };

// A tube from a to b, open at its ends.
static void tube(Mesh *mesh, vec3 a, vec3 b, float radius, uint32_t material)
{
    const vec3 along = vec3_normalize(b - a);
    const vec3 u = vec3_normalize(vec3_cross(along, vec3_make(0, 0, 1))), v = vec3_cross(along, u);
    uint32_t first = 0;
    for (int i = 0; i <= WIRE_SIDES; i++) {
        const float turn = 2 * PI * (float)(i % WIRE_SIDES) / WIRE_SIDES;
        const vec3 out = cosf(turn) * u + sinf(turn) * v;
        const uint32_t vertex = mesh_add_vertex(mesh, a + radius * out, out);
        mesh_add_vertex(mesh, b + radius * out, out);
        first = i == 0 ? vertex : first;
    }
    for (uint32_t i = 0; i < WIRE_SIDES; i++) {
        const uint32_t p = first + 2 * i;
        mesh_add_triangle(mesh, p, p + 2, p + 1, material);
        mesh_add_triangle(mesh, p + 1, p + 2, p + 3, material);
    }
}

// Each wire runs up in a zigzag and hooks into its neighbours at its corners: it passes before one and behind the other.
static void chain_links(Mesh *mesh, uint32_t material)
{
    const int wires = (int)(WIDTH / LINK), corners = (int)(HEIGHT / LINK);
    for (int wire = 0; wire < wires; wire++)
        for (int corner = 0; corner < corners; corner++) {
            vec3 ends[2];
            for (int end = 0; end < 2; end++) {
                const int at = corner + end;
                const bool right = (at + wire) % 2 == 1;
                const float x = -WIDTH / 2 + LINK * ((float)wire + (right ? 1.0f : 0.0f));
                ends[end] = vec3_make(x, LINK * (float)at, FENCE_Z + (right ? WIRE : -WIRE));
            }
            tube(mesh, ends[0], ends[1], WIRE, material);
        }
}

void make_fence(Scene *scene, uint64_t seed)
{
    (void)seed;
    Mesh *mesh = &scene->mesh;
    const vec3 black = vec3_make(0, 0, 0);
    const uint32_t ground = scene_add_material(scene, "ground", vec3_make(0.42f, 0.40f, 0.35f), black);
    const uint32_t wall = scene_add_material(scene, "wall", vec3_make(0.60f, 0.53f, 0.45f), black);
    const uint32_t steel = scene_add_material(scene, "steel", vec3_make(0.45f, 0.47f, 0.50f), black);
    const uint32_t stone = scene_add_material(scene, "stone", vec3_make(0.74f, 0.71f, 0.64f), black);
    mesh_add_quad(mesh, vec3_make(-6, 0, -3), vec3_make(0, 0, 9), vec3_make(12, 0, 0), ground);
    mesh_add_quad(mesh, vec3_make(-6, 0, -3), vec3_make(12, 0, 0), vec3_make(0, 4, 0), wall);

    mesh_add_box(mesh, vec3_make(-0.5f, 0, -0.5f), vec3_make(0.5f, 0.5f, 0.5f), stone);
    const Frame statue = frame_at(black, 0.2f);
    static const vec2 body[] = {{0.36f, 0.5f},  {0.38f, 0.56f}, {0.31f, 0.62f}, {0.27f, 0.9f},
                                {0.22f, 1.15f}, {0.20f, 1.28f}, {0.25f, 1.45f}, {0.29f, 1.62f},
                                {0.26f, 1.72f}, {0.10f, 1.80f}, {0.08f, 1.87f}, {0.13f, 1.94f},
                                {0.16f, 2.04f}, {0.14f, 2.16f}, {0.08f, 2.23f}, {0, 2.25f}};
    frame_revolve(mesh, &statue, body, sizeof body / sizeof *body, 32, stone);

    static const vec2 post[] = {
        {POST, 0}, {POST, HEIGHT + 0.1f}, {POST / 2, HEIGHT + 0.14f}, {0, HEIGHT + 0.15f}};
    for (int i = 0; i < 4; i++) {
        const Frame foot =
            frame_at(vec3_make(-WIDTH / 2 + WIDTH / 3 * (float)i, 0, FENCE_Z - WIRE - POST), 0);
        frame_revolve(mesh, &foot, post, 4, POST_SIDES, steel);
    }
    const vec3 rail = vec3_make(WIDTH / 2, LINK * floorf(HEIGHT / LINK), FENCE_Z - POST),
               left = vec3_make(-WIDTH, 0, 0);
    tube(mesh, rail + left, rail, 2 * WIRE, steel);
    chain_links(mesh, steel);

    scene_add_light(scene, (Light){.kind = LIGHT_SPOT,
                                   .position = vec3_make(-3.2f, 3.4f, 4.2f),
                                   .direction = vec3_normalize(vec3_make(3.2f, -2.5f, -4.4f)),
                                   .intensity = vec3_make(120, 114, 100),
                                   .half_angle_rad = 0.5f});
    scene->medium = (Medium){vec3_make(0.06f, 0.06f, 0.06f), vec3_make(0.01f, 0.01f, 0.01f), 0.5f};
    scene->camera =
        (Camera){vec3_make(2.2f, 1.9f, 4.6f), vec3_make(-0.1f, 1.05f, 0), vec3_make(0, 1, 0), 0.75f, 0, 0};
}
