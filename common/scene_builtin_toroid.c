// scene_builtin_toroid: a ring of seven saddles, after Séquin's Heptoroid: Scherk's tower of four sheets that meet, bent to a ring and twisted by
// 135°, a shell of finite thickness. It is closed and has 22 handles: rays of a light near it come through dozens of holes.
//
// The surface is where `shell` is 0, found by marching tetrahedra (Doi and Koide 1991) in a grid around the ring: it closes by construction.
#include "scene_builtin.h"

#include <stdlib.h>

enum { AROUND = 7 * 24, ACROSS = 36, CORNERS = ACROSS + 1, STEPS = 7 };
static const float PI = 3.14159265f;
static const float RING = 1.0f, TUBE = 0.58f; // radii, metres
static const float NECK = 0.66f;              // how near the sheets come to the ring's middle line, of TUBE
static const float HALF_THICKNESS = 0.042f;   // metres
static const float MARGIN = 0.66f;            // half the side of the grid's cross-section, metres

typedef struct Shell {
    float *value; // (AROUND, CORNERS, CORNERS): below 0 inside
    uint32_t *
        vertex; // STEPS a point: the surface's vertex on the edge that goes from it by (step & 1, step >> 1 & 1, step >> 2) + 1
    Mesh *mesh;
    uint32_t material;
} Shell;

// Distance to the sheets Re(z⁴) = NECK⁴ sin(7ψ/2), which a turn of 135° in all brings back to themselves after one round; cut off at TUBE.
static float shell(float turn, float p, float q)
{
    const float twist = 0.375f * turn, c = cosf(twist) / TUBE, s = sinf(twist) / TUBE;
    const float x = c * p + s * q, y = c * q - s * p, r2 = x * x + y * y;
    const float x2 = x * x - y * y, y2 = 2 * x * y, neck = NECK * NECK * NECK * NECK;
    const float height = x2 * x2 - y2 * y2 - neck * sinf(3.5f * turn);
    const float around = RING + p, slope = 4 * r2 * sqrtf(r2) / TUBE, along = 3.5f * neck / around;
    const float sheet = fabsf(height) / sqrtf(slope * slope + along * along + 1e-6f) - HALF_THICKNESS;
    const float rim = TUBE * (sqrtf(r2) - 1);
    // a rounded corner where the two meet
    const float round = 0.03f, blend = fmaxf(round - fabsf(sheet - rim), 0) / round;
    return fmaxf(sheet, rim) + 0.25f * round * blend * blend;
}

static vec3 place(float around, float across, float up)
{
    const float turn = 2 * PI * around / AROUND, size = 2 * MARGIN / ACROSS;
    const float radius = RING - MARGIN + size * across;
    return vec3_make(radius * cosf(turn), radius * sinf(turn), size * up - MARGIN);
}

static size_t index_of(const int at[3])
{
    return ((size_t)(at[0] % AROUND) * CORNERS + (size_t)at[1]) * CORNERS + (size_t)at[2];
}

// The vertex between a corner and the one `step` farther, made when first asked for. It keeps off the corners, so no triangle is without area.
static uint32_t vertex_on(const Shell *s, const int from[3], const int to[3])
{
    int step = 0;
    for (int k = 0; k < 3; k++)
        step |= (to[k] - from[k]) << k;
    uint32_t *vertex = &s->vertex[STEPS * index_of(from) + (size_t)step - 1];
    if (*vertex == 0) {
        const float a = s->value[index_of(from)], b = s->value[index_of(to)];
        const float share = fminf(fmaxf(a / (a - b), 0.04f), 0.96f);
        const vec3 at = place((float)from[0] + share * (float)(to[0] - from[0]),
                              (float)from[1] + share * (float)(to[1] - from[1]),
                              (float)from[2] + share * (float)(to[2] - from[2]));
        *vertex = 1 + mesh_add_vertex(s->mesh, at, vec3_make(0, 0, 0));
    }
    return *vertex - 1;
}

