// 04 airlight: how much of the light that crosses a misty room is turned towards the eye, and where is it missing because something stands in its way?
//
// You should see the scene in clear air; then its surfaces dimmed by the medium; then the medium's own glow, as if nothing stood in its way;
// then with the shadows that make beams of it.
// Why so: this integral, by brute force against the depth map, is what every volumetric shadow technique after it is measured against.
// Sources: Nishita et al. 1987 by way of Wyman 2011 (eq. 4, 5), Billeter et al. 2010 (eq. 1 to 3, section 5) and Chen et al. 2011 (eq. 1, 2); Kulla and Fajardo
// 2012 (equiangular); Dobashi et al. 2002 (factored); Sun et al. 2005; Pegoraro and Parker 2009.
#include "airlight.h"
#include "closed_form.h"
#include "judge.h"
#include "oracle.h"
#include "scenes.h"

#include <stdlib.h>
#include <string.h>

static const char *const scenes[] = {"colonnade", "bunny", "cornell", "fence", NULL};

// clang-format off
static const RunParameter parameters[] = {
    {.name = "method", .kind = RUN_CHOICE, .choices = "equiangular march jittered factored sun pegoraro gauss segments", .shows = "how the integral along a ray is found"},
    {.name = "variant", .kind = RUN_CHOICE, .choices = "intervals signed", .shows = "segments: each lit interval on its own, or signed integrals from the eye"},
    {.name = "steps", .kind = RUN_INTEGER, .least = 1, .most = 16384, .initial = {64}, .unit = "samples", .shows = "samples a ray"},
    {.name = "nodes", .kind = RUN_CHOICE, .choices = "auto 8 16 24", .shows = "gauss, segments: nodes a lit stretch; auto: 16, of a peaked phase function 24"},
    {.name = "table", .kind = RUN_INTEGER, .least = 2, .most = 1024, .initial = {64}, .unit = "texels", .shows = "sun: a side of the table of F"},
    {.name = "phase", .kind = RUN_CHOICE, .choices = "uniform rayleigh henyey_greenstein hoffman_preetham hoffman_preetham_normalized", .shows = "how scattered light is shared out; mean_cosine is g"},
    {.name = "rayleigh_share", .kind = RUN_NUMBER, .least = 0, .most = 1, .initial = {0.3}, .shows = "Hoffman and Preetham: Rayleigh's share of the scattering"},
    {.name = "map", .kind = RUN_INTEGER, .least = 16, .most = 8192, .initial = {1024}, .unit = "texels", .shows = "a side of the depth maps"},
    {.name = "oracle", .kind = RUN_CHOICE, .choices = "none map quadrature", .shows = "a stage made exact: the truth's visibility for the depth map's, or no sampling"},
    {.name = "ambient", .kind = RUN_NUMBER, .least = 0, .most = 1e6, .initial = {0.05}, .unit = "W/(sr·m²)", .shows = "light on every surface, times its albedo"},
    {.name = "show", .kind = RUN_CHOICE, .choices = "picture airlight", .shows = "all that reaches the eye, or the in-scattered radiance alone"},
    {.name = NULL},
};
// clang-format on

static const RunStep steps[] = {
    {"surfaces", "the scene in clear air"},
    {"attenuation", "its surfaces through the medium, dimmed on the way from light and to the eye"},
    {"unshadowed", "and the light that the medium scatters, as if nothing cast a shadow"},
    {"airlight", "and the shadows in it"},
    {NULL, NULL},
};

#define STEPS(method, n)                                                                                     \
    {                                                                                                        \
        method, NULL, "method=" method " steps=" #n, NULL                                                    \
    }
// Nothing casts, and the light is not before the eye: what orders of convergence are a smooth integrand's.
#define SMOOTH(method, n)                                                                                    \
    {                                                                                                        \
        method, "haze", "method=" method " steps=" #n " light_position=0.5,2,1", NULL                        \
    }
