// scene_validate: the rule by which broken data is refused and useless triangles are dropped.
#include "scene_builtin.h"

#include <stdlib.h>
#include <string.h>

// The difference of two float32 coordinates and the area must not be rounded away.
typedef double Double3 __attribute__((vector_size(32)));

static Double3 corner(const Mesh *mesh, uint32_t vertex)
{
    const float *p = mesh->positions + 3 * (size_t)vertex;
    return (Double3){(double)p[0], (double)p[1], (double)p[2]};
}

static double length(Double3 a)
{
    return hypot(hypot(a[0], a[1]), a[2]);
}

// A triangle has no area where |u × v| ≤ 2^-50 · longest edge²: that is what rounding in double can make of three points on one line (two
// products and their difference, each within 2^-53, in three components). All flatter than aspect 10^15 goes, any sliver of 10^6 stays.
static const double ZERO_AREA = 0x1p-50;

// The unit normal; false where the triangle has no area.
static bool triangle_normal(const Mesh *mesh, const uint32_t *index, float normal[3])
{
    const Double3 a = corner(mesh, index[0]), b = corner(mesh, index[1]), c = corner(mesh, index[2]);
    const Double3 u = b - a, v = c - a;
    const Double3 cross = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    const double longest = fmax(fmax(length(u), length(v)), length(c - b));
    const double area = length(cross);
    for (int axis = 0; axis < 3; axis++)
        normal[axis] = (float)(area > 0 ? cross[axis] / area : 0);
    return area > ZERO_AREA * longest * longest;
}

bool scene_bounds(const Mesh *mesh, vec3 *lower, vec3 *upper)
{
    bool any = false;
    *lower = vec3_make(-0.5f, -0.5f, -0.5f), *upper = vec3_make(0.5f, 0.5f, 0.5f);
    for (size_t i = 0; i < 3 * mesh->triangle_count; i++) {
        if (mesh->indices[i] >= mesh->vertex_count)
            continue;
        const float *p = mesh->positions + 3 * (size_t)mesh->indices[i];
        const vec3 point = vec3_make(p[0], p[1], p[2]);
        if (!vec3_is_finite(point))
            continue;
        *lower = any ? vec3_min(*lower, point) : point;
        *upper = any ? vec3_max(*upper, point) : point;
        any = true;
    }
    return any;
}

static char *refuse_broken(Scene *scene)
{
    const Mesh *mesh = &scene->mesh;
    SceneReport *report = &scene->report;
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        const float *p = mesh->positions + 3 * i;
        report->nonfinite_vertices += !vec3_is_finite(vec3_make(p[0], p[1], p[2]));
    }
    for (size_t i = 0; i < 3 * mesh->triangle_count; i++)
        report->bad_indices += mesh->indices[i] >= mesh->vertex_count;
    if (report->nonfinite_vertices > 0)
        return text_format("%zu of %zu vertices are NaN or infinite", report->nonfinite_vertices,
                           mesh->vertex_count);
    if (report->bad_indices > 0)
        return text_format("%zu of %zu indices are past the last of %zu vertices", report->bad_indices,
                           3 * mesh->triangle_count, mesh->vertex_count);
    return NULL;
}

// Normals become unit length. One that is zero or not finite becomes that of the triangle; where several triangles share the vertex,
// the first keeps it and each other one gets a copy of its own, so that every corner ends with its own triangle's normal.
static void repair_normals(Scene *scene)
{
    Mesh *mesh = &scene->mesh;
    const size_t given = mesh->vertex_count;
    enum { GOOD, BAD, TAKEN };
    unsigned char *state = memory_new(given + 1, 1, "normals");
    for (size_t i = 0; i < given; i++) {
        float *n = mesh->normals + 3 * i;
        const Double3 normal = {(double)n[0], (double)n[1], (double)n[2]};
        const double size = length(normal);
        state[i] = size > 0 && isfinite(size) ? GOOD : BAD;
        for (int axis = 0; axis < 3; axis++) // BAD and in no triangle: up, so that all are unit
            n[axis] = state[i] == GOOD ? (float)(normal[axis] / size) : axis == 1;
    }
    for (size_t i = 0; i < mesh->triangle_count; i++) {
        float own[3];
        triangle_normal(mesh, mesh->indices + 3 * i, own);
        for (size_t corner = 3 * i; corner < 3 * i + 3; corner++) {
            const uint32_t vertex = mesh->indices[corner];
            if (vertex >= given || state[vertex] == GOOD)
                continue;
            float *normal = mesh->normals + 3 * (size_t)vertex;
            if (state[vertex] == TAKEN && memcmp(normal, own, sizeof own) == 0)
                continue;
            const float *p = mesh->positions + 3 * (size_t)vertex;
            if (state[vertex] == TAKEN)
                mesh->indices[corner] =
                    mesh_add_vertex(mesh, vec3_make(p[0], p[1], p[2]), vec3_make(own[0], own[1], own[2]));
            else
                memcpy(normal, own, sizeof own);
            state[vertex] = TAKEN;
            scene->report.repaired_normals++;
        }
    }
    free(state);
}

char *scene_validate(Scene *scene, bool may_be_empty)
{
    Mesh *mesh = &scene->mesh;
    scene->report = (SceneReport){.other_primitives = scene->report.other_primitives};
    char *refused = refuse_broken(scene);
    if (refused)
        return refused;
    size_t kept = 0;
    for (size_t i = 0; i < mesh->triangle_count; i++) {
        float normal[3];
        if (!triangle_normal(mesh, mesh->indices + 3 * i, normal))
            continue;
        memmove(mesh->indices + 3 * kept, mesh->indices + 3 * i, 3 * sizeof *mesh->indices);
        mesh->triangle_material[kept++] = mesh->triangle_material[i];
    }
    scene->report.zero_area_triangles = mesh->triangle_count - kept;
    mesh->triangle_count = kept;
    if (kept == 0 && !may_be_empty)
        return text_format("it has no triangle with an area (%zu without, %zu points and lines)",
                           scene->report.zero_area_triangles, scene->report.other_primitives);
    repair_normals(scene);
    if (!scene_bounds(mesh, &scene->lower, &scene->upper))
        scene->lower = scene->upper = vec3_make(0, 0, 0);
    return NULL;
}

char *scene_report_text(const Scene *scene)
{
    const SceneReport *report = &scene->report;
    if (report->zero_area_triangles + report->repaired_normals + report->other_primitives == 0)
        return NULL;
    return text_format("%s: dropped %zu triangles without area and %zu points and lines; gave %zu vertices "
                       "their triangle's normal",
                       scene->name, report->zero_area_triangles, report->other_primitives,
                       report->repaired_normals);
}
