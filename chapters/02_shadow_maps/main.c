// 02 shadow maps: which surfaces does a light reach?
//
// You should see the scene from the light, as distances; then the shadow that comparing with them gives, with its two failures; then what bias
// and filters make of it; then a sun and a lamp, which see more than a square; then the map as a light: what its surfaces pass on.
// Why so: every later chapter asks, for points on surfaces and in the air, whether light arrives; millions of times a picture, so that one ray
// each is too slow. A depth map answers from memory, up to a texel.
// Source: Williams, "Casting curved shadows on curved surfaces" (1978); Gomes (2015), section 2.2; Brabec, Annen and Seidel (2002); Donnelly and
// Lauritzen (2006); Dachsbacher and Stamminger (2005).
#include "shadow_about.h"
#include "shadow_judge.h"
#include "shadow_light.h"
#include "rsm.h"
#include "shadow_scenes.h"
#include "sway.h"
#include <stdlib.h>

// why passes are left out
static const char *const SAME_MAP = "light, casters and what is asked are the last map's";
static const char *const SAME_LIGHT = "light and surfaces are the last frame's";
static const char *const SAME_VIEW = "eye, light, surfaces and map are the last frame's";
static const char *const NOT_SHOWN = "its picture is not the one shown";
static const char *const NO_PIXEL = "the light reaches no pixel";
static const char *const NOT_READ = "no pass reads it";

static uint64_t hash_camera(Camera c)
{
    float values[] = {c.eye[0],    c.eye[1], c.eye[2], c.target[0], c.target[1],
                      c.target[2], c.up[0],  c.up[1],  c.up[2],     c.vertical_fov_rad};
    return hash_bytes(HASH_START, values, sizeof values);
}

static uint64_t hash_light(const Light *light)
{
    uint64_t hash = hash_bytes(HASH_START, &light->position, 3 * sizeof(float));
    hash = hash_bytes(hash, &light->direction, 3 * sizeof(float));
    return hash_bytes(hash, &light->half_angle_rad, sizeof light->half_angle_rad);
}

// What a light's map is made from: the light, the casters, how the map lies, what is asked of it.
static uint64_t hash_map(const ShadowMap *map, const Light *light, uint64_t casters, const MapAsked *asked)
{
    uint64_t hash = hash_bytes(asked->hash ^ hash_light(light), &casters, sizeof casters);
    hash = hash_bytes(hash, &map->depth.origin, 3 * sizeof(float));
    return hash_bytes(hash, &map->depth.to_clip, sizeof map->depth.to_clip);
}

// A light's maps, and what is known about them since the last frame.
typedef struct Rig {
    ShadowMap map;
    ReflectiveMap reflective;
    MapAsked asked;
    uint64_t map_hash, light_hash;
    bool new_map, new_light; // in this frame
} Rig;

static MapLookup lookup_of(const Run *run)
{
    static const struct {
        const char *name, *size;
        MapBias bias;
    } biases[] = {{"none", NULL, BIAS_NONE},
                  {"constant", "bias_constant", BIAS_CONSTANT},
                  {"slope", "bias_slope", BIAS_SLOPE},
                  {"normal", "bias_normal", BIAS_NORMAL}};
    MapLookup lookup = {.filter = run_chosen(run, "filter", "nearest") ? FILTER_NEAREST
                                  : run_chosen(run, "filter", "pcf")   ? FILTER_PCF
                                                                       : FILTER_VARIANCE,
                        .radius = (float)run_number(run, "radius"),
                        .minimum_variance = (float)run_number(run, "minimum_variance"),
                        .bleeding = (float)run_number(run, "bleeding")};
    for (size_t i = 0; i < sizeof biases / sizeof *biases; i++)
        if (run_chosen(run, "bias", biases[i].name)) {
            lookup.bias = biases[i].bias;
            lookup.bias_size = biases[i].size ? (float)run_number(run, biases[i].size) : 0.0f;
        }
    return lookup;
}

