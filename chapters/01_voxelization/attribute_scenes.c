// attribute_scenes: see attribute_scenes.h.
#include "attribute_scenes.h"

enum { SIDE = 16 };

// In a corner's reach of nothing else: inside its voxel, but that the wall's first and last triangles hold the box of 16 m by 16 m by 1 m open.
static void add_triangle(Mesh *mesh, vec3 at, bool first, bool last, uint32_t material)
{
    const vec3 toward_eye = vec3_make(0, 0, 1);
    vec3 corner[3] = {at + vec3_make(0.3f, 0.3f, 0.5f), at + vec3_make(0.7f, 0.3f, 0.5f),
                      at + vec3_make(0.5f, 0.7f, 0.5f)};
    if (first)
        corner[0] = vec3_make(0, 0, 0);
    if (last)
        corner[2] = vec3_make(SIDE, SIDE, 1);
    uint32_t vertex = mesh_add_vertex(mesh, corner[0], toward_eye);
    mesh_add_triangle(mesh, vertex, mesh_add_vertex(mesh, corner[1], toward_eye),
                      mesh_add_vertex(mesh, corner[2], toward_eye), material);
}

void make_averages(Scene *scene, uint64_t seed)
{
    (void)seed;
    const float values[] = {100.5f / 255.0f, 156.5f / 255.0f};
    uint32_t materials[2];
    for (int i = 0; i < 2; i++)
        materials[i] = scene_add_material(scene, i == 0 ? "dark" : "light",
                                          vec3_make(values[i], values[i], values[i]), vec3_make(0, 0, 0));
    for (int voxel = 0; voxel < SIDE * SIDE; voxel++) {
        const int row = voxel / SIDE;
        vec3 at = vec3_make((float)(voxel % SIDE), (float)row, 0);
        const int count = 2 * (voxel + 1), end = voxel + 1 == SIDE * SIDE ? count - 1 : -1;
        for (int i = 0; i < count; i++)
            add_triangle(&scene->mesh, at, voxel == 0 && i == 0, i == end, materials[i % 2]);
    }
    scene_add_light(scene, (Light){.kind = LIGHT_DIRECTIONAL,
                                   .direction = vec3_make(0, 0, -1),
                                   .intensity = vec3_make(2, 2, 2)});
    scene_aim_camera(scene, vec3_make(0, 0, 1), 0.6f);
}
