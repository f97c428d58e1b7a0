// scene_builtin: the list of the built-in scenes, and those that are short.
#include "scene_builtin.h"

#include <unistd.h>

Medium scene_haze(float extinction)
{
    const float scattering = 0.9f * extinction, absorption = 0.1f * extinction;
    return (Medium){vec3_make(scattering, scattering, scattering),
                    vec3_make(absorption, absorption, absorption), 0.6f};
}

// A model that a Debian package brings.
static void import_packaged(Scene *scene, const char *path, const char *package)
{
    if (access(path, R_OK) != 0)
        fail_work("scene %s: %s is missing; install the Debian package %s", scene->name, path, package);
    scene_import(scene, path, 180);
}

static void make_bunny(Scene *scene, uint64_t seed)
{
    (void)seed;
    import_packaged(scene, "/usr/share/glmark2/models/bunny.obj",
                    "glmark2-data"); // 2 m wide, its centre in the origin
    scene->materials[0].albedo = vec3_make(0.70f, 0.62f, 0.52f);
    scene_add_light(scene, (Light){.kind = LIGHT_SPOT,
                                   .position = vec3_make(-2.5f, 3, 2.5f),
                                   .direction = vec3_make(2.5f, -3, -2.5f),
                                   .intensity = vec3_make(75, 72, 66),
                                   .half_angle_rad = 0.35f});
    scene->medium = scene_haze(0.08f);
    scene_aim_camera(scene, vec3_make(0.15f, 0.25f, 1), 0.7f);
}

// The furniture of geomview's office, in inches and z up, on a floor before two walls.
static void make_office(Scene *scene, uint64_t seed)
{
    (void)seed;
    import_packaged(scene, "/usr/share/geomview/geom/office.oogl", "geomview");
    Mesh *mesh = &scene->mesh;
    vec3 lower, upper;
    scene_bounds(mesh, &lower, &upper);
    const float inch = 0.0254f;
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        float *p = mesh->positions + 3 * i;
        const vec3 from = vec3_make(p[0], p[1], p[2]) - 0.5f * (lower + upper);
        p[0] = inch * from[0];
        p[1] = inch * (p[2] - lower[2]);
        p[2] = -inch * from[1];
    }
    scene->materials[0].albedo = vec3_make(0.62f, 0.50f, 0.38f);
    const vec3 black = vec3_make(0, 0, 0);
    const uint32_t floor = scene_add_material(scene, "floor", vec3_make(0.33f, 0.36f, 0.40f), black);
    const uint32_t wall = scene_add_material(scene, "wall", vec3_make(0.74f, 0.72f, 0.66f), black);
    const vec3 corner = vec3_make(-2.2f, 0, -2.4f), x = vec3_make(4.6f, 0, 0), y = vec3_make(0, 2.8f, 0),
               z = vec3_make(0, 0, 4.9f);
    mesh_add_quad(mesh, corner, z, x, floor);
    mesh_add_quad(mesh, corner, x, y, wall);
    mesh_add_quad(mesh, corner, y, z, wall);
    scene_add_light(scene, (Light){.kind = LIGHT_POINT,
                                   .position = vec3_make(0.4f, 2.6f, 0.6f),
                                   .intensity = vec3_make(16, 15, 13)});
    scene->medium = scene_haze(0.05f);
    scene_aim_camera(scene, vec3_make(0.75f, 0.55f, 1), 0.7f);
}

// Cornell's box as a room of 5.5 m: five thin walls that face inwards, two closed blocks; the blocks' sizes and turns are those of the
// original's drawing to a tenth.
static void make_cornell(Scene *scene, uint64_t seed)
{
    (void)seed;
    Mesh *mesh = &scene->mesh;
    const vec3 black = vec3_make(0, 0, 0);
    const uint32_t white = scene_add_material(scene, "white", vec3_make(0.73f, 0.72f, 0.68f), black);
    const uint32_t red = scene_add_material(scene, "red", vec3_make(0.61f, 0.06f, 0.05f), black);
    const uint32_t green = scene_add_material(scene, "green", vec3_make(0.12f, 0.44f, 0.11f), black);
    const float side = 5.5f, half = side / 2, block = 1.65f;
    const vec3 x = vec3_make(side, 0, 0), y = vec3_make(0, side, 0), z = vec3_make(0, 0, side);
    mesh_add_quad(mesh, vec3_make(-half, 0, -half), z, x, white);    // floor
    mesh_add_quad(mesh, vec3_make(-half, side, -half), x, z, white); // ceiling
    mesh_add_quad(mesh, vec3_make(-half, 0, -half), x, y, white);    // back
    mesh_add_quad(mesh, vec3_make(-half, 0, -half), y, z, red);      // left
    mesh_add_quad(mesh, vec3_make(half, 0, -half), z, y, green);     // right
    const Frame tall = frame_at(vec3_make(-0.9f, 0, -0.95f), 0.29f),
                low = frame_at(vec3_make(0.95f, 0, 1.1f), -0.3f);
    frame_box(mesh, &tall, vec3_make(-block / 2, 0, -block / 2), vec3_make(block / 2, 2 * block, block / 2),
              white);
    frame_box(mesh, &low, vec3_make(-block / 2, 0, -block / 2), vec3_make(block / 2, block, block / 2),
              white);
    scene_add_light(
        scene,
        (Light){.kind = LIGHT_POINT, .position = vec3_make(0, 4.6f, 0), .intensity = vec3_make(30, 27, 22)});
    scene->medium = scene_haze(0.04f);
    scene->camera =
        (Camera){vec3_make(0, half, 10.2f), vec3_make(0, half, 0), vec3_make(0, 1, 0), 0.72f, 0, 0};
}

static void make_empty(Scene *scene, uint64_t seed)
{
    (void)seed;
    scene_add_light(
        scene, (Light){.kind = LIGHT_POINT, .position = vec3_make(0, 1, 0), .intensity = vec3_make(3, 3, 3)});
    scene->medium = scene_haze(0.1f);
}

const SceneKind scene_kinds[] = {
    {"bunny", "Stanford's bunny, 69 666 triangles, watertight, under a spot", make_bunny},
    {"cornell", "a room of thin walls, red and green, with two blocks and a point light", make_cornell},
    {"colonnade", "a courtyard with two storeys of arcades in the sun", make_colonnade},
    {"fence", "a chain-link fence before a statue, under a spot", make_fence},
    {"toroid", "a closed ring of seven saddles with 22 handles, a point light behind it", make_toroid},
    {"forest", "trees with thin branches and leaves in mist, towards a lamp", make_forest},
    {"office", "a furnished office, 3 460 polygons of bookcases, desk and chairs", make_office},
    {"empty", "no triangle", make_empty},
    {"slivers", "triangles up to a million times longer than high, in all directions", make_slivers},
    {"huge", "a round temple 10^6 m from the origin on each axis", make_huge},
    {"tiny", "the same temple, 10^-6 its size", make_tiny},
    {"degenerate", "points, edges, lines and duplicates among good triangles", make_degenerate},
    {"planar", "all triangles in the plane z = 0", make_planar},
    {NULL, NULL, NULL},
};
