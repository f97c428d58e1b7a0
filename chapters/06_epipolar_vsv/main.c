// 06 epipolar voxelized shadow volumes: which parts of a room's air lie in shadow, found for all light rays and asked for all view rays at once, in a grid whose
// axes run along both.
//
// You should see the scene in clear air; then the grid laid flat, its voxels where surfaces begin to cast shadow; then scanned, with all that lies behind them;
// how much of each view ray is in shadow; the light that the medium scatters; and the picture.
// Source: Wyman, "Voxelized shadow volumes" (2011).
#include "baseline.h"
#include "cell24.h"
#include "judge.h"
#include "triangles_vsv.h"
#include "vsv_scenes.h"

#include <stdlib.h>
#include <string.h>

static const char *const scenes[] = {"fence", "toroid", "colonnade", "forest",
                                     "bunny", "cell24", "crowd",     NULL};

// clang-format off
static const RunParameter parameters[] = {
    {.name = "method", .kind = RUN_CHOICE, .choices = "map conservative solid rays march equiangular segments", .shows = "how voxels are found; or the same picture by shadow rays at the grid's angles, or by brute force on the map"},
    {.name = "alpha", .kind = RUN_INTEGER, .least = 1, .most = 4096, .initial = {512}, .unit = "voxels", .shows = "view rays in a slice"},
    {.name = "theta", .kind = RUN_INTEGER, .least = 1, .most = 8192, .initial = {1024}, .unit = "voxels", .shows = "slices about the line from eye to light"},
    {.name = "phi", .kind = RUN_CHOICE, .choices = "512 128 256 1024", .shows = "light rays in a slice"},
    {.name = "warp", .kind = RUN_CHOICE, .choices = "even square", .shows = "how light rays are spread over a slice"},
    {.name = "slices", .kind = RUN_CHOICE, .choices = "uniform pixel", .shows = "slices at equal angles, or at most a pixel apart"},
    {.name = "range", .kind = RUN_CHOICE, .choices = "seen full", .shows = "what the grid covers: what the picture shows, or all angles"},
    {.name = "scan", .kind = RUN_CHOICE, .choices = "columns", .shows = "how the shadow behind a voxel is found"},
    {.name = "integral", .kind = RUN_CHOICE, .choices = "runs", .shows = "airlight from bits: closed forms of lit runs"},
    {.name = "steps", .kind = RUN_INTEGER, .least = 1, .most = 16384, .initial = {64}, .unit = "samples", .shows = "march, equiangular: samples a ray"},
    {.name = "phase", .kind = RUN_CHOICE, .choices = "uniform rayleigh henyey_greenstein hoffman_preetham hoffman_preetham_normalized", .shows = "how scattered light is shared out; mean_cosine is g"},
    {.name = "rayleigh_share", .kind = RUN_NUMBER, .least = 0, .most = 1, .initial = {0.3}, .shows = "Hoffman and Preetham: Rayleigh's share of the scattering"},
    {.name = "map", .kind = RUN_INTEGER, .least = 16, .most = 8192, .initial = {1024}, .unit = "texels", .shows = "a side of the depth maps"},
    {.name = "ambient", .kind = RUN_NUMBER, .least = 0, .most = 1e6, .initial = {0.05}, .unit = "W/(sr·m²)", .shows = "light on every surface, times its albedo"},
    {.name = NULL},
};
// clang-format on

static const RunStep steps[] = {
    {"map", "the scene in clear air, lit through the light's depth map"},
    {"voxels", "the grid laid flat, α to the right, θ upwards: where surfaces begin to cast shadow"},
    {"scanned", "and all that lies behind them on their light rays"},
    {"counts", "how much of each view ray is in shadow"},
    {"airlight", "the light that the medium scatters towards the eye"},
    {"picture", "and the surfaces behind it"},
    {NULL, NULL},
};

static const RunAbout about = {
    .chapter = "06_epipolar_vsv",
    .title = "Epipolar voxelized shadow volumes",
    .shows = "shadows in a medium from bits in a grid whose axes run along light rays and view rays",
    .source = "Wyman 2011",
    .uses = RUN_USES_CAMERA | RUN_USES_LIGHT | RUN_USES_MEDIUM | RUN_USES_DEFORM,
    .scenes = scenes,
    .own_scenes = vsv_scenes,
    .parameters = parameters,
    .steps = steps,
    .sweep = judge_sweep,
    .stability = judge_cases,
};

enum { CLEAR, VOXELS, SCANNED, COUNTS, AIRLIGHT, PICTURE, PICTURES }; // in the order of `steps`

static void draw_counts(const Query *query, const Vsv *vsv, const QueryView *view, const RasterTarget *target)
{
    raster_target_clear(target);
    query_counts(query, vsv, view, target->texture);
}

static const char *const NO_GRID = "rays ask the scene itself";

