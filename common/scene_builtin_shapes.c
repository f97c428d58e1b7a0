// scene_builtin_shapes: the building blocks of the generators.
#include "scene_builtin.h"

#include <string.h>

uint32_t scene_add_material(Scene *scene, const char *name, vec3 albedo, vec3 emission)
{
    const size_t index = scene->material_count++;
    scene->materials = memory_grow(scene->materials, scene->material_count, sizeof(Material), "materials");
    scene->materials[index] = (Material){text_format("%s", name), albedo, emission};
    return (uint32_t)index;
}

void scene_add_light(Scene *scene, Light light)
{
    scene->lights = memory_grow(scene->lights, scene->light_count + 1, sizeof(Light), "lights");
    scene->lights[scene->light_count++] = light;
}

uint32_t mesh_add_vertex(Mesh *mesh, vec3 position, vec3 normal)
{
    if (mesh->vertex_count == UINT32_MAX)
        fail_work("a scene has more than 2^32 - 1 vertices");
    if (mesh->vertex_count == mesh->vertex_capacity) {
        mesh->vertex_capacity = mesh->vertex_capacity ? 2 * mesh->vertex_capacity : 1024;
        mesh->positions = memory_grow(mesh->positions, mesh->vertex_capacity, 12, "vertex positions");
        mesh->normals = memory_grow(mesh->normals, mesh->vertex_capacity, 12, "vertex normals");
    }
    for (size_t axis = 0; axis < 3; axis++) {
        mesh->positions[3 * mesh->vertex_count + axis] = position[axis];
        mesh->normals[3 * mesh->vertex_count + axis] = normal[axis];
    }
    return (uint32_t)mesh->vertex_count++;
}

void mesh_add_triangle(Mesh *mesh, uint32_t a, uint32_t b, uint32_t c, uint32_t material)
{
    if (mesh->triangle_count == mesh->triangle_capacity) {
        mesh->triangle_capacity = mesh->triangle_capacity ? 2 * mesh->triangle_capacity : 1024;
        mesh->indices = memory_grow(mesh->indices, mesh->triangle_capacity, 12, "triangles");
        mesh->triangle_material =
            memory_grow(mesh->triangle_material, mesh->triangle_capacity, 4, "triangles' materials");
    }
    memcpy(mesh->indices + 3 * mesh->triangle_count, (uint32_t[]){a, b, c}, 12);
    mesh->triangle_material[mesh->triangle_count++] = material;
}

void mesh_add_quad(Mesh *mesh, vec3 corner, vec3 edge_u, vec3 edge_v, uint32_t material)
{
    const vec3 normal = vec3_cross(vec3_normalize(edge_u), vec3_normalize(edge_v));
    const uint32_t first = mesh_add_vertex(mesh, corner, normal);
    mesh_add_vertex(mesh, corner + edge_u, normal);
    mesh_add_vertex(mesh, corner + edge_u + edge_v, normal);
    mesh_add_vertex(mesh, corner + edge_v, normal);
    mesh_add_triangle(mesh, first, first + 1, first + 2, material);
    mesh_add_triangle(mesh, first, first + 2, first + 3, material);
}

void mesh_add_box(Mesh *mesh, vec3 lower, vec3 upper, uint32_t material)
{
    const Frame world = frame_at(vec3_make(0, 0, 0), 0);
    frame_box(mesh, &world, lower, upper, material);
}

