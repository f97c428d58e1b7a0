// run_setting: the parameters that every chapter has alike, and a setting's values put into its scene.
#include "run_internal.h"
#include <stdlib.h>
#include <string.h>

#define DEGREE (M_PI / 180.0)

// Along --path, a frame.
static const double SUBPIXEL_RIGHT = 0.125,
                    SUBPIXEL_UP = 0.0625; // pixels: each of 8 frames meets another phase
static const double TURN_DEG = 2.0;       // orbit, light: a full turn in three seconds

// Where a common parameter lives. Ranges hold the scenes `huge` (10⁶ m) and `tiny` (10⁻⁶ m, so up to 10⁹ a metre) with room.
// clang-format off
enum { EYE, TARGET, FOV, LIGHT, LIGHT_POSITION, LIGHT_DIRECTION, LIGHT_INTENSITY, LIGHT_HALF_ANGLE, SCATTERING, ABSORPTION, MEAN_COSINE, EXPOSURE };
static const struct {
    RunParameter parameter;
    unsigned uses; // 0: always
} common[] = {
    [EYE] = {{"eye", "where the camera stands", "m", RUN_VECTOR, -1e8, 1e8, {0}, NULL}, RUN_USES_CAMERA},
    [TARGET] = {{"target", "what it looks at", "m", RUN_VECTOR, -1e8, 1e8, {0}, NULL}, RUN_USES_CAMERA},
    [FOV] = {{"fov_deg", "its vertical field of view", "degrees", RUN_NUMBER, 0.01, 170, {0}, NULL}, RUN_USES_CAMERA},
    [LIGHT] = {{"light", "which of the scene's lights, from 0", NULL, RUN_INTEGER, 0, 1e6, {0}, NULL}, RUN_USES_LIGHT},
    [LIGHT_POSITION] = {{"light_position", "point, spot: where it is", "m", RUN_VECTOR, -1e8, 1e8, {0}, NULL}, RUN_USES_LIGHT},
    [LIGHT_DIRECTION] = {{"light_direction", "spot, directional: the way it shines", NULL, RUN_VECTOR, -1e8, 1e8, {0}, NULL}, RUN_USES_LIGHT},
    [LIGHT_INTENSITY] = {{"light_intensity", "point, spot: W/sr; directional: W/m2", NULL, RUN_VECTOR, 0, 1e20, {0}, NULL}, RUN_USES_LIGHT},
    [LIGHT_HALF_ANGLE] = {{"light_half_angle_deg", "spot: axis to border", "degrees", RUN_NUMBER, 0.01, 89, {0}, NULL}, RUN_USES_LIGHT},
    [SCATTERING] = {{"scattering", "scattering coefficient", "1/m", RUN_VECTOR, 0, 1e10, {0}, NULL}, RUN_USES_MEDIUM},
    [ABSORPTION] = {{"absorption", "absorption coefficient", "1/m", RUN_VECTOR, 0, 1e10, {0}, NULL}, RUN_USES_MEDIUM},
    [MEAN_COSINE] = {{"mean_cosine", "Henyey-Greenstein g", NULL, RUN_NUMBER, -0.999, 0.999, {0}, NULL}, RUN_USES_MEDIUM},
    [EXPOSURE] = {{"exposure", "of a .png and the window: value x 2^exposure", "stops", RUN_NUMBER, -30, 30, {0}, NULL}, 0},
};
// clang-format on
enum { COMMON_COUNT = sizeof common / sizeof *common };

void run_parameters_make(Run *run)
{
    size_t own = 0;
    while (run->about->parameters && run->about->parameters[own].name)
        ++own;
    run->parameters = memory_new(own + COMMON_COUNT + 1, sizeof *run->parameters, "the parameters");
    for (size_t i = 0; i < own; ++i)
        run->parameters[i] = run->about->parameters[i];
    run->parameter_count = own;
    for (size_t i = 0; i < COMMON_COUNT; ++i)
        if ((common[i].uses & run->about->uses) == common[i].uses)
            run->parameters[run->parameter_count++] = common[i].parameter;
    run->asked = memory_new(run->parameter_count, sizeof *run->asked, "the parameters");
    run->values = memory_new(run->parameter_count, sizeof *run->values, "the parameters");
    run->words = memory_new(run->parameter_count, sizeof *run->words, "the parameters");
    for (size_t i = 0; i < run->parameter_count; ++i) {
        memcpy(run->asked[i].number, run->parameters[i].initial, sizeof run->asked[i].number);
        run->words[i] = text_format("%s", run->parameters[i].choices ? run->parameters[i].choices : "");
        for (char *c = run->words[i]; *c; ++c)
            *c = *c == ' ' ? '\0' : *c;
    }
}

static int place_of(const Run *run, size_t parameter) // -1: the chapter's own
{
    for (int i = 0; i < COMMON_COUNT; ++i)
        if (run->parameters[parameter].shows == common[i].parameter.shows)
            return i;
    return -1;
}

bool run_parameter_of_scene(const Run *run, size_t parameter)
{
    int place = place_of(run, parameter);
    return place >= 0 && place != LIGHT && place != EXPOSURE;
}

static Light *light_of(const Run *run) // NULL: the scene has none
{
    int index = run_parameter_find(run, "light");
    size_t light = index < 0 ? 0 : (size_t)run->values[index].number[0];
    return light < run->scene->light_count ? &run->set_lights[light] : NULL;
}

