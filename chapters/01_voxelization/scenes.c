// scenes: see scenes.h. Each fills the box from 0 to 16 m (times a scale, plus an offset), so that 16 voxels are a metre long. All numbers
// are float32 numbers exactly.
#include "scenes.h"
#include "attribute_scenes.h"
#include "scenes_hard.h"
#include "solid_scenes.h"
#include <string.h>

static void add_sun(Scene *scene)
{
    scene_add_light(scene, (Light){.kind = LIGHT_DIRECTIONAL,
                                   .direction = vec3_normalize(vec3_make(-0.4f, -1.0f, -0.6f)),
                                   .intensity = vec3_make(2.5f, 2.4f, 2.2f)});
}

static void add_triangle(Mesh *mesh, vec3 a, vec3 b, vec3 c, uint32_t material)
{
    const vec3 from_triangle = {0};
    uint32_t first = mesh_add_vertex(mesh, a, from_triangle);
    mesh_add_triangle(mesh, first, mesh_add_vertex(mesh, b, from_triangle),
                      mesh_add_vertex(mesh, c, from_triangle), material);
}

// A cube a quarter of a metre inside the box, and a grain in two opposite corners of the box to hold it open.
static void add_cube(Scene *scene, float scale, float offset)
{
    uint32_t material = scene_add_material(scene, "chalk", vec3_make(0.7f, 0.7f, 0.66f), vec3_make(0, 0, 0));
    vec3 origin = vec3_make(offset, offset, offset), one = vec3_make(scale, scale, scale);
    vec3 x = vec3_make(0.125f * scale, 0, 0), y = vec3_make(0, 0.125f * scale, 0);
    vec3 far_corner = origin + 16.0f * one;
    add_triangle(&scene->mesh, origin, origin + x, origin + y, material);
    mesh_add_box(&scene->mesh, origin + 0.25f * one, origin + 15.75f * one, material);
    add_triangle(&scene->mesh, far_corner, far_corner - x, far_corner - y, material);
    add_sun(scene);
}

static void make_cube(Scene *scene, uint64_t seed)
{
    (void)seed;
    add_cube(scene, 1.0f, 0.0f);
}

// 2^20 m away float32 numbers lie an eighth of a metre apart.
static void make_far(Scene *scene, uint64_t seed)
{
    (void)seed;
    add_cube(scene, 1.0f, 0x1p20f);
}

static void make_small(Scene *scene, uint64_t seed)
{
    (void)seed;
    add_cube(scene, 0x1p-20f, 0.0f);
}

// Three squares that halve the box: each lies in a face between two layers of voxels.
static void make_faces(Scene *scene, uint64_t seed)
{
    (void)seed;
    uint32_t material = scene_add_material(scene, "paper", vec3_make(0.6f, 0.65f, 0.7f), vec3_make(0, 0, 0));
    vec3 x = vec3_make(16, 0, 0), y = vec3_make(0, 16, 0), z = vec3_make(0, 0, 16);
    mesh_add_quad(&scene->mesh, 0.5f * x, y, z, material);
    mesh_add_quad(&scene->mesh, 0.5f * y, z, x, material);
    mesh_add_quad(&scene->mesh, 0.5f * z, x, y, material);
    add_sun(scene);
}

static void make_oblique(Scene *scene, uint64_t seed)
{
    (void)seed;
    uint32_t material = scene_add_material(scene, "paper", vec3_make(0.7f, 0.6f, 0.5f), vec3_make(0, 0, 0));
    add_triangle(&scene->mesh, vec3_make(16, 0, 0), vec3_make(0, 16, 0), vec3_make(0, 0, 16), material);
    add_sun(scene);
}

static void make_floor(Scene *scene, uint64_t seed)
{
    (void)seed;
    uint32_t material = scene_add_material(scene, "paper", vec3_make(0.6f, 0.7f, 0.6f), vec3_make(0, 0, 0));
    mesh_add_quad(&scene->mesh, vec3_make(0, 0, 0), vec3_make(0, 0, 16), vec3_make(16, 0, 0), material);
    add_sun(scene);
}

// With a region of a millionth of it: one triangle a million times larger than the grid.
static void make_vast(Scene *scene, uint64_t seed)
{
    (void)seed;
    uint32_t material = scene_add_material(scene, "paper", vec3_make(0.7f, 0.6f, 0.6f), vec3_make(0, 0, 0));
    const float side = 0x1p24f;
    add_triangle(&scene->mesh, vec3_make(-side, 0, -side), vec3_make(side, 0, -side),
                 vec3_make(0, side, side), material);
    add_sun(scene);
}

