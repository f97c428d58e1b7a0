// render: see render.h.
#include "render.h"

#include <stdlib.h>

void render_volume(Vsv *vsv, const Query *query, const QueryView *view, bool full, GLuint scratch)
{
    const GBuffer *seen = view->gbuffer;
    const VsvSettings *size = &vsv->settings;
    const EpipolarFrame frame = epipolar_frame(view->camera, view->light);
    const float aspect = (float)seen->width / (float)seen->height;
    const EpipolarRange range =
        full ? epipolar_range_full(size->alpha, size->theta, size->phi)
             : epipolar_range_seen(&frame, view->camera, aspect, size->alpha, size->theta, size->phi);
    vsv_aim(vsv, &frame, &range, view->camera, seen->width, seen->height);
    if (!query_range(query, vsv, view, !full, scratch)) {
        vsv_light_all(vsv);
        return;
    }
    if (vsv_spreads(size))
        query_spread(query, vsv, view, scratch);
    vsv_clear(vsv);
    vsv_voxelize_map(vsv, view->light, view->map);
    vsv_scan(vsv);
}

Image render_picture(const Raster *raster, const Scene *scene, const Camera *camera, int width, int height,
                     const RenderSettings *settings)
{
    RasterView view = raster_view_open(raster, scene, width, height, settings->map);
    RasterTarget target = raster_target_open("airlight to compare with", width, height);
    Query query =
        query_open(&settings->asked, &settings->airlight, &settings->volume, view.maps, scene->light_count);
    raster_view_draw_maps(&view);
    raster_gbuffer_draw(raster, &view.gbuffer, camera, &view.mesh);
    // As the program does: all volumes first, then what asks them.
    Vsv *vsv = memory_new(scene->light_count + 1, sizeof *vsv, "volumes");
    for (size_t i = 0; i < scene->light_count; i++) {
        const QueryView seen = {scene, &scene->lights[i], &view.maps[i], camera, &view.gbuffer};
        vsv[i] = vsv_open(&settings->volume, &view.maps[i]);
        render_volume(&vsv[i], &query, &seen, settings->full, target.texture);
        if (query_prepares(&query, &vsv[i], seen.light))
            query_prepare(&query, &vsv[i], &seen);
    }
    for (size_t i = 0; i < scene->light_count; i++) {
        const QueryView seen = {scene, &scene->lights[i], &view.maps[i], camera, &view.gbuffer};
        query_airlight(&query, &vsv[i], &seen, target.texture);
        vsv_close(&vsv[i]);
    }
    free(vsv);
    Image image = raster_target_read(&target, width, height);
    query_close(&query);
    raster_target_close(&target);
    raster_view_close(&view);
    return image;
}
