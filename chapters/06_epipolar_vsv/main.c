// 06 epipolar voxelized shadow volumes: which parts of a room's air lie in shadow, found for all light rays and asked for all view rays at once, in a grid whose
// axes run along both.
//
// You should see the scene in clear air; then the grid laid flat, its voxels where surfaces begin to cast shadow; then scanned, with all that lies behind them;
// how much of each view ray is in shadow; surfaces lit by their voxels; the light that the medium scatters; and the picture.
// Source: Wyman, "Voxelized shadow volumes" (2011).
#include "about.h"
#include "cell24.h"
#include "judge.h"
#include "technique.h"

#include <string.h>

// why passes are left out
static const char *const SAME_VIEW = "eye, lights and scene are the last frame's";
static const char *const NOT_SHOWN = "another picture is shown";
static const char *const NO_LIGHT = "the scene has no light";
static const char *const NO_CASTER = "nothing can cast a shadow into the view";
static const char *const NO_EXTINCTION = "the medium takes no light away";
static const char *const NO_SCATTERING = "the medium scatters nothing";
static const char *const NO_VOLUME = "the method builds no volume";

static uint64_t hash_vec3(uint64_t hash, vec3 v)
{
    return hash_bytes(hash, &v, 3 * sizeof(float));
}
static uint64_t hash_view(const Scene *scene, Camera c)
{
    uint64_t hash = hash_vec3(hash_vec3(hash_vec3(HASH_START, c.eye), c.target), c.up);
    for (size_t i = 0; i < scene->light_count; i++)
        hash = hash_vec3(hash_vec3(hash, scene->lights[i].position), scene->lights[i].direction);
    return hash;
}

static TechniqueNeeds needs_of(const Run *run, const Scene *scene, size_t light, const Camera *camera,
                               bool changed, bool asked)
{
    const bool casts = raster_can_shadow(scene, &scene->lights[light], camera, run_aspect(run));
    return (TechniqueNeeds){.changed = changed,
                            .casts = asked && casts,
                            .why_not = !changed ? SAME_VIEW
                                       : casts  ? NO_SCATTERING
                                                : NO_CASTER};
}

// Surfaces through the medium: what each light gives them is dimmed on both its ways.
static void draw_attenuated(const AirlightHaze *haze, const RasterView *view, const Camera *camera,
                            float ambient, const RasterTarget *one_light, const RasterTarget *into)
{
    const Scene *scene = view->scene;
    raster_target_clear(into);
    raster_light_begin(view->raster, &view->gbuffer, one_light->texture, ambient);
    airlight_haze_attenuate(haze, &view->gbuffer, camera, scene, NULL, one_light->texture, into->texture);
    for (size_t i = 0; i < scene->light_count; i++) {
        raster_target_clear(one_light);
        raster_light_add(view->raster, &view->gbuffer, camera, &scene->lights[i], &view->maps[i],
                         one_light->texture);
        airlight_haze_attenuate(haze, &view->gbuffer, camera, scene, &scene->lights[i], one_light->texture,
                                into->texture);
    }
}

