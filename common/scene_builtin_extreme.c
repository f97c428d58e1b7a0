// scene_builtin_extreme: scenes that break a naive version of a technique.
#include "scene_builtin.h"

#include <stdlib.h>

static const float PI = 3.14159265f;

// A round temple on three steps, eight columns under a cone: about 7 m wide, 6.5 m high, in coordinates that are multiples of 1/16 m, so
// that it keeps its shape 10^6 m from the origin, where float32 has just these.
static void temple(Scene *scene, vec3 offset, float scale)
{
    Mesh parts = {0}, *mesh = &parts;
    const vec3 black = vec3_make(0, 0, 0);
    const uint32_t ground = scene_add_material(scene, "ground", vec3_make(0.30f, 0.36f, 0.22f), black);
    const uint32_t marble = scene_add_material(scene, "marble", vec3_make(0.75f, 0.72f, 0.66f), black);
    const uint32_t step = scene_add_material(scene, "steps", vec3_make(0.50f, 0.44f, 0.38f), black);
    const uint32_t roof = scene_add_material(scene, "roof", vec3_make(0.52f, 0.18f, 0.10f), black);
    const uint32_t gold = scene_add_material(scene, "statue", vec3_make(0.70f, 0.48f, 0.12f), black);
    mesh_add_quad(mesh, vec3_make(-5, 0, -5), vec3_make(0, 0, 10), vec3_make(10, 0, 0), ground);
    const Frame centre = frame_at(black, PI / 16);
    static const vec2 steps[] = {{3.5f, 0},     {3.5f, 0.25f},  {3.125f, 0.25f}, {3.125f, 0.5f},
                                 {2.75f, 0.5f}, {2.75f, 0.75f}, {0, 0.75f}};
    static const vec2 beam[] = {
        {2.0f, 4.0f}, {2.625f, 4.0f}, {2.625f, 4.5f}, {2.875f, 4.5f}, {2.875f, 4.75f}};
    static const vec2 beam_inside[] = {{2.0f, 4.75f}, {2.0f, 4.0f}};
    static const vec2 cone[] = {{2.0f, 4.75f}, {3.0f, 4.75f}, {0.375f, 6.0f}, {0.5f, 6.25f}, {0, 6.75f}};
    static const vec2 column[] = {{0.5f, 0.75f},     {0.5f, 1.0f},  {0.375f, 1.0f},
                                  {0.3125f, 3.625f}, {0.5f, 3.75f}, {0.5f, 4.0f}};
    static const vec2 statue[] = {{0.75f, 0.75f},    {0.75f, 1.25f},    {0.5f, 1.25f},
                                  {0.4375f, 2.0f},   {0.8125f, 2.375f}, {0.9375f, 2.75f},
                                  {0.8125f, 3.125f}, {0.4375f, 3.5f},   {0, 3.625f}};
    frame_revolve(mesh, &centre, steps, 7, 16, step);
    frame_revolve(mesh, &centre, beam, 5, 16, marble);
    frame_revolve(mesh, &centre, beam_inside, 2, 16, marble);
    frame_revolve(mesh, &centre, cone, 5, 16, roof);
    frame_revolve(mesh, &centre, statue, 9, 12, gold);
    for (int i = 0; i < 8; i++) {
        const float turn = PI / 4 * ((float)i + 0.5f);
        const Frame foot = frame_at(vec3_make(2.3f * cosf(turn), 0, 2.3f * sinf(turn)), turn);
        frame_revolve(mesh, &foot, column, 6, 10, marble);
    }
    for (size_t i = 0; i < parts.triangle_count;
         i++) { // rounding turns the faces, so each gets a normal of its own
        vec3 corner[3] = {{0}, {0}, {0}};
        for (size_t k = 0; k < 3; k++)
            for (size_t axis = 0; axis < 3; axis++)
                corner[k][axis] =
                    roundf(16 * parts.positions[3 * (size_t)parts.indices[3 * i + k] + axis]) / 16;
        const vec3 normal = vec3_cross(corner[1] - corner[0], corner[2] - corner[0]);
        uint32_t vertex[3];
        for (int k = 0; k < 3; k++)
            vertex[k] = mesh_add_vertex(&scene->mesh, offset + scale * corner[k], normal);
        mesh_add_triangle(&scene->mesh, vertex[0], vertex[1], vertex[2], parts.triangle_material[i]);
    }
    free(parts.positions);
    free(parts.normals);
    free(parts.indices);
    free(parts.triangle_material);
    scene_add_light(scene, (Light){.kind = LIGHT_DIRECTIONAL,
                                   .direction = vec3_make(0.5f, -0.8f, -0.45f),
                                   .intensity = vec3_make(4.0f, 3.8f, 3.4f)});
    scene_aim_camera(scene, vec3_make(0.35f, 0.3f, 1), 0.75f);
}

void make_huge(Scene *scene, uint64_t seed)
{
    (void)seed;
    temple(scene, vec3_make(1e6f, 1e6f, -1e6f), 1);
}

void make_tiny(Scene *scene, uint64_t seed)
{
    (void)seed;
    temple(scene, vec3_make(0, 0, 0), 1e-6f);
}