// Where a row's error comes from; rows without an oracle are among the others.
#define ORACLES(method, settings)                                                                            \
    {method, "cornell", "method=" settings " oracle=map", NULL},                                             \
    {                                                                                                        \
        method, "cornell", "method=" settings " oracle=quadrature", NULL                                     \
    }
// A file with its own camera, spot, candle and moon; but glTF knows no mist.
#define LAMPS(method, settings)                                                                              \
    {                                                                                                        \
        method, "chapters/02_shadow_maps/lamps.gltf",                                                        \
            "method=" settings " scattering=0.06,0.06,0.07 absorption=0.01,0.01,0.01", NULL                  \
    }
static const RunRow sweep[] = {
    STEPS("march", 16),
    STEPS("march", 64),
    STEPS("march", 256),
    STEPS("march", 1024),
    STEPS("jittered", 16),
    STEPS("jittered", 64),
    STEPS("jittered", 256),
    STEPS("jittered", 1024),
    STEPS("equiangular", 16),
    STEPS("equiangular", 64),
    STEPS("equiangular", 256),
    STEPS("equiangular", 1024),
    STEPS("factored", 16),
    STEPS("factored", 64),
    STEPS("factored", 256),
    STEPS("factored", 1024),
    {"sun", NULL, "method=sun", NULL},
    {"pegoraro", NULL, "method=pegoraro", NULL},
    {"gauss", NULL, "method=gauss nodes=8", NULL},
    {"gauss", NULL, "method=gauss nodes=16", NULL},
    {"segments", NULL, "method=segments nodes=8", NULL},
    {"segments", NULL, "method=segments nodes=16", NULL},
    {"segments", NULL, "method=segments nodes=24", NULL},
    {"signed", NULL, "method=segments variant=signed", NULL},
    SMOOTH("march", 16),
    SMOOTH("march", 64),
    SMOOTH("march", 256),
    SMOOTH("march", 1024),
    SMOOTH("jittered", 16),
    SMOOTH("jittered", 64),
    SMOOTH("jittered", 256),
    SMOOTH("jittered", 1024),
    ORACLES("march", "march steps=64"),
    ORACLES("equiangular", "equiangular steps=64"),
    ORACLES("factored", "factored steps=64"),
    ORACLES("sun", "sun"),
    ORACLES("pegoraro", "pegoraro"),
    ORACLES("segments", "segments nodes=8"),
    ORACLES("signed", "segments variant=signed"),
    LAMPS("march", "march steps=16"),
    LAMPS("march", "march steps=64"),
    LAMPS("march", "march steps=256"),
    LAMPS("march", "march steps=1024"),
    LAMPS("equiangular", "equiangular steps=16"),
    LAMPS("equiangular", "equiangular steps=64"),
    LAMPS("equiangular", "equiangular steps=256"),
    LAMPS("equiangular", "equiangular steps=1024"),
    LAMPS("gauss", "gauss"),
    LAMPS("segments", "segments"),
    {NULL, NULL, NULL, NULL},
};

static const RunAbout about = {
    .chapter = "04_airlight",
    .title = "Airlight",
    .shows = "light scattered once in a homogeneous medium, with shadows: by sampling, in closed form, by "
             "lit segments",
    .source = "Wyman 2011, Billeter et al. 2010, Chen et al. 2011; Kulla and Fajardo 2012, Dobashi et al. "
              "2002, Sun et al. 2005, "
              "Pegoraro and Parker 2009",
    .uses = RUN_USES_CAMERA | RUN_USES_LIGHT | RUN_USES_MEDIUM,
    .scenes = scenes,
    .own_scenes = airlight_scenes,
    .parameters = parameters,
    .steps = steps,
    .sweep = sweep,
    .stability = airlight_cases,
};

// why passes are left out
static const char *const SAME_VIEW = "eye, lights and medium are the last frame's";
static const char *const NOT_SHOWN = "its picture is not the one shown";
static const char *const AIRLIGHT_ALONE = "the airlight is shown alone";
static const char *const NO_LIGHT = "the scene has no light";
static const char *const NO_CASTER = "nothing can cast a shadow into the view";
static const char *const NO_SHADOW = "the method knows no shadow";
static const char *const EXACT = "oracle=map stands for them";
static const char *const NO_EXTINCTION = "the medium takes no light away";
static const char *const NO_SCATTERING = "the medium scatters nothing";

