// shadow_light: see shadow_light.h.
#include "shadow_light.h"

static const float SPOT_HALF_ANGLE_RAD = 0.7f; // where the whole scene does not fit into less
static const float SUN_FROM_DIAGONALS =
    0.6f; // where a sun's spot stands, from the middle, in the scene's diagonals
static const float SUN_ELEVATION = 0.8f; // of a sun made from a point light, to 1 along the view: about 39°
static const float SUN_ASIDE = 0.5f;

static Light light_made(const Scene *scene, const Light *from, LightKind kind)
{
    const vec3 middle = 0.5f * (scene->lower + scene->upper);
    const float diagonal = fmaxf(vec3_length(scene->upper - scene->lower), 1e-6f);
    Light made = *from;
    made.kind = kind;
    if (kind == from->kind)
        return made;
    // What the middle gets from `from` as irradiance, across; a light in the middle lights it from a third of the diagonal.
    float gap = fmaxf(vec3_length(middle - from->position), diagonal / 3.0f);
    vec3 irradiance = from->kind == LIGHT_DIRECTIONAL ? from->intensity : from->intensity / (gap * gap);

    if (kind == LIGHT_DIRECTIONAL) {
        const vec3 ahead = vec3_normalize(scene->camera.target - scene->camera.eye);
        const vec3 aside = vec3_normalize(vec3_cross(ahead, vec3_make(0, 1, 0)));
        made.direction = from->kind == LIGHT_SPOT
                             ? from->direction
                             : vec3_normalize(ahead + SUN_ASIDE * aside - vec3_make(0, SUN_ELEVATION, 0));
        made.intensity = irradiance;
        return made;
    }
    if (from->kind == LIGHT_DIRECTIONAL)
        made.position =
            kind == LIGHT_SPOT ? middle - SUN_FROM_DIAGONALS * diagonal * from->direction : middle;
    // In the middle: as much a tenth of the diagonal away, which leaves the walls something.
    gap = fmaxf(vec3_length(middle - made.position), diagonal / 10.0f);
    made.intensity = gap * gap * irradiance;
    if (kind == LIGHT_SPOT) {
        const vec3 way = middle - made.position;
        made.direction = vec3_length(way) > 1e-3f * diagonal ? vec3_normalize(way) : vec3_make(0, -1, 0);
        made.half_angle_rad =
            fminf(SPOT_HALF_ANGLE_RAD, asinf(fminf(0.5f * diagonal / fmaxf(vec3_length(way), 1e-30f), 1.0f)));
    }
    return made;
}

Light *light_choose(const Scene *scene, LightChoice choice, int index, size_t *count)
{
    static const LightKind kinds[] = {
        [CHOICE_SPOT] = LIGHT_SPOT, [CHOICE_DIRECTIONAL] = LIGHT_DIRECTIONAL, [CHOICE_POINT] = LIGHT_POINT};
    *count = choice == CHOICE_OWN ? scene->light_count : 1;
    Light *lights = memory_new(*count ? *count : 1, sizeof *lights, "the lights");
    for (size_t i = 0; choice == CHOICE_OWN && i < *count; i++)
        lights[i] = scene->lights[i];
    if (choice != CHOICE_OWN) {
        const Light none = {.kind = LIGHT_DIRECTIONAL,
                            .direction = vec3_normalize(vec3_make(0.3f, -1.0f, -0.4f)),
                            .intensity = vec3_make(3, 3, 3)};
        const bool there = index >= 0 && (size_t)index < scene->light_count;
        lights[0] = light_made(scene, there ? &scene->lights[index] : &none, kinds[choice]);
    }
    return lights;
}
