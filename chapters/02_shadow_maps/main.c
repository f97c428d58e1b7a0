// 02 shadow maps: which surfaces does a light reach?
//
// You should see the scene from the light, as distances; then the shadow that comparing with them gives, with its two failures; then what bias
// and filters make of it; then a sun and a lamp, which see more than a square.
// Why so: every later chapter asks, for points on surfaces and in the air, whether light arrives; millions of times a picture, so that one ray
// each is too slow. A depth map answers from memory, up to a texel.
// Source: Williams, "Casting curved shadows on curved surfaces" (1978); Gomes (2015), section 2.2; Brabec, Annen and Seidel (2002); Donnelly and
// Lauritzen (2006).
#include "judge.h"
#include "light.h"
#include "scenes.h"
#include <stdlib.h>

static const char *const scenes[] = {
    "bunny", "cornell", "colonnade", "fence", "chapters/02_shadow_maps/lamps.gltf", NULL};

// clang-format off
static const RunParameter parameters[] = {
    {.name = "kind", .kind = RUN_CHOICE, .choices = "own spot directional point", .shows = "the scene's own lights, or one of this kind made for it"},
    {.name = "map", .kind = RUN_CHOICE, .choices = "cube paraboloid", .shows = "how a point light's map covers all directions"},
    {.name = "fit", .kind = RUN_CHOICE, .choices = "view scene", .shows = "what a directional light's map covers"},
    {.name = "resolution", .kind = RUN_INTEGER, .least = 1, .most = 8192, .initial = {1024}, .unit = "texels", .shows = "a map has resolution^2 texels in all its faces"},
    {.name = "bias", .kind = RUN_CHOICE, .choices = "slope none constant normal", .shows = "how far a surface is taken nearer to the light than it is"},
    {.name = "bias_constant", .kind = RUN_NUMBER, .least = 0, .most = 1e8, .initial = {0.02}, .unit = "m", .shows = "bias=constant: distance"},
    {.name = "bias_slope", .kind = RUN_NUMBER, .least = 0, .most = 64, .initial = {1}, .unit = "texels", .shows = "bias=slope: texels along the surface"},
    {.name = "bias_normal", .kind = RUN_NUMBER, .least = 0, .most = 64, .initial = {1}, .unit = "texels", .shows = "bias=normal: texels off the surface where the light grazes it"},
    {.name = "filter", .kind = RUN_CHOICE, .choices = "pcf nearest variance", .shows = "one texel, the share of lit texels, or a bound from their mean and variance"},
    {.name = "radius", .kind = RUN_NUMBER, .least = 0.5, .most = 16, .initial = {1}, .unit = "texels", .shows = "half the side of the filter's box"},
    {.name = "minimum_variance", .kind = RUN_NUMBER, .least = 0, .most = 1e12, .initial = {1e-4}, .unit = "m2", .shows = "filter=variance: least variance of distances"},
    {.name = "bleeding", .kind = RUN_NUMBER, .least = 0, .most = 0.99, .initial = {0.2}, .shows = "filter=variance: light below this share is taken for bleeding"},
    {.name = "tessellation", .kind = RUN_NUMBER, .least = 0, .most = 64, .initial = {0.5}, .unit = "texels", .shows = "map=paraboloid: how far a straight edge may leave its arc; 0: triangles stay whole"},
    {.name = "ambient", .kind = RUN_NUMBER, .least = 0, .most = 1, .initial = {0.05}, .shows = "radiance of an unlit surface, of its albedo"},
    {.name = "show", .kind = RUN_CHOICE, .choices = "light visibility wrong", .shows = "the lit scene, the visibility of one light, or where it is wrong: red dark for lit, blue lit for dark"},
    {.name = NULL},
};
// clang-format on

static const RunStep steps[] = {
    {"depth", "the light's distances to what it sees, near white, far black"},
    {"compare", "shadow where something is nearer to the light, by one texel and no bias"},
    {"bias", "the same with the chosen bias"},
    {"filter", "the same with the chosen filter"},
    {"sun", "the same under a directional light"},
    {"point", "the same under a point light"},
    {NULL, NULL},
};

#define SWEEP(name, settings)                                                                                \
    {                                                                                                        \
        name, NULL, settings, NULL                                                                           \
    }
static const RunRow sweep[] = {
    SWEEP("spot", "kind=spot resolution=512 filter=nearest"),
    {NULL, NULL, NULL, NULL},
};

static const RunRow stability[] = {
    {NULL, NULL, NULL, NULL},
};