// What has not changed since the last frame is not built again.
static uint64_t hash_vec3(uint64_t hash, vec3 v)
{
    return hash_bytes(hash, &v, 3 * sizeof(float));
}
static uint64_t hash_camera(Camera c)
{
    return hash_vec3(hash_vec3(hash_vec3(HASH_START, c.eye), c.target), c.up);
}
static uint64_t hash_lights(const Scene *scene)
{
    uint64_t hash = HASH_START;
    for (size_t i = 0; i < scene->light_count; i++)
        hash = hash_vec3(hash_vec3(hash, scene->lights[i].position), scene->lights[i].direction);
    return hash;
}

// The methods that were derived for ρ = 1/4π alone.
static void check_phase(const Run *run)
{
    const bool derived_for_uniform =
        run_chosen(run, "method", "sun") || run_chosen(run, "method", "pegoraro");
    if (derived_for_uniform && !run_chosen(run, "phase", "uniform"))
        fail_request(
            "--set method=%s: holds for phase=uniform alone, not for %s; method=gauss or segments takes any",
            run_choice(run, "method"), run_choice(run, "phase"));
}

enum { SURFACES, ATTENUATED, UNSHADOWED, SHADOWED, PICTURES }; // in the order of `steps`

// One light after the other into `glow`, through the depth maps where `shadows` are wanted and can be; the method's shaders without and with lookups are
// compiled when they are first used.
static void draw_airlight(Run *run, const AirlightSettings *settings, Airlight by_shadow[2],
                          const RasterView *view, const AirlightReach *reach, const Camera *camera,
                          bool shadows, const RasterTarget *glow)
{
    const Scene *scene = view->scene;
    double missed = 0, lookups = 0;
    raster_target_clear(glow);
    for (size_t i = 0; i < scene->light_count; i++) {
        const bool cast = shadows && raster_can_shadow(scene, &scene->lights[i], camera, run_aspect(run));
        if (!by_shadow[cast].counters) {
            AirlightSettings with = *settings;
            with.shadowed = cast;
            with.exact = cast && settings->exact;
            by_shadow[cast] = airlight_open(&with, view->maps, scene->light_count);
        }
        if (reach)
            by_shadow[cast].reach = reach[i];
        airlight_add(&by_shadow[cast], &view->gbuffer, camera, scene, &scene->lights[i], &view->maps[i],
                     glow->texture);
        if (settings->count) {
            uint32_t counts[2];
            airlight_counts(&by_shadow[cast], &counts[0], &counts[1]);
            missed += counts[0];
            lookups += counts[1];
        }
    }
    if (settings->count) {
        run_skipped(run, missed, (double)run_width(run) * run_height(run) * (double)scene->light_count);
        run_count(run, "lookups", lookups);
    }
}