void scene_aim_camera(Scene *scene, vec3 direction, float vertical_fov_rad)
{
    vec3 lower, upper;
    scene_bounds(&scene->mesh, &lower, &upper);
    const vec3 centre = lower + 0.5f * (upper - lower), half = 0.5f * (upper - lower);
    const vec3 back = vec3_normalize(direction), up = vec3_make(0, 1, 0);
    vec3 right = vec3_normalize(vec3_cross(up, back));
    if (vec3_length(right) < 0.5f) // straight from above or below
        right = vec3_make(1, 0, 0);
    const vec3 upright = vec3_cross(back, right);
    float distance = 0; // the least from which a square picture holds all eight corners
    for (int corner = 0; corner < 8; corner++) {
        const vec3 p = half * vec3_make(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
        const float side = fmaxf(fabsf(vec3_dot(p, right)), fabsf(vec3_dot(p, upright)));
        distance = fmaxf(distance, vec3_dot(p, back) + 1.05f * side / tanf(vertical_fov_rad / 2));
    }
    scene->camera = (Camera){centre + distance * back, centre, up, vertical_fov_rad, 0, 0};
}

float random_between(Random *random, float least, float most)
{
    uint64_t z = random->state += UINT64_C(0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    z ^= z >> 31;
    return least + (most - least) * (float)(z >> 40) * 0x1p-24f;
}

vec3 random_direction(Random *random)
{
    // Archimedes: a sphere's zones of equal height have equal area.
    const float height = random_between(random, -1, 1), turn = random_between(random, 0, 6.2831853f);
    const float ring = sqrtf(fmaxf(0, 1 - height * height));
    return vec3_make(ring * cosf(turn), height, ring * sinf(turn));
}

Frame frame_at(vec3 origin, float yaw_rad)
{
    const float c = cosf(yaw_rad), s = sinf(yaw_rad);
    return (Frame){origin, vec3_make(c, 0, -s), vec3_make(0, 1, 0), vec3_make(s, 0, c)};
}

vec3 frame_vector(const Frame *frame, float x, float y, float z)
{
    return x * frame->x + y * frame->y + z * frame->z;
}

vec3 frame_point(const Frame *frame, float x, float y, float z)
{
    return frame->origin + frame_vector(frame, x, y, z);
}

void mesh_add_flat_triangle(Mesh *mesh, vec3 a, vec3 b, vec3 c, uint32_t material)
{
    const vec3 normal = vec3_normalize(vec3_cross(b - a, c - a));
    const uint32_t first = mesh_add_vertex(mesh, a, normal);
    mesh_add_vertex(mesh, b, normal);
    mesh_add_vertex(mesh, c, normal);
    mesh_add_triangle(mesh, first, first + 1, first + 2, material);
}

void frame_quad(Mesh *mesh, const Frame *frame, vec3 a, vec3 b, vec3 c, vec3 d, uint32_t material)
{
    const vec3 across = vec3_cross(vec3_normalize(c - a), vec3_normalize(d - b));
    const vec3 normal = vec3_normalize(frame_vector(frame, across[0], across[1], across[2]));
    uint32_t first = 0;
    const vec3 corners[4] = {a, b, c, d};
    for (int i = 0; i < 4; i++) {
        const vec3 p = corners[i];
        const uint32_t vertex = mesh_add_vertex(mesh, frame_point(frame, p[0], p[1], p[2]), normal);
        first = i == 0 ? vertex : first;
    }
    mesh_add_triangle(mesh, first, first + 1, first + 2, material);
    mesh_add_triangle(mesh, first, first + 2, first + 3, material);
}

void frame_box(Mesh *mesh, const Frame *frame, vec3 lower, vec3 upper, uint32_t material)
{
    for (int axis = 0; axis < 3; axis++)
        for (int side = 0; side < 2; side++) {
            const int u = (axis + 1) % 3, v = (axis + 2) % 3;
            vec3 corner[4]; // counter-clockwise seen from outside
            for (int i = 0; i < 4; i++) {
                const int at_u = i == 1 || i == 2, at_v = i >= 2;
                corner[i] = lower;
                corner[i][axis] = side ? upper[axis] : lower[axis];
                corner[i][u] = (side ? at_u : at_v) ? upper[u] : lower[u];
                corner[i][v] = (side ? at_v : at_u) ? upper[v] : lower[v];
            }
            frame_quad(mesh, frame, corner[0], corner[1], corner[2], corner[3], material);
        }
}

// Outward in the profile's plane: a segment that rises has its outside at larger radii.
static vec2 segment_normal(vec2 from, vec2 to)
{
    const vec2 d = to - from;
    const float size = sqrtf(d[0] * d[0] + d[1] * d[1]);
    return (vec2){d[1] / size, -d[0] / size};
}

static vec2 joint_normal(vec2 own, vec2 neighbour)
{
    if (own[0] * neighbour[0] + own[1] * neighbour[1] < 0.64f) // cos 50°
        return own;
    const vec2 sum = own + neighbour;
    return sum / sqrtf(sum[0] * sum[0] + sum[1] * sum[1]);
}

void frame_revolve(Mesh *mesh, const Frame *frame, const vec2 *profile, int points, int segments,
                   uint32_t material)
{
    for (int i = 0; i + 1 < points; i++) {
        const vec2 a = profile[i], b = profile[i + 1], own = segment_normal(a, b);
        const vec2 na = i > 0 ? joint_normal(own, segment_normal(profile[i - 1], a)) : own;
        const vec2 nb = i + 2 < points ? joint_normal(own, segment_normal(b, profile[i + 2])) : own;
        uint32_t first = 0;
        for (int s = 0; s <= segments; s++) {
            const float turn = 6.2831853f * (float)(s % segments) / (float)segments;
            const float c = cosf(turn), d = -sinf(turn); // turns so that rising profiles face outwards
            const uint32_t vertex = mesh_add_vertex(mesh, frame_point(frame, a[0] * c, a[1], a[0] * d),
                                                    frame_vector(frame, na[0] * c, na[1], na[0] * d));
            mesh_add_vertex(mesh, frame_point(frame, b[0] * c, b[1], b[0] * d),
                            frame_vector(frame, nb[0] * c, nb[1], nb[0] * d));
            first = s == 0 ? vertex : first;
        }
        for (int s = 0; s < segments; s++) {
            const uint32_t v = first + 2 * (uint32_t)s;
            if (a[0] > 0)
                mesh_add_triangle(mesh, v, v + 2, v + 1, material);
            if (b[0] > 0)
                mesh_add_triangle(mesh, v + 1, v + 2, v + 3, material);
        }
    }
}