static const RunAbout about = {
    .chapter = "02_shadow_maps",
    .title = "Shadow maps",
    .shows =
        "which surfaces a light reaches, answered from a map of distances, and where that answer is wrong",
    .source =
        "Williams 1978; Gomes 2015, section 2.2; Brabec, Annen and Seidel 2002; Donnelly and Lauritzen 2006",
    .uses = RUN_USES_CAMERA | RUN_USES_LIGHT,
    .scenes = scenes,
    .own_scenes = shadow_scenes,
    .parameters = parameters,
    .steps = steps,
    .sweep = sweep,
    .stability = stability,
};

// why passes are left out
static const char *const SAME_MAP = "light, casters and what is asked are the last map's";
static const char *const SAME_VIEW = "eye, light and map are the last frame's";
static const char *const NOT_SHOWN = "its picture is not the one shown";
static const char *const NO_PIXEL = "the light reaches no pixel";
static const char *const NO_MOMENTS = "the filter asks for no moments";

static uint64_t hash_camera(Camera c)
{
    float values[] = {c.eye[0],    c.eye[1], c.eye[2], c.target[0], c.target[1],
                      c.target[2], c.up[0],  c.up[1],  c.up[2],     c.vertical_fov_rad};
    return hash_bytes(HASH_START, values, sizeof values);
}

// What a light's map is made from: the light, how the map lies, what is asked of it.
static uint64_t hash_map(const ShadowMap *map, const Light *light, const MapAsked *asked)
{
    uint64_t hash = hash_bytes(asked->hash, &map->depth.origin, 3 * sizeof(float));
    hash = hash_bytes(hash, &map->depth.to_clip, sizeof map->depth.to_clip);
    hash = hash_bytes(hash, &light->direction, 3 * sizeof(float));
    return hash_bytes(hash, &light->half_angle_rad, sizeof light->half_angle_rad);
}

// One light, its map, and what is known about the map of the last frame.
typedef struct Rig {
    ShadowMap map;
    MapAsked asked;
    uint64_t hash;
    bool new_map; // in this frame
} Rig;

static MapLookup lookup_of(const Run *run)
{
    const char *const sizes[] = {"bias_slope", NULL, "bias_constant", "bias_normal"};
    const MapBias biases[] = {BIAS_SLOPE, BIAS_NONE, BIAS_CONSTANT, BIAS_NORMAL};
    MapLookup lookup = {.filter = run_chosen(run, "filter", "nearest") ? FILTER_NEAREST
                                  : run_chosen(run, "filter", "pcf")   ? FILTER_PCF
                                                                       : FILTER_VARIANCE,
                        .radius = (float)run_number(run, "radius"),
                        .minimum_variance = (float)run_number(run, "minimum_variance"),
                        .bleeding = (float)run_number(run, "bleeding")};
    const char *const names[] = {"slope", "none", "constant", "normal"};
    for (int i = 0; i < 4; i++)
        if (run_chosen(run, "bias", names[i])) {
            lookup.bias = biases[i];
            lookup.bias_size = sizes[i] ? (float)run_number(run, sizes[i]) : 0.0f;
        }
    return lookup;
}