int main(int argc, char **argv)
{
    Run *run = run_open(&about, argc, argv);
    Raster *raster = raster_open();
    AirlightHaze haze = airlight_haze_open();
    AirlightKept converged = {0};
    while (run_setting(run)) {
        check_phase(run);
        const Scene *scene = run_scene(run);
        const int width = run_width(run), height = run_height(run);
        const Medium *medium = &scene->medium;
        const vec3 extinction = medium->scattering + medium->absorption;
        const bool scatters = vec3_length(medium->scattering) > 0.0f,
                   extinguishes = vec3_length(extinction) > 0.0f;
        const bool lit = scene->light_count > 0, pictures = run_picture_needed(run);
        const bool alone = run_chosen(run, "show", "airlight");
        const float ambient = (float)run_number(run, "ambient");
        if (!extinguishes && strpbrk(scene->name, "./"))
            note("scene %s has no medium; --set scattering=0.05,0.05,0.05 gives it one", scene->name);

        AirlightSettings settings = {.method = run_choice(run, "method"),
                                     .variant = run_choice(run, "variant"),
                                     .phase = run_choice(run, "phase"),
                                     .steps = run_integer(run, "steps"),
                                     .nodes = atoi(run_choice(run, "nodes")), // auto: 0
                                     .rayleigh_share = (float)run_number(run, "rayleigh_share"),
                                     .seed = (uint32_t)run_seed(run),
                                     .grey = extinction[0] == extinction[1] && extinction[1] == extinction[2],
                                     .shadowed = true, // where a comparison is drawn
                                     .count = !run_measuring_error(run)};
        GLuint table = run_chosen(run, "method", "sun") ? closed_form_table(run_integer(run, "table")) : 0;
        settings = closed_form_settings(oracle_settings(settings, run_choice(run, "oracle")), table);
        const bool knows_shadow = settings.exact || !closed_form_is(settings.method);
        RasterView view = raster_view_open(raster, scene, width, height, run_integer(run, "map"));
        Airlight airlight[2] = {0}; // without and with shadow
        RasterTarget picture[PICTURES], one_light = raster_target_open("one light", width, height);
        RasterTarget glow = raster_target_open("airlight", width, height);
        for (int i = 0; i < PICTURES; i++)
            picture[i] = raster_target_open(steps[i].name, width, height);
        AirlightReach *reach = NULL; // oracle=map: of the view that reach_view hashes
        uint64_t last_eye = 0, last_lights = 0, reach_view = 0;

        while (run_frame(run)) {
            Camera camera = run_camera(run);
            const bool first = run_frame_number(run) == 0; // while measuring, frame 0 comes again and again
            const bool new_eye = first || hash_camera(camera) != last_eye;
            const bool new_lights = first || hash_lights(scene) != last_lights,
                       changed = new_eye || new_lights;
            last_eye = hash_camera(camera);
            last_lights = hash_lights(scene);
            const uint64_t this_view = hash_bytes(last_eye, &last_lights, sizeof last_lights);
            if (settings.exact && (!reach || reach_view != this_view)) { // outside the passes' time
                oracle_reach_free(reach, scene);
                reach = oracle_reach(scene, &camera, width, height);
                reach_view = this_view;
            }

            // One picture is shown: what only another one needs is left out.
            const bool show_surfaces = pictures && run_step_shown(run, "surfaces");
            const bool show_attenuation = pictures && run_step_shown(run, "attenuation");
            const bool show_unshadowed = pictures && run_step_shown(run, "unshadowed");
            const bool show_airlight = !pictures || run_step_shown(run, "airlight");
            const bool behind =
                pictures && (show_attenuation || ((show_unshadowed || show_airlight) && !alone));
            const bool clear = show_surfaces || (behind && !extinguishes); // surfaces as clear air shows them
            bool cast = false;
            for (size_t i = 0; i < scene->light_count; i++)
                cast = cast || raster_can_shadow(scene, &scene->lights[i], &camera, run_aspect(run));
            const bool shadows = show_airlight && scatters && knows_shadow && cast;

            if (new_lights)
                raster_view_aim(&view);
            //[maps
            if (run_pass_common(run, "depth maps",
                                new_lights && lit && (clear || behind || (shadows && !settings.exact)),
                                !lit                                         ? NO_LIGHT
                                : !new_lights                                ? SAME_VIEW
                                : shadows && settings.exact                  ? EXACT
                                : show_airlight && scatters && !knows_shadow ? NO_SHADOW
                                                                             : NO_CASTER))
                raster_view_draw_maps(&view);
            if (run_pass_common(run, "G-buffer", new_eye, SAME_VIEW))
                raster_gbuffer_draw(raster, &view.gbuffer, &camera, &view.mesh);
            //]
            if (run_pass_common(run, "surfaces", changed && clear, clear ? SAME_VIEW : NOT_SHOWN)) {
                raster_light_begin(raster, &view.gbuffer, picture[SURFACES].texture, ambient);
                for (size_t i = 0; i < scene->light_count; i++)
                    raster_light_add(raster, &view.gbuffer, &camera, &scene->lights[i], &view.maps[i],
                                     picture[SURFACES].texture);
            }
            run_step(run, "surfaces", picture[SURFACES].texture);

            //[attenuation
            const bool dim = changed && behind && extinguishes;
            const char *why_clear = !extinguishes ? NO_EXTINCTION
                                    : alone       ? AIRLIGHT_ALONE
                                    : !behind     ? NOT_SHOWN
                                                  : SAME_VIEW;
            if (run_pass_common(run, "attenuation", dim, why_clear)) {
                raster_target_clear(&picture[ATTENUATED]);
                raster_light_begin(raster, &view.gbuffer, one_light.texture, ambient);
                airlight_haze_attenuate(&haze, &view.gbuffer, &camera, scene, NULL, one_light.texture,
                                        picture[ATTENUATED].texture);
                for (size_t i = 0; i < scene->light_count; i++) {
                    raster_target_clear(&one_light);
                    raster_light_add(raster, &view.gbuffer, &camera, &scene->lights[i], &view.maps[i],
                                     one_light.texture);
                    airlight_haze_attenuate(&haze, &view.gbuffer, &camera, scene, &scene->lights[i],
                                            one_light.texture, picture[ATTENUATED].texture);
                }
            }
            const GLuint surfaces = picture[extinguishes ? ATTENUATED : SURFACES].texture;
            run_step(run, "attenuation", surfaces);
            //]

            //[airlight
            const char *why_not = !lit        ? NO_LIGHT
                                  : !scatters ? NO_SCATTERING
                                  : !changed  ? SAME_VIEW
                                              : NOT_SHOWN;
            if (run_pass(run, "airlight without shadow", changed && lit && scatters && show_unshadowed,
                         why_not))
                draw_airlight(run, &settings, airlight, &view, reach, &camera, false, &glow);
            if (run_pass_common(run, "sum without shadow", changed && scatters && show_unshadowed, why_not))
                airlight_sum(&haze, &view.gbuffer, alone ? 0.0f : 1.0f, surfaces, glow.texture,
                             picture[UNSHADOWED].texture);
            run_step(run, "unshadowed",
                     scatters ? picture[UNSHADOWED].texture
                     : alone  ? glow.texture
                              : surfaces);

            if (run_pass(run, "airlight", changed && lit && scatters && show_airlight, why_not))
                draw_airlight(run, &settings, airlight, &view, reach, &camera, knows_shadow, &glow);
            if (run_pass_common(run, "sum", changed && scatters && pictures && show_airlight, why_not))
                airlight_sum(&haze, &view.gbuffer, alone ? 0.0f : 1.0f, surfaces, glow.texture,
                             picture[SHADOWED].texture);
            run_step(run, "airlight", scatters ? picture[SHADOWED].texture : alone ? glow.texture : surfaces);
            //]

            if (run_truth_wanted(run)) {
                Image truth =
                    airlight_truth(scene, &camera, width, height, 1, &settings, alone ? -1.0f : ambient);
                run_truth(run, &truth);
                image_free(&truth);
            }
        }
        Camera camera = run_camera(run);
        Image got = raster_target_read(&glow, width, height);
        if (run_measuring_error(run))
            airlight_errors(run, &converged, raster, &camera, &settings, &got);
        else if (run_checking(run))
            airlight_case(run, raster, &haze, &camera, &settings, &got);
        image_free(&got);

        raster_target_close(&glow);
        raster_target_close(&one_light);
        for (int i = 0; i < PICTURES; i++)
            raster_target_close(&picture[i]);
        for (int i = 0; i < 2; i++)
            airlight_close(&airlight[i]);
        oracle_reach_free(reach, scene);
        raster_view_close(&view);
        gl_texture_delete(&table);
    }
    image_free(&converged.image);
    airlight_haze_close(&haze);
    raster_close(raster);
    return run_close(run);
}