static uint32_t coloured(Scene *scene, const char *name, Random *random)
{
    const float hue = random_between(random, 0, 2 * PI); // around the grey axis
    const vec3 albedo =
        vec3_make(0.5f + 0.3f * cosf(hue), 0.5f + 0.3f * cosf(hue - 2.1f), 0.5f + 0.3f * cosf(hue + 2.1f));
    return scene_add_material(scene, name, albedo, vec3_make(0, 0, 0));
}

static void light_from_above(Scene *scene)
{
    scene_add_light(
        scene,
        (Light){.kind = LIGHT_POINT, .position = vec3_make(-1, 2.5f, 2), .intensity = vec3_make(40, 40, 40)});
}

// Within 1 m of the origin, longest edge about 1 m, height down to 10^-6 of it, log-uniform; turned any way.
void make_slivers(Scene *scene, uint64_t seed)
{
    enum { SLIVERS = 2000, MATERIALS = 8 };
    Random random = {seed};
    for (int i = 0; i < MATERIALS; i++)
        coloured(scene, "sliver", &random);
    for (int i = 0; i < SLIVERS; i++) {
        const vec3 along = random_direction(&random),
                   middle = random_between(&random, 0, 0.5f) * random_direction(&random);
        const vec3 across = vec3_normalize(vec3_cross(along, random_direction(&random)));
        const float aspect = powf(10, i == 0 ? 6 : random_between(&random, 0, 6));
        const vec3 tip = middle + random_between(&random, -0.4f, 0.4f) * along + across / aspect;
        mesh_add_flat_triangle(&scene->mesh, middle - 0.5f * along, middle + 0.5f * along, tip,
                               (uint32_t)(i % MATERIALS));
    }
    light_from_above(scene);
    scene_aim_camera(scene, vec3_make(0.4f, 0.3f, 1), 0.7f);
}

// A staircase of good boxes among broken triangles: to points, to lines (two or all corners distinct), twice the same, turned over.
void make_degenerate(Scene *scene, uint64_t seed)
{
    enum { BOXES = 6, BROKEN = 40 };
    Random random = {seed};
    Mesh *mesh = &scene->mesh;
    for (int i = 0; i < BOXES; i++) {
        const float x = -1 + 2 * (float)i / BOXES;
        mesh_add_box(mesh, vec3_make(x, 0, -0.5f), vec3_make(x + 2.0f / BOXES, 0.25f * (float)(i + 1), 0.5f),
                     coloured(scene, "box", &random));
    }
    const size_t good = mesh->triangle_count;
    for (size_t i = 0; i < BROKEN; i++) {
        const uint32_t *index = mesh->indices + 3 * (i % good), a = index[0], b = index[1], c = index[2];
        mesh_add_triangle(mesh, a, b, c, 0); // a duplicate: good, but twice
        mesh_add_triangle(mesh, a, c, b, 0); // the same from behind, over shared edges
        mesh_add_triangle(mesh, a, a, a, 0); // a point
        mesh_add_triangle(mesh, b, b, c, 0); // an edge
        const float *p = mesh->positions + 3 * (size_t)a, *q = mesh->positions + 3 * (size_t)b;
        const vec3 from = vec3_make(p[0], p[1], p[2]), to = vec3_make(q[0], q[1], q[2]);
        mesh_add_triangle(mesh, a, b, mesh_add_vertex(mesh, 2 * to - from, vec3_make(0, 1, 0)),
                          0); // three points on a line
    }
    light_from_above(scene);
    scene_aim_camera(scene, vec3_make(0.4f, 0.5f, 1), 0.7f);
}

// A sheet of coloured triangles of many shapes, all in the plane z = 0.
void make_planar(Scene *scene, uint64_t seed)
{
    enum { CELLS = 8, MATERIALS = 6 };
    Random random = {seed};
    for (int i = 0; i < MATERIALS; i++)
        coloured(scene, "planar", &random);
    vec3 points[CELLS + 1][CELLS + 1];
    for (int j = 0; j <= CELLS; j++)
        for (int i = 0; i <= CELLS; i++) {
            const float jitter = i % CELLS && j % CELLS ? 0.09f : 0;
            points[j][i] = vec3_make(-1 + 2 * (float)i / CELLS + random_between(&random, -jitter, jitter),
                                     2 * (float)j / CELLS + random_between(&random, -jitter, jitter), 0);
        }
    for (int j = 0; j < CELLS; j++)
        for (int i = 0; i < CELLS; i++) {
            const vec3 a = points[j][i], b = points[j][i + 1], c = points[j + 1][i + 1], d = points[j + 1][i];
            mesh_add_flat_triangle(&scene->mesh, a, b, c, (uint32_t)((i + j) % MATERIALS));
            mesh_add_flat_triangle(&scene->mesh, a, c, d, (uint32_t)((i + 2 * j + 1) % MATERIALS));
        }
    light_from_above(scene);
    scene_aim_camera(scene, vec3_make(0.3f, 0.2f, 1), 0.7f);
}
