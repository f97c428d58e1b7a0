// scenes_hard: see scenes_hard.h.
#include "scenes_hard.h"

static uint32_t begin(Scene *scene)
{
    scene_add_light(scene, (Light){.kind = LIGHT_DIRECTIONAL,
                                   .direction = vec3_normalize(vec3_make(-0.4f, -1.0f, -0.6f)),
                                   .intensity = vec3_make(2.5f, 2.4f, 2.2f)});
    return scene_add_material(scene, "clay", vec3_make(0.7f, 0.6f, 0.55f), vec3_make(0, 0, 0));
}

static void add_triangle(Mesh *mesh, vec3 a, vec3 b, vec3 c, uint32_t material)
{
    const vec3 from_triangle = {0};
    uint32_t first = mesh_add_vertex(mesh, a, from_triangle);
    mesh_add_triangle(mesh, first, mesh_add_vertex(mesh, b, from_triangle),
                      mesh_add_vertex(mesh, c, from_triangle), material);
}

// Two triangles in the first and last voxel of a box of 16 m hold it open.
static void add_grains(Scene *scene, uint32_t material)
{
    vec3 origin = {0}, end = vec3_make(16, 16, 16), x = vec3_make(0.125f, 0, 0), y = vec3_make(0, 0.125f, 0);
    add_triangle(&scene->mesh, origin, origin + x, origin + y, material);
    add_triangle(&scene->mesh, end, end - x, end - y, material);
}

void scenes_make_point(Scene *scene, uint64_t seed)
{
    (void)seed;
    vec3 p = vec3_make(1, 2, 3);
    add_triangle(&scene->mesh, p, p, p, begin(scene));
}

static void add_tetrahedron(Mesh *mesh, vec3 p, float side, uint32_t material)
{
    vec3 x = p + vec3_make(side, 0, 0), y = p + vec3_make(0, side, 0), z = p + vec3_make(0, 0, side);
    add_triangle(mesh, p, y, x, material);
    add_triangle(mesh, p, z, y, material);
    add_triangle(mesh, p, x, z, material);
    add_triangle(mesh, x, y, z, material);
}

void scenes_make_speck(Scene *scene, uint64_t seed)
{
    (void)seed;
    uint32_t material = begin(scene);
    add_grains(scene, material);
    add_tetrahedron(&scene->mesh, vec3_make(8.4f, 7.3f, 5.6f), 0.125f, material);
}

void scenes_make_crowd(Scene *scene, uint64_t seed)
{
    (void)seed;
    enum { SIDE = 63 }; // 63³ tetrahedra are 1 000 188 triangles
    uint32_t material = begin(scene);
    add_grains(scene, material);
    for (int i = 0; i < SIDE * SIDE * SIDE; i++) {
        const int place[3] = {i % SIDE, i / SIDE % SIDE, i / SIDE / SIDE};
        vec3 p = vec3_make(8.25f, 8.25f, 8.25f);
        for (int k = 0; k < 3; k++)
            p[k] += (float)place[k] * 0x1p-7f;
        add_tetrahedron(&scene->mesh, p, 0x1p-8f, material);
    }
}

// The third corner lies in the middle of a voxel that the edge touches.
void scenes_make_edge(Scene *scene, uint64_t seed)
{
    (void)seed;
    uint32_t material = begin(scene);
    add_grains(scene, material);
    add_triangle(&scene->mesh, vec3_make(4, 4, 4), vec3_make(12, 4, 4), vec3_make(8.5f, 4.5f, 4.5f),
                 material);
}

void scenes_make_beam(Scene *scene, uint64_t seed)
{
    (void)seed;
    mesh_add_box(&scene->mesh, vec3_make(0, 0, 0), vec3_make(3, 500, 7), begin(scene));
}

// Each face of an octahedron in `parts`² triangles, their corners moved out to a ball of 7.5 m.
static void make_sphere(Scene *scene, uint32_t parts)
{
    const uint32_t material = begin(scene);
    for (int face = 0; face < 8; face++) {
        const vec3 sign =
            vec3_make(face & 1 ? -1.0f : 1.0f, face & 2 ? -1.0f : 1.0f, face & 4 ? -1.0f : 1.0f);
        const uint32_t first = (uint32_t)scene->mesh.vertex_count,
                       turn = (uint32_t)(face ^ face >> 1 ^ face >> 2) & 1;
        for (uint32_t i = 0; i <= parts; i++)
            for (uint32_t j = 0; j <= i; j++) { // row i of i + 1 corners
                vec3 out = vec3_normalize(sign * vec3_make((float)(parts - i), (float)(i - j), (float)j));
                mesh_add_vertex(&scene->mesh, vec3_make(8, 8, 8) + 7.5f * out, out);
            }
        for (uint32_t i = 0; i < parts; i++)
            for (uint32_t j = 0; j <= 2 * i; j++) {
                const uint32_t above = first + i * (i + 1) / 2 + j / 2, below = above + i + 1;
                // pointing up: above, below, below + 1; pointing down: above, below + 1, above + 1
                const uint32_t second = j % 2 ? below + 1 : below, third = j % 2 ? above + 1 : below + 1;
                mesh_add_triangle(&scene->mesh, above, turn ? third : second, turn ? second : third,
                                  material);
            }
    }
}

void scenes_make_sphere_1000(Scene *scene, uint64_t seed)
{
    (void)seed;
    make_sphere(scene, 11);
}

void scenes_make_sphere_10000(Scene *scene, uint64_t seed)
{
    (void)seed;
    make_sphere(scene, 35);
}

void scenes_make_sphere_100000(Scene *scene, uint64_t seed)
{
    (void)seed;
    make_sphere(scene, 112);
}

void scenes_make_sphere_1000000(Scene *scene, uint64_t seed)
{
    (void)seed;
    make_sphere(scene, 354);
}
