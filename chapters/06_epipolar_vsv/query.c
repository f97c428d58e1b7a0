// query: see query.h.
#include "query.h"
#include "spread.h"

#include <stdlib.h>
#include <string.h>

static int integral_number(const char *integral)
{
    static const char *const names[] = {"runs", "riemann", "factored", "march"};
    if (strcmp(integral, "prefix") == 0 || strcmp(integral, "sparse") == 0)
        return 0; // where sums are of no use, runs are
    for (int i = 0; i < 4; i++)
        if (strcmp(names[i], integral) == 0)
            return i;
    fail_work("no integral '%s'", integral);
}

Query query_open(const QuerySettings *settings, const AirlightSettings *airlight, const VsvSettings *volume,
                 const DepthMap *maps, size_t map_count)
{
    enum { MARCH = 3 };
    char *spread = vsv_definitions(volume);
    char *definitions = text_format("%s\nSLICE %d\nFILTER %d\nTEXTURE %d", spread, settings->slice,
                                    settings->filtered, settings->textured);
    AirlightSettings with = *airlight;
    with.variant = "intervals"; // the brute force's; of no meaning here
    with.definitions = definitions;
    with.number = integral_number(settings->integral);
    Query query = {.textured = settings->textured,
                   .phi = gl_buffer(.label = "range of phi", .bytes = 3 * sizeof(float))};
    with.shader = with.number == MARCH ? "06_epipolar_vsv/march.comp" : "06_epipolar_vsv/airlight.comp";
    query.airlight = airlight_open(&with, maps, map_count);
    with.count = false;
    with.shader = "06_epipolar_vsv/range.comp";
    query.range = airlight_open(&with, maps, map_count);
    if (vsv_spreads(volume)) {
        query.weight = gl_buffer(.label = "weight of borders", .bytes = SPREAD_STEPS * sizeof(uint32_t));
        with.shader = "06_epipolar_vsv/borders.comp";
        query.borders = airlight_open(&with, maps, map_count);
    }
    with.shader = "06_epipolar_vsv/counts.comp";
    query.counts = airlight_open(&with, maps, map_count);
    with.shader = "06_epipolar_vsv/surface.comp";
    query.surface = airlight_open(&with, maps, map_count);
    with.shader = "06_epipolar_vsv/beyond.comp";
    if (settings->rays)
        query.beyond = airlight_open(&with, maps, map_count);
    query.prefixed = strcmp(settings->integral, "prefix") == 0;
    if (query.prefixed)
        query.prefix = prefix_open(airlight, volume, maps, map_count, settings->filtered);
    query.sparse_rows = strcmp(settings->integral, "sparse") == 0;
    if (query.sparse_rows)
        query.sparse = sparse_open(airlight, volume, maps, map_count);
    free(spread);
    free(definitions);
    return query;
}

void query_close(Query *query)
{
    airlight_close(&query->airlight);
    airlight_close(&query->range);
    airlight_close(&query->borders);
    airlight_close(&query->counts);
    airlight_close(&query->surface);
    airlight_close(&query->beyond);
    prefix_close(&query->prefix);
    sparse_close(&query->sparse);
    gl_buffer_delete(&query->phi);
    gl_buffer_delete(&query->weight);
}

static void ask(const Airlight *what, const Vsv *vsv, const QueryView *view, GLuint picture)
{
    vsv_bind(vsv, what->shader[view->map->kind]);
    airlight_add(what, view->gbuffer, view->camera, view->scene, view->light, view->map, picture);
}

