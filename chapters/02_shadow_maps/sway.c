// sway: see sway.h.
#include "sway.h"
#include <stdlib.h>

static const float MOST_LEAN = 0.05f;
static const float FRAMES_A_PERIOD = 60.0f;

static size_t floats_of(const Mesh *mesh)
{
    return 3 * mesh->vertex_count;
}

Scene sway_begin(const Scene *rest)
{
    Scene scene = *rest;
    scene.mesh.positions = memory_new(floats_of(&rest->mesh) + 1, sizeof(float), "positions that move");
    scene.mesh.normals = memory_new(floats_of(&rest->mesh) + 1, sizeof(float), "normals that move");
    for (size_t i = 0; i < floats_of(&rest->mesh); i++) {
        scene.mesh.positions[i] = rest->mesh.positions[i];
        scene.mesh.normals[i] = rest->mesh.normals[i];
    }
    return scene;
}

void sway_end(Scene *scene)
{
    free(scene->mesh.positions);
    free(scene->mesh.normals);
}

float sway_of_frame(int frame)
{
    return MOST_LEAN * sinf(2.0f * 3.14159265f * (float)frame / FRAMES_A_PERIOD);
}

static void upload(GLuint buffer, const float *data, const Mesh *mesh)
{
    if (mesh->vertex_count > 0)
        gl.NamedBufferSubData(buffer, 0, (GLsizeiptr)(floats_of(mesh) * sizeof(float)), data);
}

uint64_t sway_lean(Scene *scene, const Scene *rest, float lean, const RasterMesh *mesh)
{
    const Mesh *still = &rest->mesh;
    scene->lower = rest->lower, scene->upper = rest->upper;
    for (size_t v = 0; v < still->vertex_count; v++) {
        const float *p = still->positions + 3 * v, *n = still->normals + 3 * v;
        const float x = p[0] + lean * (p[1] - rest->lower[1]);
        scene->mesh.positions[3 * v] = x;
        scene->lower[0] = fminf(scene->lower[0], x);
        scene->upper[0] = fmaxf(scene->upper[0], x);
        // A plane n·p = c stays one under x' = x + lean·y: of normal (n_x, n_y − lean·n_x, n_z).
        const vec3 normal = vec3_normalize(vec3_make(n[0], n[1] - lean * n[0], n[2]));
        for (int k = 0; k < 3; k++)
            scene->mesh.normals[3 * v + (size_t)k] = normal[k];
    }
    upload(mesh->positions, scene->mesh.positions, still);
    upload(mesh->normals, scene->mesh.normals, still);
    return hash_bytes(HASH_START, scene->mesh.positions, floats_of(still) * sizeof(float));
}
