// cell24: see cell24.h.
#include "cell24.h"
#include "scene_builtin.h"

#include <stdlib.h>
#include <string.h>

enum { CORNERS = 24, SIDES = 12, ALONG = 12, RINGS = 8 }; // a rod's sides and pieces; a ball's rings
static const float PI = 3.14159265f;
static const float EYE = 2.6f;               // along w, from which three dimensions are seen
static const float SIZE = 0.8f;              // metres a unit at w = 0
static const float ROD = 0.05f, BALL = 0.1f; // radii at w = 0, units
static const float TURN_A_FRAME = 0.0131f;   // radians

typedef struct Corner {
    vec3 at;
    float scale; // metres a unit here: what is nearer along w is seen larger
} Corner;

static void rotate(vec4 *p, int i, int j, float turn)
{
    const float a = (*p)[i], b = (*p)[j];
    (*p)[i] = cosf(turn) * a - sinf(turn) * b;
    (*p)[j] = sinf(turn) * a + cosf(turn) * b;
}

// Two turns at once, in planes that share no axis, as only four dimensions allow; and a lean, so that no edge points at the eye.
static Corner project(vec4 p, int frame)
{
    const float turn = TURN_A_FRAME * (float)frame;
    rotate(&p, 0, 1, 0.4f);
    rotate(&p, 1, 2, 0.5f);
    rotate(&p, 0, 3, 0.3f + turn);
    rotate(&p, 1, 2, turn * 0.62f);
    const float scale = SIZE * EYE / (EYE - p[3]);
    return (Corner){scale * vec3_make(p[0], p[1], p[2]), scale};
}

static void add_ball(Mesh *mesh, Corner corner, uint32_t material)
{
    vec2 profile[RINGS + 1];
    for (int i = 0; i <= RINGS; i++) {
        const float turn = PI * (float)i / RINGS, radius = BALL * corner.scale;
        profile[i] = (vec2){i == 0 || i == RINGS ? 0.0f : radius * sinf(turn), -radius * cosf(turn)};
    }
    const Frame centre = frame_at(corner.at, 0);
    frame_revolve(mesh, &centre, profile, RINGS + 1, 2 * RINGS, material);
}

// Straight in four dimensions is straight in three; its thickness follows 1/(EYE − w), which is linear along it as seen there.
static void add_rod(Mesh *mesh, Corner a, Corner b, uint32_t material)
{
    const vec3 along = vec3_normalize(b.at - a.at);
    const vec3 other = fabsf(along[1]) < 0.8f ? vec3_make(0, 1, 0) : vec3_make(1, 0, 0);
    const vec3 u = vec3_normalize(vec3_cross(along, other)), v = vec3_cross(along, u);
    const uint32_t first = (uint32_t)mesh->vertex_count;
    for (int i = 0; i <= ALONG; i++)
        for (int side = 0; side < SIDES; side++) {
            const float share = (float)i / ALONG, turn = 2 * PI * (float)side / SIDES;
            const vec3 out = cosf(turn) * u + sinf(turn) * v;
            const float radius = ROD * (a.scale + share * (b.scale - a.scale));
            mesh_add_vertex(mesh, a.at + share * (b.at - a.at) + radius * out, out);
        }
    for (uint32_t i = 0; i < ALONG * SIDES; i++) {
        const uint32_t p = first + i, q = first + i / SIDES * SIDES + (i + 1) % SIDES;
        mesh_add_triangle(mesh, p, q, p + SIDES, material);
        mesh_add_triangle(mesh, p + SIDES, q, q + SIDES, material);
    }
}

// Corners are all (±1, ±1, 0, 0) in any order of places; an edge joins two that are √2 apart: 96 edges.
static void add_body(Mesh *mesh, int frame, uint32_t material)
{
    vec4 corner[CORNERS];
    int count = 0;
    for (int i = 0; i < 4; i++)
        for (int j = i + 1; j < 4; j++)
            for (int sign = 0; sign < 4; sign++) {
                corner[count] = (vec4){0, 0, 0, 0};
                corner[count][i] = sign & 1 ? 1.0f : -1.0f;
                corner[count++][j] = sign & 2 ? 1.0f : -1.0f;
            }
    for (int i = 0; i < CORNERS; i++) {
        add_ball(mesh, project(corner[i], frame), material);
        for (int j = i + 1; j < CORNERS; j++) {
            const vec4 d = corner[i] - corner[j];
            const float apart2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2] + d[3] * d[3];
            if (apart2 < 2.5f)
                add_rod(mesh, project(corner[i], frame), project(corner[j], frame), material);
        }
    }
}

void cell24_make(Scene *scene, uint64_t seed)
{
    (void)seed;
    const vec3 black = vec3_make(0, 0, 0);
    const uint32_t brass = scene_add_material(scene, "brass", vec3_make(0.66f, 0.55f, 0.32f), black);
    const uint32_t slate = scene_add_material(scene, "slate", vec3_make(0.36f, 0.38f, 0.42f), black);
    add_body(&scene->mesh, 0, brass); // first: its vertices are those that move
    mesh_add_box(&scene->mesh, vec3_make(-6, -2.2f, -5), vec3_make(6, -2.05f, 4), slate);
    scene_add_light(scene, (Light){.kind = LIGHT_POINT,
                                   .position = vec3_make(0.25f, 0.3f, -2.1f),
                                   .intensity = vec3_make(18, 17, 15)});
    scene->medium = scene_haze(0.12f);
    scene->camera =
        (Camera){vec3_make(-0.9f, 0.7f, 5.2f), vec3_make(0.05f, 0.05f, 0), vec3_make(0, 1, 0), 0.75f, 0, 0};
}

static size_t floats_of(const Mesh *mesh)
{
    return 3 * mesh->vertex_count;
}

Scene cell24_begin(const Scene *rest)
{
    Scene scene = *rest;
    scene.mesh.positions = memory_new(floats_of(&rest->mesh), sizeof(float), "positions that move");
    scene.mesh.normals = memory_new(floats_of(&rest->mesh), sizeof(float), "normals that move");
    memcpy(scene.mesh.positions, rest->mesh.positions, floats_of(&rest->mesh) * sizeof(float));
    memcpy(scene.mesh.normals, rest->mesh.normals, floats_of(&rest->mesh) * sizeof(float));
    return scene;
}

void cell24_end(Scene *scene)
{
    free(scene->mesh.positions);
    free(scene->mesh.normals);
}

uint64_t cell24_turn(Scene *scene, int frame, const RasterMesh *mesh)
{
    Mesh moved = {0};
    add_body(&moved, frame, 0);
    const size_t bytes = floats_of(&moved) * sizeof(float);
    memcpy(scene->mesh.positions, moved.positions, bytes);
    memcpy(scene->mesh.normals, moved.normals, bytes);
    scene_bounds(&scene->mesh, &scene->lower, &scene->upper);
    gl.NamedBufferSubData(mesh->positions, 0, (GLsizeiptr)bytes, moved.positions);
    gl.NamedBufferSubData(mesh->normals, 0, (GLsizeiptr)bytes, moved.normals);
    const uint64_t hash = hash_bytes(HASH_START, moved.positions, bytes);
    free(moved.positions);
    free(moved.normals);
    free(moved.indices);
    free(moved.triangle_material);
    return hash;
}
