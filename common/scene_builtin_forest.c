// scene_builtin_forest: trees in mist before a low lamp: thousands of branches thinner than a texel of most maps, and leaves of two triangles.
#include "scene_builtin.h"

static const float PI = 3.14159265f;
static const float TAPER = 0.62f;         // a branch's end to its start, and its children's length to its own
static const float LEAST_RADIUS = 0.004f; // metres: a twig of this or less bears leaves
static const float LEAF = 0.075f;         // metres, a leaf's length
enum { SIDES = 6, LEAVES = 5, TREES = 15 };

typedef struct Woods {
    Mesh *mesh;
    Random random;
    uint32_t bark, leaf[3];
} Woods;

// Two unit vectors across a unit one.
static void across(vec3 along, vec3 *u, vec3 *v)
{
    const vec3 other = fabsf(along[1]) < 0.8f ? vec3_make(0, 1, 0) : vec3_make(1, 0, 0);
    *u = vec3_normalize(vec3_cross(along, other));
    *v = vec3_cross(along, *u);
}

static void limb(Woods *woods, vec3 from, vec3 to, float radius, float end_radius)
{
    const int sides = radius > 10 * LEAST_RADIUS ? 2 * SIDES : radius > 2 * LEAST_RADIUS ? SIDES : SIDES / 2;
    vec3 u, v;
    across(vec3_normalize(to - from), &u, &v);
    uint32_t first = 0;
    for (int i = 0; i < sides; i++) {
        const float turn = 2 * PI * (float)i / (float)sides;
        const vec3 out = cosf(turn) * u + sinf(turn) * v;
        const uint32_t vertex = mesh_add_vertex(woods->mesh, from + radius * out, out);
        mesh_add_vertex(woods->mesh, to + end_radius * out, out);
        first = i == 0 ? vertex : first;
    }
    for (uint32_t i = 0; i < (uint32_t)sides; i++) {
        const uint32_t a = first + 2 * i, b = first + 2 * ((i + 1) % (uint32_t)sides);
        mesh_add_triangle(woods->mesh, a, b, a + 1, woods->bark);
        mesh_add_triangle(woods->mesh, a + 1, b, b + 1, woods->bark);
    }
}

// A rhombus that hangs from `at`, a little folded along its middle.
static void leaf(Woods *woods, vec3 at, vec3 along)
{
    const vec3 way = vec3_normalize(0.7f * along + random_direction(&woods->random) + vec3_make(0, -0.3f, 0));
    const float length = LEAF * random_between(&woods->random, 0.6f, 1.2f);
    vec3 u, v;
    across(way, &u, &v);
    const vec3 tip = at + length * way, middle = at + 0.45f * length * way, fold = 0.08f * length * v;
    const vec3 left = middle + 0.3f * length * u + fold, right = middle - 0.3f * length * u + fold;
    const uint32_t colour = woods->leaf[(int)random_between(&woods->random, 0, 2.999f)];
    mesh_add_flat_triangle(woods->mesh, at, left, tip, colour);
    mesh_add_flat_triangle(woods->mesh, at, tip, right, colour);
}

static void branch(Woods *woods, vec3 from, vec3 along, float length, float radius)
{
    Random *random = &woods->random;
    const float end = TAPER * radius;
    const vec3 bent =
        vec3_normalize(along + 0.18f * random_direction(random) + vec3_make(0, radius > 0.05f ? 0.1f : 0, 0));
    const vec3 middle = from + 0.5f * length * along, to = middle + 0.5f * length * bent;
    limb(woods, from, middle, radius, 0.5f * (radius + end));
    limb(woods, middle, to, 0.5f * (radius + end), end);
    if (end <= LEAST_RADIUS) {
        for (int i = 0; i < LEAVES; i++)
            leaf(woods, middle + random_between(random, 0.1f, 1) * (to - middle), bent);
        return;
    }
    vec3 u, v;
    across(bent, &u, &v);
    const int children = random_between(random, 0, 1) < 0.45f ? 4 : 3;
    const float start = random_between(random, 0, 2 * PI);
    for (int i = 0; i < children; i++) {
        const float turn = start + 2 * PI * (float)i / (float)children + random_between(random, -0.4f, 0.4f);
        const float spread = random_between(random, 0.35f, 0.85f);
        const vec3 way = vec3_normalize(bent + spread * (cosf(turn) * u + sinf(turn) * v));
        const float share = random_between(random, 0.8f, 1.05f);
        branch(woods, middle + random_between(random, 0.4f, 1) * (to - middle), way, share * 0.72f * length,
               share * TAPER * 0.92f * radius);
    }
}

