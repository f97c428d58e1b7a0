// technique: see technique.h.
#include "technique.h"

#include <stdlib.h>

static const char *const AT_EYE = "the light sees what the eye sees";
static const char *const NO_GRID = "rays ask the scene itself";

static void check_settings(const Run *run, const Technique *technique)
{
    const bool window = technique->asked.textured;
    if (window && technique->brute && !run_chosen(run, "method", "equiangular"))
        fail_request("--set method=%s: knows no texture; of brute force only equiangular does",
                     run_choice(run, "method"));
    if (window && !technique->brute && !run_chosen(run, "integral", "riemann") &&
        !run_chosen(run, "integral", "factored"))
        fail_request("--set texture=window: integral=%s knows no texture; riemann and factored do",
                     run_choice(run, "integral"));
}

// Triangles and rays have grids of their own making, which no table spreads.
static void check_spread(const Run *run, const Technique *technique)
{
    if ((technique->geometric || technique->by_rays) && vsv_spreads(&technique->size))
        fail_request("--set warp=borders: is for voxels from a map; method=%s takes even or square",
                     run_choice(run, "method"));
}

static AirlightSettings airlight_settings(const Run *run, bool brute)
{
    const vec3 extinction = run_scene(run)->medium.scattering + run_scene(run)->medium.absorption;
    return (AirlightSettings){.method = brute ? run_choice(run, "method") : "march",
                              .variant = "intervals",
                              .phase = run_choice(run, "phase"),
                              .steps = run_integer(run, "steps"),
                              .nodes = 16,
                              .rayleigh_share = (float)run_number(run, "rayleigh_share"),
                              .seed = (uint32_t)run_seed(run),
                              .shadowed = true,
                              .grey = extinction[0] == extinction[1] && extinction[1] == extinction[2],
                              .count = !run_measuring_error(run)};
}

Technique technique_open(const Run *run, const RasterView *view)
{
    const size_t lights = view->scene->light_count;
    Technique t = {.geometric = triangles_method(run_choice(run, "method")),
                   .solid = run_chosen(run, "method", "solid"),
                   .seen = run_chosen(run, "range", "seen"),
                   .size = {.alpha = run_integer(run, "alpha"),
                            .theta = run_integer(run, "theta"),
                            .phi = atoi(run_choice(run, "phi")),
                            .scan = run_choice(run, "scan"),
                            .warp = run_choice(run, "warp"),
                            .slices = run_choice(run, "slices"),
                            .shape = run_choice(run, "shape")},
                   .asked = {.integral = run_choice(run, "integral"),
                             .slice = atoi(run_choice(run, "slice")),
                             .filtered = run_chosen(run, "filter", "epipolar"),
                             .textured = run_chosen(run, "texture", "window")}};
    t.by_rays = t.asked.rays = run_chosen(run, "method", "rays");
    t.samples = run_integer(run, "samples");
    t.brute = !t.by_rays && !t.geometric && !run_chosen(run, "method", "map");
    t.rays = t.by_rays ? rays_open(&view->scene->mesh) : NULL;
    t.bounded = run_chosen(run, "method", "bounds");
    t.airlight = airlight_settings(run, t.brute);
    if (t.bounded)
        t.airlight.shader = "06_epipolar_vsv/bounds.comp";
    check_settings(run, &t);
    check_spread(run, &t);
    if (t.geometric) {
        t.triangles = triangles_open(&(TrianglesSettings){run_choice(run, "method"),
                                                          triangles_splits(run_choice(run, "split")),
                                                          run_integer(run, "parts")});
        if (t.solid)
            triangles_need_closed(view->scene);
    }
    t.vsv = memory_new(lights + 1, sizeof *t.vsv, "volumes");
    t.at_eye = memory_new(lights + 1, sizeof *t.at_eye, "volumes");
    t.bounds = memory_new(lights + 1, sizeof *t.bounds, "bounds");
    for (size_t i = 0; i < lights && t.bounded; i++)
        t.bounds[i] =
            bounds_open(view->scene, &view->scene->lights[i], view->gbuffer.width, view->gbuffer.height);
    if (t.brute && !t.asked.textured) {
        t.march = airlight_open(&t.airlight, view->maps, lights);
        return t;
    }
    if (t.brute) { // what colours light rays stands in epipolar space; no volume is needed
        t.asked.integral = "march";
        t.size.alpha = t.size.theta = 1;
        t.size.phi = 128;
    }
    t.query = query_open(&t.asked, &t.airlight, &t.size, view->maps, lights);
    for (size_t i = 0; i < lights; i++)
        t.vsv[i] = vsv_open(&t.size, &view->maps[i]);
    return t;
}