// Steps sun and point are about one kind of light; the others take what `kind` says.
static LightChoice light_choice(const Run *run)
{
    const bool pictures = run_picture_needed(run);
    return pictures && run_step_shown(run, "sun")     ? CHOICE_DIRECTIONAL
           : pictures && run_step_shown(run, "point") ? CHOICE_POINT
           : run_chosen(run, "kind", "own")           ? CHOICE_OWN
           : run_chosen(run, "kind", "spot")          ? CHOICE_SPOT
           : run_chosen(run, "kind", "directional")   ? CHOICE_DIRECTIONAL
                                                      : CHOICE_POINT;
}

static double gather(Run *run, const Rsm *rsm, const GBuffer *gbuffer, const Camera *camera,
                     const ReflectiveMap *map, bool all, GLuint picture)
{
    const RsmGather how = {.gbuffer = gbuffer,
                           .camera = camera,
                           .map = map,
                           .clamp = (float)run_number(run, "clamp"),
                           .texel_discs = run_chosen(run, "falloff", "disc"),
                           .picture = picture};
    const RsmPattern pattern = {.samples = run_integer(run, "samples"),
                                .radius = (float)run_number(run, "gather_radius"),
                                .rotated = run_chosen(run, "pattern", "rotated"),
                                .sampling = run_chosen(run, "sampling", "printed") ? RSM_AS_PRINTED
                                            : run_chosen(run, "sampling", "even")  ? RSM_EVENLY
                                                                                   : RSM_ABOUT_PIXEL,
                                .seed = 1};
    return all ? rsm_gather_all(rsm, &how) : rsm_gather_importance(rsm, &how, &pattern);
}

// What the passes of one frame share.
typedef struct Frame {
    Run *run;
    const Raster *raster;
    const MapShaders *shaders;
    const Scene *scene;
    Camera camera;
    const GBuffer *gbuffer;
    Truth *truth;
    Scene judged; // what truth holds
    vec3 offset;  // of the scene from there
    const RasterMesh *mesh;
    uint64_t mesh_hash; // of --path deform
    bool new_mesh;
    Rig *rigs;                // one a light
    const GLuint *visibility; // one a light
    GLuint picture;
    size_t shown_light;
    bool changed; // eye, light or a map, since the last frame
} Frame;

// Lights and camera as they are in this frame, where the truth's triangles are.
static Asked asked_of(Frame *frame)
{
    for (size_t i = 0; i < frame->scene->light_count; i++) {
        frame->judged.lights[i] = frame->scene->lights[i];
        frame->judged.lights[i].position -= frame->offset;
    }
    Camera camera = frame->camera;
    camera.eye -= frame->offset;
    camera.target -= frame->offset;
    return (Asked){&frame->judged, camera, frame->gbuffer, frame->visibility};
}

// The scene as it leans in this frame, and the truth about it.
static void deform(Frame *frame, Scene *scene)
{
    const uint64_t hash =
        sway_lean(scene, run_scene(frame->run), sway_of_frame(run_frame_number(frame->run)), frame->mesh);
    frame->new_mesh = hash != frame->mesh_hash;
    frame->mesh_hash = hash;
    truth_close(frame->truth);
    judge_scene_free(&frame->judged);
    frame->judged = judge_scene(scene, &frame->offset);
    frame->truth = truth_open(&frame->judged.mesh);
}

