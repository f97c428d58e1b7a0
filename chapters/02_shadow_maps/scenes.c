// scenes: see scenes.h.
#include "scenes.h"

// A square plate of 2 m, 2 m above a floor of 16 m, under a spot 4 m above the floor: the shadow is a square of 4 m.
static void make_plate(Scene *scene, uint64_t seed)
{
    (void)seed;
    const vec3 black = vec3_make(0, 0, 0);
    const uint32_t floor = scene_add_material(scene, "floor", vec3_make(0.7f, 0.7f, 0.66f), black);
    const uint32_t plate = scene_add_material(scene, "plate", vec3_make(0.6f, 0.3f, 0.2f), black);
    mesh_add_quad(&scene->mesh, vec3_make(-8, 0, -8), vec3_make(0, 0, 16), vec3_make(16, 0, 0), floor);
    mesh_add_quad(&scene->mesh, vec3_make(-1, 2, -1), vec3_make(0, 0, 2), vec3_make(2, 0, 0), plate);
    scene_add_light(scene, (Light){.kind = LIGHT_SPOT,
                                   .position = vec3_make(0, 4, 0),
                                   .direction = vec3_make(0, -1, 0),
                                   .intensity = vec3_make(50, 48, 44),
                                   .half_angle_rad = 1.0f});
    scene->camera = (Camera){vec3_make(3, 6, 7), vec3_make(0, 0.5f, 0), vec3_make(0, 1, 0), 0.9f, 0, 0};
}

const SceneKind shadow_scenes[] = {
    {"plate", "a plate that floats above a floor under a spot", make_plate},
    {NULL, NULL, NULL},
};