void technique_close(Technique *technique, size_t lights)
{
    for (size_t i = 0; i < lights; i++)
        vsv_close(&technique->vsv[i]);
    free(technique->vsv);
    free(technique->at_eye);
    for (size_t i = 0; i < lights && technique->bounded; i++)
        bounds_close(&technique->bounds[i]);
    free(technique->bounds);
    triangles_close(&technique->triangles);
    rays_close(technique->rays);
    airlight_close(&technique->march);
    query_close(&technique->query);
}

QueryView technique_view(const RasterView *view, const Camera *camera, size_t light)
{
    return (QueryView){.scene = view->scene,
                       .light = &view->scene->lights[light],
                       .map = &view->maps[light],
                       .camera = camera,
                       .gbuffer = &view->gbuffer};
}

static void aim(const Technique *technique, Vsv *vsv, const QueryView *asked)
{
    const int width = asked->gbuffer->width, height = asked->gbuffer->height;
    const VsvSettings *size = &technique->size;
    const EpipolarFrame frame = epipolar_frame(asked->camera, asked->light);
    EpipolarRange range = technique->seen
                              ? epipolar_range_seen(&frame, asked->camera, (float)width / (float)height,
                                                    size->alpha, size->theta, size->phi)
                              : epipolar_range_full(size->alpha, size->theta, size->phi);
    if (technique->solid)
        range.alpha_least = 0.0f; // see triangles.h
    vsv_aim(vsv, &frame, &range, asked->camera, width, height);
}

//[voxels
void technique_voxels(Technique *technique, Run *run, const RasterView *view, const Camera *camera,
                      size_t light, const TechniqueNeeds *needs, GLuint picture)
{
    Vsv *vsv = &technique->vsv[light];
    Triangles *triangles = &technique->triangles;
    const QueryView asked = technique_view(view, camera, light);
    const bool needed = needs->changed && (needs->casts || technique->by_rays);
    if (needs->changed)
        aim(technique, vsv, &asked);
    if (run_pass(run, "range", needed, needs->why_not)) {
        const bool apart = query_range(&technique->query, vsv, &asked, technique->seen, picture);
        technique->at_eye[light] = !apart;
        // what the same spacing would take for all angles
        const double turns = 2.0 * M_PI / (double)vsv->range.theta_span;
        run_skipped(run, round(vsv->settings.theta * (turns - 1.0)), round(vsv->settings.theta * turns));
    }
    const bool apart = !technique->at_eye[light], filled = needed && apart && !technique->by_rays;
    const char *why_not = technique->by_rays ? NO_GRID : apart ? needs->why_not : AT_EYE;
    if (vsv_spreads(&technique->size) && run_pass(run, "borders", filled, why_not))
        query_spread(&technique->query, vsv, &asked, picture);
    if (run_pass(run, "clear", filled, why_not))
        vsv_clear(vsv);
    if (technique->geometric && run_pass(run, "extents", filled, why_not)) {
        triangles_vsv_list(triangles, &view->mesh, vsv, asked.light);
        run_skipped(run, triangles->counted.outside, (double)view->scene->mesh.triangle_count);
        run_count(run, "items", triangles->counted.items);
    }
    if (run_pass(run, "voxels", filled, why_not)) {
        if (technique->geometric)
            triangles_vsv_fill(triangles, &view->mesh, vsv, asked.light);
        else
            vsv_voxelize_map(vsv, asked.light, asked.map);
    }
}
//]