// The rays' own speed stands beside that of a bare loop over a share of them.
static void draw_rays(Run *run, const Rays *rays, const Vsv *vsv, const QueryView *view,
                      const AirlightSettings *settings, GLuint picture)
{
    const RaysCount count = baseline_airlight(rays, vsv, view, settings, picture);
    run_count(run, "rays", count.rays);
    if (run_measuring_error(run))
        return;
    enum { STRIDE = 16 };
    const RaysCount bare = baseline_bare(rays, vsv, view, settings, STRIDE);
    note("%.4g rays, %.3g million a second; in a bare loop %.3g", count.rays,
         count.rays / count.seconds / 1e6, bare.rays / bare.seconds / 1e6);
}

int main(int argc, char **argv)
{
    Run *run = run_open(&about, argc, argv);
    Raster *raster = raster_open();
    AirlightHaze haze = airlight_haze_open();
    Shader *flat = shader_open("the grid laid flat", NULL, "06_epipolar_vsv/show.comp");
    while (run_setting(run)) {
        // What moves is a copy; all else is the scene itself.
        const bool deforming = run_deforming(run);
        if (deforming && strcmp(run_scene(run)->name, "cell24") != 0)
            fail_request("--path deform: scene %s keeps its shape; cell24 changes it", run_scene(run)->name);
        Scene moved = deforming ? cell24_begin(run_scene(run)) : (Scene){0};
        const Scene *scene = deforming ? &moved : run_scene(run);
        const int width = run_width(run), height = run_height(run);
        const vec3 extinction = scene->medium.scattering + scene->medium.absorption;
        const size_t lights = scene->light_count;
        const bool by_rays = run_chosen(run, "method", "rays");
        const bool geometric = triangles_method(run_choice(run, "method"));
        const bool brute = !by_rays && !geometric && !run_chosen(run, "method", "map");
        const AirlightSettings settings = {.method = brute ? run_choice(run, "method") : "march",
                                           .variant = "intervals",
                                           .phase = run_choice(run, "phase"),
                                           .steps = run_integer(run, "steps"),
                                           .nodes = 16,
                                           .rayleigh_share = (float)run_number(run, "rayleigh_share"),
                                           .seed = (uint32_t)run_seed(run),
                                           .shadowed = true,
                                           .grey = extinction[0] == extinction[1] &&
                                                   extinction[1] == extinction[2],
                                           .count = !run_measuring_error(run)};
        const VsvSettings size = {.alpha = run_integer(run, "alpha"),
                                  .theta = run_integer(run, "theta"),
                                  .phi = atoi(run_choice(run, "phi")),
                                  .scan = run_choice(run, "scan"),
                                  .warp = run_choice(run, "warp"),
                                  .slices = run_choice(run, "slices")};
        Rays *rays = by_rays ? rays_open(&scene->mesh) : NULL;
        RasterView view = raster_view_open(raster, scene, width, height, run_integer(run, "map"));
        Airlight march = {0};
        Query query = {0};
        Triangles triangles = {0};
        if (geometric) {
            triangles = triangles_open(&(TrianglesSettings){.solid = run_chosen(run, "method", "solid")});
            if (triangles.settings.solid)
                triangles_need_closed(scene);
        }
        Vsv *vsv = memory_new(lights + 1, sizeof *vsv, "volumes");
        if (brute)
            march = airlight_open(&settings, view.maps, lights);
        else
            query = query_open(&settings, &size, run_choice(run, "integral"), view.maps, lights);
        for (size_t i = 0; i < lights && !brute; i++)
            vsv[i] = vsv_open(&size, &view.maps[i]);
        RasterTarget picture[PICTURES];
        for (int i = 0; i < PICTURES; i++)
            picture[i] = raster_target_open(steps[i].name, width, height);

        while (run_frame(run)) {
            const Camera camera = run_camera(run);
            if (deforming && run_pass_common(run, "deform", true, NULL)) {
                cell24_turn(&moved, run_frame_number(run), &view.mesh);
                if (by_rays) {
                    rays_close(rays);
                    rays = rays_open(&scene->mesh);
                }
            }
            if (run_pass_common(run, "depth maps", lights > 0, "the scene has no light"))
                raster_view_draw_maps(&view);
            if (run_pass_common(run, "G-buffer", true, NULL))
                raster_gbuffer_draw(raster, &view.gbuffer, &camera, &view.mesh);
            if (run_pass_common(run, "surfaces", true, NULL)) {
                raster_light_begin(raster, &view.gbuffer, picture[CLEAR].texture,
                                   (float)run_number(run, "ambient"));
                for (size_t i = 0; i < lights; i++)
                    raster_light_add(raster, &view.gbuffer, &camera, &scene->lights[i], &view.maps[i],
                                     picture[CLEAR].texture);
            }
            run_step(run, "map", picture[CLEAR].texture);

            QueryView seen = {.scene = scene, .camera = &camera, .gbuffer = &view.gbuffer};
            for (size_t i = 0; i < lights && !brute; i++) {
                seen.light = &scene->lights[i];
                seen.map = &view.maps[i];
                if (run_pass(run, "range", true, NULL)) {
                    const EpipolarFrame frame = epipolar_frame(&camera, seen.light);
                    EpipolarRange range = run_chosen(run, "range", "full")
                                              ? epipolar_range_full(size.alpha, size.theta, size.phi)
                                              : epipolar_range_seen(&frame, &camera, run_aspect(run),
                                                                    size.alpha, size.theta, size.phi);
                    if (triangles.settings.solid)
                        range.alpha_least = 0.0f; // see triangles.h
                    vsv_aim(&vsv[i], &frame, &range, &camera, width, height);
                    if (!run_chosen(run, "range", "full") || frame.at_infinity)
                        query_range(&query, &vsv[i], &seen, picture[AIRLIGHT].texture);
                }
                if (run_pass(run, "clear", !by_rays, NO_GRID))
                    vsv_clear(&vsv[i]);
                if (geometric && run_pass(run, "extents", true, NULL)) {
                    triangles_vsv_list(&triangles, &view.mesh, &vsv[i], seen.light);
                    run_skipped(run, triangles.counted.outside, (double)scene->mesh.triangle_count);
                    run_count(run, "items", triangles.counted.items);
                }
                if (run_pass(run, "voxels", !by_rays, NO_GRID)) {
                    if (geometric)
                        triangles_vsv_fill(&triangles, &view.mesh, &vsv[i], seen.light);
                    else
                        vsv_voxelize_map(&vsv[i], seen.light, seen.map);
                }
                if (i == 0 && run_pass_common(run, "show voxels", run_step_shown(run, "voxels"),
                                              "another picture is shown"))
                    vsv_show(&vsv[i], flat, picture[VOXELS].texture, width, height);
            }
            run_step(run, "voxels", picture[VOXELS].texture);
            for (size_t i = 0; i < lights && !brute; i++)
                if (run_pass(run, "scan", !by_rays, NO_GRID))
                    vsv_scan(&vsv[i]);
            if (lights > 0 && !brute &&
                run_pass_common(run, "show scanned", run_step_shown(run, "scanned"),
                                "another picture is shown"))
                vsv_show(&vsv[0], flat, picture[SCANNED].texture, width, height);
            run_step(run, "scanned", picture[SCANNED].texture);
            if (lights > 0 && !brute &&
                run_pass_common(run, "counts", run_step_shown(run, "counts"), "another picture is shown"))
                draw_counts(&query, &vsv[0], &seen, &picture[COUNTS]);
            run_step(run, "counts", picture[COUNTS].texture);
            if (run_pass(run, "airlight", true, NULL)) {
                raster_target_clear(&picture[AIRLIGHT]);
                for (size_t i = 0; i < lights; i++) {
                    seen.light = &scene->lights[i];
                    seen.map = &view.maps[i];
                    if (brute)
                        airlight_add(&march, &view.gbuffer, &camera, scene, seen.light, seen.map,
                                     picture[AIRLIGHT].texture);
                    else if (by_rays)
                        draw_rays(run, rays, &vsv[i], &seen, &settings, picture[AIRLIGHT].texture);
                    else
                        query_airlight(&query, &vsv[i], &seen, picture[AIRLIGHT].texture);
                }
            }
            run_step(run, "airlight", picture[AIRLIGHT].texture);
            if (run_pass_common(run, "sum", true, NULL))
                airlight_sum(&haze, &view.gbuffer, 1.0f, picture[CLEAR].texture, picture[AIRLIGHT].texture,
                             picture[PICTURE].texture);
            run_step(run, "picture", picture[PICTURE].texture);
            if (run_truth_wanted(run)) {
                const float ambient =
                    run_step_shown(run, "airlight") ? -1.0f : (float)run_number(run, "ambient");
                Image truth = judge_truth(scene, &camera, width, height, &settings, ambient);
                run_truth(run, &truth);
                image_free(&truth);
            }
        }
        const Camera camera = run_camera(run);
        const RenderSettings all = {.airlight = settings,
                                    .volume = size,
                                    .integral = run_choice(run, "integral"),
                                    .full = run_chosen(run, "range", "full"),
                                    .map = run_integer(run, "map")};
        Image got = raster_target_read(&picture[AIRLIGHT], width, height);
        if (run_measuring_error(run))
            judge_errors(run, raster, scene, &camera, &all, &got);
        else if (run_checking(run))
            judge_case(run, raster, &camera, &all, &got);
        image_free(&got);

        rays_close(rays);
        if (deforming)
            cell24_end(&moved);
        for (size_t i = 0; i < lights && !brute; i++)
            vsv_close(&vsv[i]);
        free(vsv);
        triangles_close(&triangles);
        if (brute)
            airlight_close(&march);
        else
            query_close(&query);
        for (int i = 0; i < PICTURES; i++)
            raster_target_close(&picture[i]);
        raster_view_close(&view);
    }
    shader_close(flat);
    airlight_haze_close(&haze);
    raster_close(raster);
    return run_close(run);
}