int main(int argc, char **argv)
{
    Run *run = run_open(&about, argc, argv);
    Raster *raster = raster_open();
    MapShaders shaders = map_shaders_open();
    while (run_setting(run)) {
        const int width = run_width(run), height = run_height(run);
        const bool pictures = run_picture_needed(run);
        const LightChoice kind = pictures && run_step_shown(run, "sun")     ? CHOICE_DIRECTIONAL
                                 : pictures && run_step_shown(run, "point") ? CHOICE_POINT
                                 : run_chosen(run, "kind", "own")           ? CHOICE_OWN
                                 : run_chosen(run, "kind", "spot")          ? CHOICE_SPOT
                                 : run_chosen(run, "kind", "directional")   ? CHOICE_DIRECTIONAL
                                                                            : CHOICE_POINT;
        const float tessellation = (float)run_number(run, "tessellation");
        const bool fit_view = run_chosen(run, "fit", "view");
        const MapLookup filtered = lookup_of(run);
        MapLookup biased = filtered, compared = filtered;
        biased.filter = compared.filter = FILTER_NEAREST;
        compared.bias = BIAS_NONE;

        Scene scene = *run_scene(run); // its own lights give way to those that are shown
        scene.lights = light_choose(run_scene(run), kind, run_integer(run, "light"), &scene.light_count);
        const size_t shown_light =
            (size_t)run_integer(run, "light") < scene.light_count ? (size_t)run_integer(run, "light") : 0;
        Camera camera = run_camera(run);
        RasterMesh mesh = raster_mesh(&scene);
        GBuffer gbuffer = raster_gbuffer(width, height);
        GLuint picture =
            gl_texture(.label = "picture", .format = GL_RGBA32F, .width = width, .height = height);
        Rig *rigs = memory_new(scene.light_count + 1, sizeof *rigs, "the lights' maps");
        GLuint *visibility = memory_new(scene.light_count + 1, sizeof *visibility, "the visibilities");
        for (size_t i = 0; i < scene.light_count; i++) {
            rigs[i].map = map_create(&scene, &scene.lights[i], run_chosen(run, "map", "paraboloid"),
                                     filtered.filter == FILTER_VARIANCE, run_integer(run, "resolution"),
                                     fit_view ? &camera : NULL, run_aspect(run));
            visibility[i] =
                gl_texture(.label = "visibility", .format = GL_R32F, .width = width, .height = height);
        }
        uint64_t last_eye = 0;

        while (run_frame(run)) {
            const bool first = run_frame_number(run) == 0;
            camera = run_camera(run);
            const bool new_eye = first || hash_camera(camera) != last_eye;
            last_eye = hash_camera(camera);
            free(scene.lights);
            scene.lights = light_choose(run_scene(run), kind, run_integer(run, "light"), &scene.light_count);

            if (run_pass_common(run, "G-buffer", new_eye, SAME_VIEW))
                raster_gbuffer_draw(raster, &gbuffer, &camera, &mesh);

            for (size_t i = 0; i < scene.light_count; i++) {
                const Light *light = &scene.lights[i];
                Rig *rig = &rigs[i];
                map_aim(&rig->map, &scene, light, fit_view ? &camera : NULL, run_aspect(run));
                if (run_pass(run, "receivers", true, NULL)) {
                    rig->asked = map_find_receivers(&shaders, &rig->map, light, &gbuffer, &camera, &filtered);
                    run_count(run, "pixels", rig->asked.pixels);
                }
                const uint64_t hash = hash_map(&rig->map, light, &rig->asked);
                const bool wanted = rig->asked.pixels > 0;
                rig->new_map = wanted && (first || hash != rig->hash);
                rig->hash = hash;
                const char *const why_not = wanted ? SAME_MAP : NO_PIXEL;
                MapCasters casters = {0};
                if (run_pass(run, "casters", rig->new_map, why_not)) {
                    casters = map_find_casters(&shaders, &rig->map, light, &mesh, &filtered, tessellation);
                    const double all = (double)rig->map.layers * rig->map.triangle_count;
                    run_skipped(run, all - casters.whole - casters.cut, all);
                    run_count(run, "cut", casters.cut);
                }
                if (run_pass(run, "depth map", rig->new_map, why_not)) {
                    map_draw(&shaders, &rig->map, light, &mesh, &casters);
                    run_skipped(run, rig->map.layers - rig->asked.layers, rig->map.layers);
                }
                if (rig->map.moments[0] && run_pass(run, "moments", rig->new_map, why_not))
                    map_filter_moments(&shaders, &rig->map, light, &filtered);
            }
            if (scene.light_count > 0 &&
                run_pass_common(run, "depth: paint", pictures && run_step_shown(run, "depth"), NOT_SHOWN))
                map_show(&shaders, &rigs[shown_light].map, picture, width, height);
            run_step(run, "depth", picture);
            (void)SAME_VIEW;
            (void)NO_MOMENTS;

            const MapLookup lookups[] = {compared, biased, filtered, filtered, filtered};
            const char *const passes[] = {"compare", "bias", "filter", "sun", "point"};
            for (int s = 0; s < 5; s++) {
                bool shown = pictures ? run_step_shown(run, passes[s]) : s == 2;
                if (run_pass_common(run, "ambient", shown, NOT_SHOWN))
                    raster_light_begin(raster, &gbuffer, picture, (float)run_number(run, "ambient"));
                for (size_t i = 0; i < scene.light_count; i++) {
                    if (run_pass(run, passes[s], shown, NOT_SHOWN))
                        map_visibility(&shaders, &rigs[i].map, &scene.lights[i], &gbuffer, &camera,
                                       &lookups[s], visibility[i]);
                    if (run_pass_common(run, "light", shown, NOT_SHOWN))
                        map_light(&shaders, &rigs[i].map, &scene.lights[i], &gbuffer, &camera, visibility[i],
                                  picture);
                }
                run_step(run, passes[s], picture);
            }
        }
        Asked asked = {&scene, camera, &gbuffer, visibility};
        if (run_measuring_error(run)) {
            Truth *truth = truth_open(&scene.mesh);
            Judgement j = judge(&asked, truth);
            run_error(run, "truth", "wrong", j.wrong);
            truth_close(truth);
        }

        for (size_t i = 0; i < scene.light_count; i++) {
            map_delete(&rigs[i].map);
            gl_texture_delete(&visibility[i]);
        }
        free(rigs);
        free(visibility);
        free(scene.lights);
        gl_texture_delete(&picture);
        raster_gbuffer_delete(&gbuffer);
        raster_mesh_delete(&mesh);
    }
    map_shaders_close(&shaders);
    raster_close(raster);
    return run_close(run);
}