// A ground of low waves, as a closed height field is not needed.
static float ground_at(float x, float z)
{
    return 0.12f * sinf(0.9f * x + 0.4f) * cosf(0.7f * z) + 0.03f * sinf(3.1f * x) * sinf(2.7f * z);
}

static void ground(Mesh *mesh, uint32_t earth)
{
    enum { CELLS = 56 };
    static const float HALF = 7, FAR = 14;
    const uint32_t first = (uint32_t)mesh->vertex_count;
    for (int i = 0; i < (CELLS + 1) * (CELLS + 1); i++) {
        const int column = i % (CELLS + 1), row = i / (CELLS + 1);
        const float x = 2 * HALF * (float)column / CELLS - HALF;
        const float z = FAR * (float)row / CELLS - FAR + 5, step = 0.01f;
        const vec3 normal =
            vec3_normalize(vec3_make(ground_at(x - step, z) - ground_at(x + step, z), 2 * step,
                                     ground_at(x, z - step) - ground_at(x, z + step)));
        mesh_add_vertex(mesh, vec3_make(x, ground_at(x, z), z), normal);
    }
    for (uint32_t i = 0; i < CELLS * CELLS; i++) {
        const uint32_t a = first + i / CELLS * (CELLS + 1) + i % CELLS, b = a + CELLS + 1;
        mesh_add_triangle(mesh, a, b, a + 1, earth);
        mesh_add_triangle(mesh, a + 1, b, b + 1, earth);
    }
}

void make_forest(Scene *scene, uint64_t seed)
{
    const vec3 black = vec3_make(0, 0, 0);
    Woods woods = {.mesh = &scene->mesh, .random = {seed}};
    ground(&scene->mesh, scene_add_material(scene, "earth", vec3_make(0.24f, 0.20f, 0.13f), black));
    woods.bark = scene_add_material(scene, "bark", vec3_make(0.28f, 0.23f, 0.18f), black);
    woods.leaf[0] = scene_add_material(scene, "leaf", vec3_make(0.22f, 0.36f, 0.10f), black);
    woods.leaf[1] = scene_add_material(scene, "young leaf", vec3_make(0.36f, 0.44f, 0.12f), black);
    woods.leaf[2] = scene_add_material(scene, "dry leaf", vec3_make(0.48f, 0.30f, 0.10f), black);
    // In rows, each moved a little, so that no two stand in one another and the lamp's glade stays free.
    for (int i = 0; i < TREES; i++) {
        const int column = i % 5, row = i / 5;
        const float x = -4.8f + 2.4f * (float)column + random_between(&woods.random, -0.7f, 0.7f);
        const float z = -7.2f + 2.6f * (float)row + random_between(&woods.random, -0.6f, 0.6f);
        const vec3 foot = vec3_make(x + (fabsf(x) < 0.7f ? 1.1f : 0), ground_at(x, z) - 0.05f, z);
        const float height = random_between(&woods.random, 1.3f, 1.8f);
        const vec3 lean = vec3_normalize(vec3_make(0, 1, 0) + 0.08f * random_direction(&woods.random));
        branch(&woods, foot, lean, height, 0.075f * height);
    }
    scene_add_light(scene, (Light){.kind = LIGHT_POINT,
                                   .position = vec3_make(0.2f, 2.1f, -5.8f),
                                   .intensity = vec3_make(42, 38, 29)});
    scene->medium = scene_haze(0.16f);
    scene->camera =
        (Camera){vec3_make(-0.5f, 1.2f, 3.6f), vec3_make(0, 1.95f, -3), vec3_make(0, 1, 0), 0.8f, 0, 0};
}