//[maps
// Each light's map: where it will be asked, by which casters it can be changed there; then those are drawn.
static void draw_maps(Frame *frame, const MapLookup *lookup, const Camera *fit_to, bool new_eye)
{
    Run *run = frame->run;
    const bool first = run_frame_number(run) == 0;
    for (size_t i = 0; i < frame->scene->light_count; i++) {
        const Light *light = &frame->scene->lights[i];
        Rig *rig = &frame->rigs[i];
        rig->new_light = first || hash_light(light) != rig->light_hash;
        rig->light_hash = hash_light(light);
        map_aim(&rig->map, frame->scene, light, fit_to, run_aspect(run));
        if (run_pass(run, "receivers", new_eye || rig->new_light || frame->new_mesh, SAME_VIEW)) {
            rig->asked =
                map_find_receivers(frame->shaders, &rig->map, light, frame->gbuffer, &frame->camera, lookup);
            run_count(run, "pixels", rig->asked.pixels);
        }
        const uint64_t hash = hash_map(&rig->map, light, frame->mesh_hash, &rig->asked);
        const bool asked = rig->asked.pixels > 0;
        rig->new_map = asked && (first || hash != rig->map_hash);
        rig->map_hash = hash;
        frame->changed = frame->changed || rig->new_map || rig->new_light;
        const char *const why_not = asked ? SAME_MAP : NO_PIXEL;
        MapCasters casters = {0};
        if (run_pass(run, "casters", rig->new_map, why_not)) {
            casters = map_find_casters(frame->shaders, &rig->map, light, frame->mesh, lookup,
                                       (float)run_number(run, "tessellation"));
            const double all = (double)rig->map.layers * rig->map.triangle_count;
            run_skipped(run, all - casters.whole - casters.cut, all);
            run_count(run, "cut", casters.cut);
        }
        if (run_pass(run, "depth map", rig->new_map, why_not)) {
            map_draw(frame->shaders, &rig->map, light, frame->mesh, &casters);
            run_skipped(run, rig->map.layers - rig->asked.layers, rig->map.layers);
        }
        if (rig->map.moments[0] && run_pass(run, "moments", rig->new_map, why_not)) {
            map_filter_moments(frame->shaders, &rig->map, light, lookup);
            run_skipped(run, rig->map.layers - rig->asked.layers, rig->map.layers);
        }
    }
}
//]

//[direct
// A picture of direct light: each light's map is asked for each pixel, then all light is added up.
static void direct_light(Frame *frame, const char *ask_pass, const char *light_pass, const MapLookup *lookup,
                         bool shown)
{
    Run *run = frame->run;
    const Asked asked = asked_of(frame);
    const bool needed = shown && frame->changed;
    const char *const why_not = shown ? SAME_VIEW : NOT_SHOWN;
    for (size_t i = 0; i < frame->scene->light_count; i++) {
        const bool reaches = frame->rigs[i].asked.pixels > 0;
        if (run_pass(run, ask_pass, needed && reaches, reaches ? why_not : NO_PIXEL)) {
            map_visibility(frame->shaders, &frame->rigs[i].map, &frame->scene->lights[i], frame->gbuffer,
                           &frame->camera, lookup, frame->visibility[i]);
            if (run_chosen(run, "visibility_by", "rays"))
                judge_rays(&asked, frame->truth, i);
        }
    }
    if (!run_pass_common(run, light_pass, needed, why_not))
        return;
    const bool pictures = run_picture_needed(run);
    raster_light_begin(frame->raster, frame->gbuffer, frame->picture,
                       pictures ? (float)run_number(run, "ambient") : 0.0f);
    for (size_t i = 0; i < frame->scene->light_count; i++)
        if (frame->rigs[i].asked.pixels > 0)
            map_light(frame->shaders, &frame->rigs[i].map, &frame->scene->lights[i], frame->gbuffer,
                      &frame->camera, frame->visibility[i], frame->picture);
    if (pictures && frame->scene->light_count > 0 && run_chosen(run, "show", "visibility"))
        map_paint(frame->shaders, frame->visibility[frame->shown_light], frame->picture,
                  frame->gbuffer->width, frame->gbuffer->height);
    if (pictures && frame->scene->light_count > 0 && run_chosen(run, "show", "wrong"))
        judge_show(&asked, frame->truth, frame->shown_light, frame->picture);
}
//]