bool query_range(const Query *query, Vsv *vsv, const QueryView *view, bool cut, GLuint picture)
{
    const float start[3] = {INFINITY, 0.0f, INFINITY};
    float phi[3];
    gl.NamedBufferSubData(query->phi, 0, sizeof start, start);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 5, query->phi);
    ask(&query->range, vsv, view, picture);
    gl_buffer_read(query->phi, 0, sizeof phi, phi);
    // The last light ray lies beyond the box, so that it is lit, and with it all that the grid does not cover; or beyond the window, whose corners are at most √2
    // times as far from the axis, and so dark.
    const float margin = query->textured ? 0.5f : 4.0f / (float)vsv->settings.phi;
    const float beyond =
        (1.0f + margin) * epipolar_phi_of_box(&vsv->frame, view->scene->lower, view->scene->upper);
    vsv->whole = phi[1] <= beyond;
    const bool any = phi[0] < phi[1] && phi[0] < beyond;
    if (cut || vsv->frame.at_infinity) {
        vsv->range.phi_least = any ? phi[0] : 0.0f;
        vsv->range.phi_most = any ? fminf(phi[1], beyond) : 1.0f; // no ray meets light, or none shadow
    }
    const float pixel = view->camera->vertical_fov_rad / (float)view->gbuffer->height;
    return vsv->frame.distance > 0.0f && (isinf(phi[2]) || vsv->frame.distance > pixel * phi[2]);
}

void query_spread(const Query *query, const Vsv *vsv, const QueryView *view, GLuint picture)
{
    enum { RAYS = 64, GROUPS = RAYS / 8 }; // a side of the picture, about
    const GBuffer *seen = view->gbuffer;
    const int side = seen->width > seen->height ? seen->width : seen->height;
    const Shader *shader = query->borders.shader[view->map->kind];
    const uint32_t none = 0;
    uint32_t weight[SPREAD_STEPS];
    gl.ClearNamedBufferData(query->weight, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &none);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 5, query->weight);
    vsv_bind(vsv, shader);
    airlight_bind(&query->borders, seen, view->camera, view->scene, view->light, view->map, picture);
    shader_set_int(shader, "stride", (side + RAYS - 1) / RAYS);
    gl.DispatchCompute(GROUPS, GROUPS, 1);
    gl.MemoryBarrier(GL_ALL_BARRIER_BITS);
    gl_buffer_read(query->weight, 0, sizeof weight, weight);
    spread_set(vsv->spread, vsv->range.phi, weight);
}

bool query_prepares(const Query *query, const Vsv *vsv, const Light *light)
{
    return query->prefixed && vsv_apart(vsv, light);
}

void query_prepare(const Query *query, const Vsv *vsv, const QueryView *view)
{
    prefix_weigh(&query->prefix, vsv, view);
    prefix_sum(&query->prefix, vsv, view);
}

const Airlight *query_shader(const Query *query, const Vsv *vsv, const Light *light)
{
    if (query->sparse_rows && vsv_apart(vsv, light))
        return &query->sparse.pixels;
    return query_prepares(query, vsv, light) ? prefix_shader(&query->prefix, vsv, light) : &query->airlight;
}

void query_airlight(const Query *query, const Vsv *vsv, const QueryView *view, GLuint picture)
{
    const Airlight *shader = query_shader(query, vsv, view->light);
    if (shader == &query->sparse.pixels) {
        sparse_airlight(&query->sparse, vsv, view, picture);
        return;
    }
    if (query_prepares(query, vsv, view->light))
        prefix_bind(&query->prefix, vsv, view);
    ask(shader, vsv, view, picture);
}

void query_counts(const Query *query, const Vsv *vsv, const QueryView *view, GLuint picture)
{
    ask(&query->counts, vsv, view, picture);
}

void query_beyond(const Query *query, const Vsv *vsv, const QueryView *view, GLuint picture)
{
    ask(&query->beyond, vsv, view, picture);
}

void query_surface(const Query *query, const Vsv *vsv, const QueryView *view, GLuint picture)
{
    gl.BindImageTexture(5, view->gbuffer->normal, 0, GL_FALSE, 0, GL_READ_ONLY, GL_RGBA16F);
    gl.BindImageTexture(6, view->gbuffer->albedo, 0, GL_FALSE, 0, GL_READ_ONLY, GL_RGBA16F);
    ask(&query->surface, vsv, view, picture);
}