const char *run_parameter_refused(const Run *run, size_t parameter)
{
    int place = place_of(run, parameter);
    const Light *light = light_of(run);
    if (place < LIGHT || place > LIGHT_HALF_ANGLE)
        return NULL;
    if (!light)
        return "the scene has no such light";
    if (place == LIGHT_POSITION && light->kind == LIGHT_DIRECTIONAL)
        return "a directional light has no position";
    if (place == LIGHT_DIRECTION && light->kind == LIGHT_POINT)
        return "a point light has no direction";
    return place == LIGHT_HALF_ANGLE && light->kind != LIGHT_SPOT ? "only a spot light has a cone" : NULL;
}

// The place's number or vector in the scene, radians where the parameter is degrees.
static void exchange(Run *run, int place, RunValue *value)
{
    Light none = {0}, *light = light_of(run);
    light = light ? light : &none;
    Medium *medium = &run->scene->medium;
    vec3 *vectors[COMMON_COUNT] = {
        [EYE] = &run->scene->camera.eye,       [TARGET] = &run->scene->camera.target,
        [LIGHT_POSITION] = &light->position,   [LIGHT_DIRECTION] = &light->direction,
        [LIGHT_INTENSITY] = &light->intensity, [SCATTERING] = &medium->scattering,
        [ABSORPTION] = &medium->absorption};
    float *numbers[COMMON_COUNT] = {[FOV] = &run->scene->camera.vertical_fov_rad,
                                    [LIGHT_HALF_ANGLE] = &light->half_angle_rad,
                                    [MEAN_COSINE] = &medium->mean_cosine};
    double unit = place == MEAN_COSINE ? 1 : DEGREE;
    vec3 *vector = vectors[place];
    if (vector && value->given)
        *vector = vec3_make((float)value->number[0], (float)value->number[1], (float)value->number[2]);
    else if (vector)
        for (int i = 0; i < 3; ++i)
            value->number[i] = (*vector)[i];
    else if (numbers[place] && value->given)
        *numbers[place] = (float)(value->number[0] * unit);
    else if (numbers[place])
        value->number[0] = *numbers[place] / unit;
}

void run_setting_apply(Run *run)
{
    Scene *scene = run->scene;
    scene->camera = run->scene_camera;
    scene->medium = run->scene_medium;
    for (size_t i = 0; i < scene->light_count; ++i)
        run->set_lights[i] = run->scene_lights[i];
    for (size_t i = 0; i < run->parameter_count; ++i) {
        const char *refused = run->values[i].given ? run_parameter_refused(run, i) : NULL;
        int place = place_of(run, i);
        if (refused)
            fail_request("--set %s: scene %s cannot take it: %s (it has %zu lights)", run->parameters[i].name,
                         scene->name, refused, scene->light_count);
        if (place >= 0)
            exchange(run, place, &run->values[i]);
        if (place == LIGHT_DIRECTION && run->values[i].given) {
            Light *light = light_of(run);
            if (vec3_length(light->direction) == 0.0f)
                fail_request("--set light_direction: 0,0,0 points nowhere; a vector with a length is needed");
            light->direction = vec3_normalize(light->direction);
        }
    }
    if (run->path == RUN_LIGHT && !light_of(run))
        fail_request("--path light: scene %s has no such light", scene->name);
    Camera *camera = &scene->camera;
    if ((run->about->uses & RUN_USES_CAMERA) && vec3_length(camera->eye - camera->target) == 0.0f)
        fail_request("--set eye, target: both are at %g,%g,%g; they must differ", (double)camera->eye[0],
                     (double)camera->eye[1], (double)camera->eye[2]);
    if (run->camera_moved)
        *camera = run->camera;
    run->camera = *camera;
    run_setting_move(run);
}

void run_setting_move(Run *run)
{
    Scene *scene = run->scene;
    for (size_t i = 0; i < scene->light_count; ++i)
        scene->lights[i] = run->set_lights[i];
    if (run->path != RUN_LIGHT || run->frame < 0)
        return;
    Light *light = &scene->lights[light_of(run) - run->set_lights];
    quat turn = quat_rotation((float)(TURN_DEG * DEGREE * run->frame), vec3_make(0, 1, 0));
    vec3 centre = 0.5f * (scene->lower + scene->upper);
    light->position = centre + quat_rotate(turn, light->position - centre);
    light->direction = quat_rotate(turn, light->direction);
}

Camera run_camera(const Run *run)
{
    Camera camera = run->camera;
    vec3 ahead = camera.target - camera.eye;
    double frame = run->frame < 0 ? 0 : run->frame;
    if (run->path == RUN_ORBIT)
        camera = camera_orbit(camera, (float)(TURN_DEG * DEGREE * frame), 0.0f, 1.0f);
    if (run->path == RUN_SUBPIXEL) { // a pixel's side at the target's distance
        float pixel = 2.0f * vec3_length(ahead) * tanf(0.5f * camera.vertical_fov_rad) / (float)run->height;
        mat4 view = camera_view(camera); // its rows are the camera's axes
        vec3 right = vec3_make(view.column[0][0], view.column[1][0], view.column[2][0]);
        vec3 up = vec3_make(view.column[0][1], view.column[1][1], view.column[2][1]);
        vec3 shift =
            (float)(SUBPIXEL_RIGHT * frame) * pixel * right + (float)(SUBPIXEL_UP * frame) * pixel * up;
        camera.eye += shift;
        camera.target += shift;
    }
    // An eye that was set or moved far off still sees the whole scene.
    float reach = vec3_length(camera.eye - 0.5f * (run->scene->lower + run->scene->upper)) +
                  0.5f * vec3_length(run->scene->upper - run->scene->lower);
    camera.far_distance = fmaxf(camera.far_distance, reach);
    return camera;
}
