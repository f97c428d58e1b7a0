// scene: opening, closing, building blocks of the generators, and the voxel grid around a scene.
#include "scene_builtin.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

// Of the scene's diagonal: the default of a light's radius.
static const float LIGHT_RADIUS_OF_DIAGONAL = 1e-4f;
// Where an OBJ has no normals, edges flatter than this are smoothed.
static const float CREASE_DEGREES = 60;

static Scene *scene_new(const char *name)
{
    Scene *scene = memory_new(1, sizeof *scene, "a scene");
    scene->name = text_format("%s", name);
    return scene;
}

// Validate, then fill in what the generator or file left open.
static Scene *scene_complete(Scene *scene, bool may_be_empty)
{
    char *refused = scene_validate(scene, may_be_empty);
    if (refused)
        fail_work("%s: refused: %s", scene->name, refused);
    vec3 lower, upper;
    scene_bounds(&scene->mesh, &lower, &upper);
    const float diagonal = vec3_length(upper - lower);
    if (!(diagonal > 0 && isfinite(diagonal))) // its square leaves float32, in shaders too
        fail_work("%s: refused: it is %g m wide; sizes from 1e-18 to 1e18 m can be worked with", scene->name,
                  fmax(fmax((double)upper[0] - (double)lower[0], (double)upper[1] - (double)lower[1]),
                       (double)upper[2] - (double)lower[2]));
    if (scene->light_count == 0 &&
        !may_be_empty) // a file without lights: irradiance π: a white surface that faces it has radiance 1
        scene_add_light(scene, (Light){.kind = LIGHT_DIRECTIONAL,
                                       .direction = vec3_make(0.5f, -0.8f, -0.4f),
                                       .intensity = vec3_make(1, 1, 1) * 3.14159265f});
    for (size_t i = 0; i < scene->light_count; i++) {
        Light *light = &scene->lights[i];
        light->direction = vec3_normalize(light->direction);
        if (light->radius <= 0)
            light->radius = LIGHT_RADIUS_OF_DIAGONAL * diagonal;
    }
    Camera *camera = &scene->camera;
    if (camera->vertical_fov_rad <= 0)
        scene_aim_camera(scene, vec3_make(0.4f, 0.35f, 1.0f), 0.7f);
    if (camera->near_distance <= 0)
        camera->near_distance = 1e-3f * diagonal;
    if (camera->far_distance <= camera->near_distance) // beyond the scene, with room to zoom out
        camera->far_distance = 2 * vec3_length(0.5f * (lower + upper) - camera->eye) + 4 * diagonal;
    return scene;
}

Scene *scene_from(const SceneKind *kind, uint64_t seed)
{
    Scene *scene = scene_new(kind->name);
    kind->make(scene, seed);
    scene_complete(scene, true);
    scene->report.repaired_normals = 0; // a generator leaves them open on purpose
    return scene;
}

Scene *scene_open(const char *name_or_file, uint64_t seed)
{
    if (strpbrk(name_or_file, "./")) {
        Scene *scene = scene_new(name_or_file);
        scene_import(scene, name_or_file, CREASE_DEGREES);
        return scene_complete(scene, false);
    }
    for (const SceneKind *kind = scene_kinds; kind->name; kind++)
        if (strcmp(kind->name, name_or_file) == 0)
            return scene_from(kind, seed);
    char *names = text_format("%s", "");
    for (const SceneKind *kind = scene_kinds; kind->name; kind++) {
        char *longer = text_format("%s%s, ", names, kind->name);
        free(names);
        names = longer;
    }
    fail_request("--scene: no scene is named '%s'; there are %sor a model file (a path with a '.' or '/')",
                 name_or_file, names);
}

void scene_close(Scene *scene)
{
    if (!scene)
        return;
    for (size_t i = 0; i < scene->material_count; i++)
        free(scene->materials[i].name);
    free(scene->mesh.positions);
    free(scene->mesh.normals);
    free(scene->mesh.indices);
    free(scene->mesh.triangle_material);
    free(scene->materials);
    free(scene->lights);
    free(scene->name);
    free(scene);
}

// Every face is origin + i·h with both multiples of a power of two, `quantum`, that leaves the largest face within 2^53 of it: so each sum
// is exact in double. h keeps its 24 bits unless the scene lies farther off than 2^27 voxels.
VoxelGrid scene_grid(const Scene *scene, int resolution)
{
    const vec3 half = vec3_make(0.5f, 0.5f, 0.5f); // of the cube that stands for an empty scene
    const bool empty = scene->mesh.triangle_count == 0;
    const vec3 lower = empty ? -half : scene->lower, upper = empty ? half : scene->upper;
    double longest = 0, farthest = 0;
    for (int axis = 0; axis < 3; axis++) {
        longest = fmax(longest, (double)upper[axis] - (double)lower[axis]);
        farthest = fmax(farthest, fmax(fabs((double)lower[axis]), fabs((double)upper[axis])));
    }
    VoxelGrid grid = {.voxel_size = fmax(longest / resolution, (double)FLT_TRUE_MIN)};
    for (bool inside = false; !inside;) { // rounding h up once or twice more ends it
        const int exponent = (int)fmax(ilogb(grid.voxel_size) - (FLT_MANT_DIG - 1), ilogb(farthest) - 50);
        const double quantum = ldexp(1, (int)fmax(exponent, FLT_MIN_EXP - FLT_MANT_DIG));
        grid.voxel_size = quantum * ceil(grid.voxel_size / quantum);
        inside = true;
        for (int axis = 0; axis < 3; axis++) {
            grid.origin[axis] = quantum * floor((double)lower[axis] / quantum);
            const double faces = ceil(((double)upper[axis] - grid.origin[axis]) / grid.voxel_size);
            grid.size[axis] = (int)fmax(faces, 1);
            if (grid.origin[axis] + grid.size[axis] * grid.voxel_size < (double)upper[axis])
                grid.size[axis]++; // the quotient was rounded down to a whole number
            inside = inside && grid.size[axis] <= resolution;
        }
        grid.voxel_size += inside ? 0 : quantum;
    }
    return grid;
}

size_t grid_voxels(const VoxelGrid *grid)
{
    return (size_t)grid->size[0] * (size_t)grid->size[1] * (size_t)grid->size[2];
}

size_t grid_words(const VoxelGrid *grid)
{
    return (grid_voxels(grid) + 31) / 32;
}