const SceneKind voxel_scenes[] = {
    {"cube", "a cube from 0.25 to 15.75 m in a box of 16 m", make_cube},
    {"far", "the cube, 2^20 m (1049 km) from the origin on each axis", make_far},
    {"small", "the cube, 2^-20 its size", make_small},
    {"faces", "three squares in the planes that halve a box of 16 m", make_faces},
    {"oblique", "one triangle across a box of 16 m, at the same slope to all axes", make_oblique},
    {"floor", "a square of 16 m in the plane y = 0", make_floor},
    {"vast", "one triangle of 2^25 m", make_vast},
    {"point", "one triangle whose corners are one point", scenes_make_point},
    {"speck", "a tetrahedron smaller than a voxel of 1 m, and a grain in two corners of its box of 16 m",
     scenes_make_speck},
    {"crowd", "a million triangles in a box of half a metre, and a grain in two corners of 16 m",
     scenes_make_crowd},
    {"edge", "a triangle with an edge of 8 m along a line of the grid, in a box of 16 m", scenes_make_edge},
    {"beam", "a box of 3 x 500 x 7 m", scenes_make_beam},
    {"sphere_1000", "a ball of 968 triangles", scenes_make_sphere_1000},
    {"sphere_10000", "a ball of 9 800 triangles", scenes_make_sphere_10000},
    {"sphere_100000", "a ball of 100 352 triangles", scenes_make_sphere_100000},
    {"sphere_1000000", "a ball of 1 002 528 triangles", scenes_make_sphere_1000000},
    {"ball", "a ball of 7.5 m", make_ball},
    {"ball_inside_out", "the ball, its triangles wound the other way", make_ball_inside_out},
    {"ball_twice", "the ball, each triangle twice", make_ball_twice},
    {"ball_holes", "the ball with holes: one triangle of 96 is missing", make_ball_holes},
    {"balls", "two balls of 5 m that overlap", make_balls},
    {"averages", "a wall of 16 x 16 voxels with 2 to 512 triangles each, all of the same mean albedo",
     make_averages},
    {NULL, NULL, NULL},
};

// The outer layers of a cube of `side` voxels.
static double shell(double side, double layers)
{
    return pow(side, 3.0) - pow(side - 2.0 * layers, 3.0);
}

// Voxel (i, j, k) has corners with x + y + z from i + j + k to i + j + k + 3, and touches the plane x + y + z = N where N is among
// these. There are (s+2)(s+1)/2 voxels with i + j + k = s < N; of those with s = N three lie outside the grid.
static double oblique(double side)
{
    double voxels = -3.0;
    for (int behind = 0; behind <= 3; behind++) {
        const double s = side - behind;
        voxels += 0.5 * (s + 1.0) * (s + 2.0);
    }
    return voxels;
}

double scenes_voxels(const char *stability_case)
{
    const struct {
        const char *name;
        double voxels;
    } counts[] = {
        {"cube 16", shell(16, 1)},
        {"cube 32", shell(32, 1)},
        {"cube in faces",
         shell(64, 2)},          // its faces, 0.25 m inside, lie between the first two layers: both touch
        {"faces", shell(16, 1)}, // two layers of three planes are a shell turned inside out
        {"oblique", oblique(16)},
        {"oblique 256", oblique(256)},
        {"far", shell(16, 1)},
        {"small", shell(16, 1)},
        {"floor", 64 * 64},
        {"one voxel", 1},
        {"empty", 0},
        {"one point", 0},
        {"smaller than a voxel", 3}, // its own, and one a grain
        {"binary empty", 0},
        {"binary one point", 0},
        {"binary smaller than a voxel", 3},
        {"crowd", 3},
        {"binary crowd", 3},
        {"edge", 42}, // four voxels round each metre of the line, one more beyond either end, the grains
        {"binary edge", 42},
        {"beam", 3 * 500 * 7 - 1 * 498 * 5},
        {"binary beam", 3 * 500 * 7 - 1 * 498 * 5},
        {"binary one voxel", 1},
    };
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++)
        if (strcmp(stability_case, counts[i].name) == 0)
            return counts[i].voxels;
    return -1;
}