// One of the six tetrahedra that share a cell's diagonal; its corners rise, so that each edge goes the same way in all cells.
static void tetrahedron(const Shell *s, const int corner[4][3], bool mirrored)
{
    int inside[4], outside[4], in = 0, out = 0;
    for (int i = 0; i < 4; i++) {
        if (s->value[index_of(corner[i])] < 0)
            inside[in++] = i;
        else
            outside[out++] = i;
    }
    if (in == 0 || out == 0)
        return;
    // Corners a, b | c, d: the surface cuts the edges between the two sides in three or four vertices, in turn.
    int order[4] = {0}, cuts = 0;
    uint32_t cut[4];
    for (int i = 0; i < in; i++)
        order[i] = inside[i];
    for (int i = 0; i < out; i++)
        order[in + i] = outside[i];
    for (int i = 0; i < in; i++)
        for (int j = 0; j < out; j++) {
            const int o = in == 2 && i == 1 ? 1 - j : j, a = inside[i], b = outside[o];
            cut[cuts++] = vertex_on(s, corner[a < b ? a : b], corner[a < b ? b : a]);
        }
    // Whether the corners, insides first, are an odd permutation: it and the tetrahedron's own side say which way is out.
    bool odd = !mirrored; // since (around, across, up) is left-handed
    for (int i = 0; i < 4; i++)
        for (int j = i + 1; j < 4; j++)
            odd ^= order[i] > order[j];
    for (int i = 0; i + 2 < cuts; i++)
        mesh_add_triangle(s->mesh, cut[0], cut[odd ? i + 2 : i + 1], cut[odd ? i + 1 : i + 2], s->material);
}

static void march(const Shell *s)
{
    static const int ways[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    static const bool mirrored[6] = {false, true, true, false, false, true};
    for (int i = 0; i < AROUND * ACROSS * ACROSS; i++)
        for (int way = 0; way < 6; way++) {
            int corner[4][3] = {{i / (ACROSS * ACROSS), i / ACROSS % ACROSS, i % ACROSS}};
            for (int c = 1; c < 4; c++)
                for (int k = 0; k < 3; k++)
                    corner[c][k] = corner[c - 1][k] + (ways[way][c - 1] == k);
            tetrahedron(s, (const int(*)[3])corner, mirrored[way]);
        }
}

// Each vertex gets the sum of its triangles' areas, as vectors.
static void smooth(Mesh *mesh)
{
    for (size_t i = 0; i < mesh->triangle_count; i++) {
        const uint32_t *corner = mesh->indices + 3 * i;
        vec3 p[3];
        for (size_t k = 0; k < 3; k++) {
            const float *at = mesh->positions + 3 * (size_t)corner[k];
            p[k] = vec3_make(at[0], at[1], at[2]);
        }
        const vec3 area = vec3_cross(p[1] - p[0], p[2] - p[0]);
        for (size_t k = 0; k < 9; k++)
            mesh->normals[3 * (size_t)corner[k / 3] + k % 3] += area[k % 3];
    }
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        float *n = mesh->normals + 3 * i;
        const vec3 unit = vec3_normalize(vec3_make(n[0], n[1], n[2]));
        n[0] = unit[0], n[1] = unit[1], n[2] = unit[2];
    }
}

void make_toroid(Scene *scene, uint64_t seed)
{
    (void)seed;
    const vec3 black = vec3_make(0, 0, 0);
    const size_t points = (size_t)AROUND * CORNERS * CORNERS;
    Shell s = {.value = memory_new(points, sizeof(float), "the toroid's field"),
               .vertex = memory_new(STEPS * points, sizeof(uint32_t), "the toroid's vertices"),
               .mesh = &scene->mesh,
               .material = scene_add_material(scene, "bronze", vec3_make(0.62f, 0.45f, 0.28f), black)};
    for (int i = 0; i < (int)points; i++) {
        const int turn = i / (CORNERS * CORNERS), row = i / CORNERS % CORNERS, column = i % CORNERS;
        s.value[i] = shell(2 * PI * (float)turn / AROUND, 2 * MARGIN * (float)row / ACROSS - MARGIN,
                           2 * MARGIN * (float)column / ACROSS - MARGIN);
    }
    march(&s);
    smooth(&scene->mesh);
    free(s.value);
    free(s.vertex);
    const uint32_t stone = scene_add_material(scene, "stone", vec3_make(0.5f, 0.52f, 0.55f), black);
    mesh_add_box(&scene->mesh, vec3_make(-5, -1.8f, -3.5f), vec3_make(5, -1.65f, 3.5f), stone);
    scene_add_light(scene, (Light){.kind = LIGHT_POINT,
                                   .position = vec3_make(0.12f, 0.1f, -0.75f),
                                   .intensity = vec3_make(16, 14.5f, 12)});
    scene->medium = scene_haze(0.12f);
    scene->camera =
        (Camera){vec3_make(1.3f, 0.9f, 5.2f), vec3_make(0, -0.05f, 0), vec3_make(0, 1, 0), 0.72f, 0, 0};
}