void technique_scan(const Technique *technique, Run *run, const RasterView *view, const Camera *camera,
                    size_t light, const TechniqueNeeds *needs)
{
    const Vsv *vsv = &technique->vsv[light];
    const bool apart = !technique->at_eye[light];
    const bool needed = needs->changed && needs->casts && apart && !technique->by_rays;
    if (run_pass(run, "scan", needed, technique->by_rays ? NO_GRID : apart ? needs->why_not : AT_EYE)) {
        vsv_scan(vsv);
        run_count(run, "megabytes", (double)vsv->bytes / 1048576.0);
        if (technique->airlight.count)
            run_skipped(run, vsv_empty_columns(vsv), vsv->columns);
    }
    if (needs->changed && !(needs->casts && apart))
        vsv_light_all(vsv);
    const QueryView asked = technique_view(view, camera, light);
    const bool summed = apart && !technique->by_rays && query_prepares(&technique->query, vsv, asked.light);
    if (technique->query.prefixed &&
        run_pass(run, "prefix sums", needs->changed && summed, summed ? needs->why_not : AT_EYE))
        query_prepare(&technique->query, vsv, &asked);
}

// The rays' own speed stands beside that of a bare loop over a share of them.
static void draw_rays(Run *run, const Technique *technique, size_t light, const QueryView *asked,
                      GLuint picture)
{
    const Vsv *vsv = &technique->vsv[light];
    const RaysCount count =
        baseline_airlight(technique->rays, vsv, asked, &technique->airlight, technique->samples, picture);
    run_count(run, "rays", count.rays);
    if (!vsv->whole)
        query_beyond(&technique->query, vsv, asked, picture);
    if (run_measuring_error(run))
        return;
    enum { STRIDE = 16 };
    const RaysCount bare =
        baseline_bare(technique->rays, vsv, asked, &technique->airlight, technique->samples, STRIDE);
    note("%.4g rays, %.3g million a second; by the processors' own time %.3g, in a bare loop %.3g",
         count.rays, count.rays / count.seconds / 1e6, count.rays / count.processor_seconds / 1e6,
         bare.rays / bare.processor_seconds / 1e6);
}

void technique_moved(Technique *technique, const Scene *scene)
{
    if (technique->bounded)
        fail_request(
            "--set method=bounds: its shadow volumes stand still; --path deform goes with the other methods");
    if (technique->by_rays) {
        rays_close(technique->rays);
        technique->rays = rays_open(&scene->mesh);
    }
}

void technique_airlight(const Technique *technique, Run *run, const RasterView *view, const Camera *camera,
                        GLuint picture)
{
    const size_t lights = view->scene->light_count;
    const bool volume = !technique->brute || technique->asked.textured;
    uint32_t missed = 0, lookups = 0;
    for (size_t i = 0; i < lights; i++) {
        const QueryView asked = technique_view(view, camera, i);
        if (technique->brute && volume)
            aim(technique, &technique->vsv[i], &asked);
        if (technique->bounded) {
            bounds_draw(&technique->bounds[i], camera, view->gbuffer.width, view->gbuffer.height);
            run_count(run, "edges", (double)technique->bounds[i].edges);
        }
        if (technique->by_rays)
            draw_rays(run, technique, i, &asked, picture);
        else if (volume)
            query_airlight(&technique->query, &technique->vsv[i], &asked, picture);
        else
            airlight_add(&technique->march, asked.gbuffer, camera, asked.scene, asked.light, asked.map,
                         picture);
        if (technique->airlight.count) {
            uint32_t counted[2];
            const Vsv *vsv = &technique->vsv[i];
            airlight_counts(volume ? query_shader(&technique->query, vsv, asked.light) : &technique->march,
                            &counted[0], &counted[1]);
            missed += counted[0];
            lookups += counted[1];
        }
    }
    if (technique->airlight.count) {
        run_skipped(run, missed, (double)view->gbuffer.width * view->gbuffer.height * (double)lights);
        run_count(run, "lookups", lookups);
    }
}