int main(int argc, char **argv)
{
    Run *run = run_open(&epipolar_about, argc, argv);
    Raster *raster = raster_open();
    AirlightHaze haze = airlight_haze_open();
    Shader *flat = shader_open("the grid laid flat", NULL, "06_epipolar_vsv/show.comp");
    AirlightKept converged = {0};
    while (run_setting(run)) {
        // What moves is a copy; all else is the scene itself.
        const bool deforming = run_deforming(run);
        if (deforming && strcmp(run_scene(run)->name, "cell24") != 0)
            fail_request("--path deform: scene %s keeps its shape; cell24 changes it", run_scene(run)->name);
        Scene moved = deforming ? cell24_begin(run_scene(run)) : (Scene){0};
        const Scene *scene = deforming ? &moved : run_scene(run);
        const int width = run_width(run), height = run_height(run);
        const size_t lights = scene->light_count;
        const bool pictures = run_picture_needed(run);
        const bool scatters = vec3_length(scene->medium.scattering) > 0.0f;
        const bool extinguishes = vec3_length(scene->medium.scattering + scene->medium.absorption) > 0.0f;
        const float ambient = (float)run_number(run, "ambient");
        if (!extinguishes && strpbrk(scene->name, "./"))
            note("scene %s has no medium; --set scattering=0.05,0.05,0.05 gives it one", scene->name);
        RasterView view = raster_view_open(raster, scene, width, height, run_integer(run, "map"));
        Technique technique = technique_open(run, &view);
        RasterTarget picture[PICTURES], one_light = raster_target_open("one light", width, height);
        RasterTarget attenuated = raster_target_open("surfaces through the medium", width, height);
        for (int i = 0; i < PICTURES; i++)
            picture[i] = raster_target_open(epipolar_about.steps[i].name, width, height);
        uint64_t last_view = 0;

        while (run_frame(run)) {
            const Camera camera = run_camera(run);
            bool shown[PICTURES];
            for (int i = 0; i < PICTURES; i++)
                shown[i] = pictures && run_step_shown(run, epipolar_about.steps[i].name);
            const bool glows = !pictures || shown[AIRLIGHT] || shown[PICTURE];
            const bool flat_shown = shown[VOXELS] || shown[SCANNED] || shown[COUNTS] || shown[LIT_SURFACES];
            const bool clear = shown[CLEAR] || (shown[PICTURE] && !extinguishes);
            uint64_t view_now = hash_view(scene, camera);
            if (deforming && run_pass_common(run, "deform", true, NULL)) {
                const uint64_t shape = cell24_turn(&moved, run_frame_number(run), &view.mesh);
                view_now = hash_bytes(view_now, &shape, sizeof shape);
                technique_moved(&technique, scene);
            }
            // while measuring, frame 0 comes again and again
            const bool changed = run_frame_number(run) == 0 || view_now != last_view;
            last_view = view_now;
            bool any_casts = false;
            for (size_t i = 0; i < lights; i++)
                any_casts =
                    any_casts || raster_can_shadow(scene, &scene->lights[i], &camera, run_aspect(run));
            const bool asked = (glows && scatters) || flat_shown; // whether anything asks the volumes

            //[maps
            if (changed)
                raster_view_aim(&view); // also where no map is drawn: its origin is the light's place
            if (run_pass_common(run, "depth maps",
                                changed && lights > 0 &&
                                    (clear || shown[PICTURE] || (asked && (any_casts || technique.brute))),
                                lights == 0 ? NO_LIGHT
                                : !changed  ? SAME_VIEW
                                : asked     ? NO_CASTER
                                            : NO_SCATTERING))
                raster_view_draw_maps(&view);
            if (run_pass_common(run, "G-buffer", changed, SAME_VIEW))
                raster_gbuffer_draw(raster, &view.gbuffer, &camera, &view.mesh);
            if (run_pass_common(run, "surfaces", changed && clear, clear ? SAME_VIEW : NOT_SHOWN)) {
                raster_light_begin(raster, &view.gbuffer, picture[CLEAR].texture, ambient);
                for (size_t i = 0; i < lights; i++)
                    raster_light_add(raster, &view.gbuffer, &camera, &scene->lights[i], &view.maps[i],
                                     picture[CLEAR].texture);
            }
            run_step(run, "map", picture[CLEAR].texture);
            //]

            //[volumes
            const bool volumes = !technique.brute && lights > 0;
            for (size_t i = 0; i < lights && volumes; i++) {
                const TechniqueNeeds needs = needs_of(run, scene, i, &camera, changed, asked);
                technique_voxels(&technique, run, &view, &camera, i, &needs, picture[AIRLIGHT].texture);
            }
            const char *why_flat = volumes ? NOT_SHOWN : NO_VOLUME;
            if (run_pass_common(run, "show voxels", volumes && shown[VOXELS], why_flat) && volumes)
                vsv_show(&technique.vsv[0], flat, picture[VOXELS].texture, width, height);
            run_step(run, "voxels", picture[VOXELS].texture);

            for (size_t i = 0; i < lights && volumes; i++) {
                const TechniqueNeeds needs = needs_of(run, scene, i, &camera, changed, asked);
                technique_scan(&technique, run, &view, &camera, i, &needs);
            }
            if (run_pass_common(run, "show scanned", volumes && shown[SCANNED], why_flat) && volumes)
                vsv_show(&technique.vsv[0], flat, picture[SCANNED].texture, width, height);
            run_step(run, "scanned", picture[SCANNED].texture);
            //]

            if (run_pass_common(run, "counts", volumes && shown[COUNTS], why_flat) && volumes) {
                const QueryView first = technique_view(&view, &camera, 0);
                raster_target_clear(&picture[COUNTS]);
                query_counts(&technique.query, &technique.vsv[0], &first, picture[COUNTS].texture);
            }
            run_step(run, "counts", picture[COUNTS].texture);
            if (run_pass_common(run, "surfaces by voxels", volumes && shown[LIT_SURFACES], why_flat) &&
                volumes) {
                raster_light_begin(raster, &view.gbuffer, picture[LIT_SURFACES].texture, ambient);
                for (size_t i = 0; i < lights; i++) {
                    const QueryView each = technique_view(&view, &camera, i);
                    query_surface(&technique.query, &technique.vsv[i], &each, picture[LIT_SURFACES].texture);
                }
            }
            run_step(run, "surfaces", picture[LIT_SURFACES].texture);

            //[airlight
            if (run_pass(run, "airlight", changed && lights > 0 && scatters && glows,
                         lights == 0 ? NO_LIGHT
                         : !scatters ? NO_SCATTERING
                         : !changed  ? SAME_VIEW
                                     : NOT_SHOWN)) {
                raster_target_clear(&picture[AIRLIGHT]);
                technique_airlight(&technique, run, &view, &camera, picture[AIRLIGHT].texture);
            }
            run_step(run, "airlight", picture[AIRLIGHT].texture);
            if (run_pass_common(run, "attenuation", changed && shown[PICTURE] && extinguishes,
                                !extinguishes     ? NO_EXTINCTION
                                : !shown[PICTURE] ? NOT_SHOWN
                                                  : SAME_VIEW))
                draw_attenuated(&haze, &view, &camera, ambient, &one_light, &attenuated);
            if (run_pass_common(run, "sum", changed && shown[PICTURE],
                                shown[PICTURE] ? SAME_VIEW : NOT_SHOWN))
                airlight_sum(&haze, &view.gbuffer, 1.0f,
                             extinguishes ? attenuated.texture : picture[CLEAR].texture,
                             picture[AIRLIGHT].texture, picture[PICTURE].texture);
            run_step(run, "picture", picture[PICTURE].texture);
            //]

            if (run_truth_wanted(run)) {
                Image truth = judge_truth(scene, &camera, width, height, 1, &technique.airlight,
                                          shown[AIRLIGHT] || !pictures ? -1.0f : ambient);
                run_truth(run, &truth);
                image_free(&truth);
            }
        }
        const Camera camera = run_camera(run);
        const RenderSettings all = {.airlight = technique.airlight,
                                    .volume = technique.size,
                                    .asked = technique.asked,
                                    .full = !technique.seen,
                                    .map = run_integer(run, "map")};
        Image got = raster_target_read(&picture[AIRLIGHT], width, height);
        if (run_measuring_error(run))
            judge_errors(run, &converged, raster, scene, &camera, &all, &got);
        else if (run_checking(run))
            judge_case(run, raster, &camera, &all, &got);
        image_free(&got);

        raster_target_close(&one_light);
        raster_target_close(&attenuated);
        for (int i = 0; i < PICTURES; i++)
            raster_target_close(&picture[i]);
        technique_close(&technique, lights);
        if (deforming)
            cell24_end(&moved);
        raster_view_close(&view);
    }
    image_free(&converged.image);
    shader_close(flat);
    airlight_haze_close(&haze);
    raster_close(raster);
    return run_close(run);
}