int main(int argc, char **argv)
{
    Run *run = run_open(&shadow_about, argc, argv);
    Raster *raster = raster_open();
    MapShaders shaders = map_shaders_open();
    Rsm rsm = rsm_open();
    Series *series = judge_series_new();
    while (run_setting(run)) {
        const int width = run_width(run), height = run_height(run), chosen_light = run_integer(run, "light");
        const bool pictures = run_picture_needed(run), fit_view = run_chosen(run, "fit", "view");
        const bool try_bounce = !pictures && run_chosen(run, "trial", "bounce");
        const bool show_depth = pictures && run_step_shown(run, "depth");
        const bool show_reflective = pictures && run_step_shown(run, "reflective");
        const bool show_bounce = pictures ? run_step_shown(run, "bounce") : try_bounce;
        const MapLookup filtered = lookup_of(run);
        MapLookup compared = filtered, biased = filtered;
        compared.filter = biased.filter = FILTER_NEAREST;
        compared.bias = BIAS_NONE;

        Scene scene = run_deforming(run) ? sway_begin(run_scene(run)) : *run_scene(run);
        // its own lights give way to those that are shown
        scene.lights = light_choose(run_scene(run), light_choice(run), chosen_light, &scene.light_count);
        const size_t shown = (size_t)chosen_light < scene.light_count ? (size_t)chosen_light : 0;
        Camera camera = run_camera(run);
        RasterMesh mesh = raster_mesh(&scene);
        GBuffer gbuffer = raster_gbuffer(width, height);
        GLuint picture =
            gl_texture(.label = "picture", .format = GL_RGBA32F, .width = width, .height = height);
        GLuint spare = gl_texture(.label = "spare", .format = GL_RGBA32F, .width = width, .height = height);
        Rig *rigs = memory_new(scene.light_count + 1, sizeof *rigs, "the lights' maps");
        GLuint *visibility = memory_new(scene.light_count + 1, sizeof *visibility, "the visibilities");
        for (size_t i = 0; i < scene.light_count; i++) {
            rigs[i].map = map_create(&scene, &scene.lights[i], run_chosen(run, "map", "paraboloid"),
                                     filtered.filter == FILTER_VARIANCE, run_integer(run, "resolution"),
                                     fit_view ? &camera : NULL, run_aspect(run));
            map_shaders_add(&shaders, rigs[i].map.shape);
            rigs[i].reflective =
                raster_reflective_map(&scene, &scene.lights[i], run_integer(run, "reflective_resolution"));
            visibility[i] =
                gl_texture(.label = "visibility", .format = GL_R32F, .width = width, .height = height);
        }
        Frame frame = {.run = run,
                       .raster = raster,
                       .shaders = &shaders,
                       .scene = &scene,
                       .gbuffer = &gbuffer,
                       .mesh = &mesh,
                       .rigs = rigs,
                       .visibility = visibility,
                       .picture = picture,
                       .shown_light = shown};
        frame.judged = judge_scene(&scene, &frame.offset);
        frame.truth = truth_open(&frame.judged.mesh);
        uint64_t last_eye = 0;

        while (run_frame(run)) {
            camera = frame.camera = run_camera(run);
            const bool new_eye = run_frame_number(run) == 0 || hash_camera(camera) != last_eye;
            last_eye = hash_camera(camera);
            free(scene.lights);
            scene.lights = light_choose(run_scene(run), light_choice(run), chosen_light, &scene.light_count);
            if (run_deforming(run))
                deform(&frame, &scene);
            frame.changed = new_eye || frame.new_mesh;

            if (run_pass_common(run, "G-buffer", frame.changed, SAME_VIEW))
                raster_gbuffer_draw(raster, &gbuffer, &camera, &mesh);
            draw_maps(&frame, &filtered, fit_view ? &camera : NULL, new_eye);
            if (scene.light_count > 0 && run_pass_common(run, "depth: paint", show_depth, NOT_SHOWN))
                map_show(&shaders, &rigs[shown].map, picture, width, height);
            run_step(run, "depth", picture);

            direct_light(&frame, "compare: ask", "compare: light", &compared,
                         pictures && run_step_shown(run, "compare"));
            run_step(run, "compare", picture);
            direct_light(&frame, "bias: ask", "bias: light", &biased,
                         pictures && run_step_shown(run, "bias"));
            run_step(run, "bias", picture);
            direct_light(&frame, "filter: ask", "filter: light", &filtered,
                         pictures ? run_step_shown(run, "filter") : !try_bounce);
            run_step(run, "filter", picture);
            direct_light(&frame, "sun: ask", "sun: light", &filtered, pictures && run_step_shown(run, "sun"));
            run_step(run, "sun", picture);
            direct_light(&frame, "point: ask", "point: light", &filtered,
                         pictures && run_step_shown(run, "point"));
            run_step(run, "point", picture);

            //[reflective
            for (size_t i = 0; i < scene.light_count; i++) {
                const bool read = show_bounce || (show_reflective && i == shown);
                if (run_pass(run, "reflective map", read && (rigs[i].new_light || frame.new_mesh),
                             read ? SAME_LIGHT : NOT_READ)) {
                    raster_depth_map_aim(&rigs[i].reflective.depth, &scene, &scene.lights[i], NULL, 1.0f);
                    raster_reflective_map_draw(raster, &rigs[i].reflective, &scene.lights[i], &mesh);
                }
            }
            //]
            if (scene.light_count > 0 &&
                run_pass_common(run, "reflective: paint", show_reflective, NOT_SHOWN))
                map_show_flux(&shaders, &rigs[shown].reflective, picture, width, height);
            run_step(run, "reflective", picture);

            //[bounce
            direct_light(&frame, "bounce: ask", "bounce: light", &filtered, pictures && show_bounce);
            if (try_bounce && run_pass_common(run, "bounce: black", true, NULL))
                gl.ClearTexImage(picture, 0, GL_RGBA, GL_FLOAT, (const float[]){0, 0, 0, 1});
            const bool gather_needed = show_bounce && frame.changed;
            for (size_t i = 0; i < scene.light_count; i++)
                if (run_pass(run, "gather", gather_needed, show_bounce ? SAME_VIEW : NOT_SHOWN))
                    run_count(run, "texels_a_pixel",
                              gather(run, &rsm, &gbuffer, &camera, &rigs[i].reflective,
                                     run_chosen(run, "gather", "all"), show_bounce ? picture : spare));
            //]
            run_step(run, "bounce", picture);

            if (run_truth_wanted(run)) {
                if (show_depth || show_reflective)
                    fail_request("--truth: steps depth and reflective show maps, not a view; the other steps "
                                 "have a truth");
                const Asked asked = asked_of(&frame);
                Image image =
                    run_chosen(run, "show", "light")
                        ? judge_light(&asked, frame.truth, show_bounce ? LIGHT_AND_BOUNCE : DIRECT_LIGHT, 0)
                        : judge_paint(&asked, frame.truth, shown);
                run_truth(run, &image);
                image_free(&image);
            }
        }
        const Asked asked = asked_of(&frame);
        if (run_measuring_error(run)) {
            gl.ClearTexImage(spare, 0, GL_RGBA, GL_FLOAT, (const float[]){0, 0, 0, 1});
            for (size_t i = 0; i < scene.light_count && try_bounce; i++)
                gather(run, &rsm, &gbuffer, &camera, &rigs[i].reflective, true, spare);
            judge_sweep(run, series, &asked, frame.truth, picture, try_bounce ? spare : 0);
        }
        if (run_checking(run))
            judge_stability(run, &asked, frame.truth, picture,
                            try_bounce && scene.light_count > 0 ? &rigs[0].reflective : NULL);

        for (size_t i = 0; i < scene.light_count; i++) {
            map_delete(&rigs[i].map);
            raster_reflective_map_delete(&rigs[i].reflective);
            gl_texture_delete(&visibility[i]);
        }
        free(rigs);
        free(visibility);
        free(scene.lights);
        gl_texture_delete(&picture);
        gl_texture_delete(&spare);
        raster_gbuffer_delete(&gbuffer);
        truth_close(frame.truth);
        judge_scene_free(&frame.judged);
        if (run_deforming(run))
            sway_end(&scene);
        raster_mesh_delete(&mesh);
    }
    free(series);
    rsm_close(&rsm);
    map_shaders_close(&shaders);
    raster_close(raster);
    return run_close(run);
}
