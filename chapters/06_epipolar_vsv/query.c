// query: see query.h.
#include "query.h"

#include <stdlib.h>
#include <string.h>

static int integral_number(const char *integral)
{
    static const char *const names[] = {"runs", "riemann", "factored"};
    for (int i = 0; i < 3; i++)
        if (strcmp(names[i], integral) == 0)
            return i;
    fail_work("no integral '%s'", integral);
}

Query query_open(const AirlightSettings *settings, const VsvSettings *volume, const char *integral,
                 const DepthMap *maps, size_t map_count)
{
    char *definitions = vsv_definitions(volume);
    AirlightSettings with = *settings;
    with.variant = "intervals"; // the brute force's; of no meaning here
    with.definitions = definitions;
    with.number = integral_number(integral);
    Query query = {.phi = gl_buffer(.label = "range of phi", .bytes = 2 * sizeof(uint32_t))};
    with.shader = "06_epipolar_vsv/airlight.comp";
    query.airlight = airlight_open(&with, maps, map_count);
    with.count = false;
    with.shader = "06_epipolar_vsv/range.comp";
    query.range = airlight_open(&with, maps, map_count);
    with.shader = "06_epipolar_vsv/counts.comp";
    query.counts = airlight_open(&with, maps, map_count);
    free(definitions);
    return query;
}

void query_close(Query *query)
{
    airlight_close(&query->airlight);
    airlight_close(&query->range);
    airlight_close(&query->counts);
    gl_buffer_delete(&query->phi);
}

static void ask(const Airlight *what, const Vsv *vsv, const QueryView *view, GLuint picture)
{
    vsv_bind(vsv, what->shader[view->map->kind]);
    airlight_add(what, view->gbuffer, view->camera, view->scene, view->light, view->map, picture);
}

void query_range(const Query *query, Vsv *vsv, const QueryView *view, GLuint picture)
{
    const float start[2] = {INFINITY, 0.0f};
    float phi[2];
    gl.NamedBufferSubData(query->phi, 0, sizeof start, start);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 5, query->phi);
    ask(&query->range, vsv, view, picture);
    gl_buffer_read(query->phi, 0, sizeof phi, phi);
    // The last light ray lies beyond the box, so that it is lit, and with it all that the grid does not cover.
    const float met = epipolar_phi_of_box(&vsv->frame, view->scene->lower, view->scene->upper),
                beyond = met * (1.0f + 4.0f / (float)vsv->settings.phi);
    const bool any = phi[0] < phi[1] && phi[0] < beyond;
    vsv->range.phi_least = any ? phi[0] : 0.0f;
    vsv->range.phi_most =
        any ? fminf(phi[1], beyond) : 1.0f; // no ray meets light, or none shadow: anything will do
}

void query_airlight(const Query *query, const Vsv *vsv, const QueryView *view, GLuint picture)
{
    ask(&query->airlight, vsv, view, picture);
}

void query_counts(const Query *query, const Vsv *vsv, const QueryView *view, GLuint picture)
{
    ask(&query->counts, vsv, view, picture);
}
