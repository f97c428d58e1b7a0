// oracle: see oracle.h.
#include "oracle.h"
#include "closed_form.h"
#include "truth.h"

#include <stdlib.h>
#include <string.h>

AirlightSettings oracle_settings(AirlightSettings settings, const char *oracle)
{
    settings.exact = strcmp(oracle, "map") == 0;
    if (strcmp(oracle, "quadrature") == 0) {
        settings.method = closed_form_is(settings.method) ? "gauss" : "segments";
        settings.variant = "intervals";
        settings.nodes = 24;
    }
    return settings;
}

static AirlightReach reach_of(const Scene *scene, const Light *light, const Camera *camera, int width,
                              int height)
{
    const size_t pixels = (size_t)width * (size_t)height;
    uint32_t *first = memory_new(pixels + 1, sizeof *first, "lit spans");
    TruthSpan *spans = truth_lit_picture(scene, light, camera, width, height, first);
    const size_t count = first[pixels];
    float *pairs = memory_new(2 * count + 2, sizeof *pairs, "lit spans"); // a buffer is never empty
    for (size_t i = 0; i < count; i++) {
        pairs[2 * i] = (float)spans[i].t0;
        pairs[2 * i + 1] = (float)spans[i].t1;
    }
    const AirlightReach reach = {
        gl_buffer(.label = "where the spans of rays begin", .bytes = (pixels + 1) * sizeof *first,
                  .data = first),
        gl_buffer(.label = "lit spans", .bytes = (2 * count + 2) * sizeof *pairs, .data = pairs)};
    free(first);
    free(spans);
    free(pairs);
    return reach;
}

AirlightReach *oracle_reach(const Scene *scene, const Camera *camera, int width, int height)
{
    AirlightReach *reach = memory_new(scene->light_count + 1, sizeof *reach, "lit spans");
    for (size_t i = 0; i < scene->light_count; i++)
        reach[i] = reach_of(scene, &scene->lights[i], camera, width, height);
    return reach;
}

void oracle_reach_free(AirlightReach *reach, const Scene *scene)
{
    for (size_t i = 0; reach && i < scene->light_count; i++) {
        gl_buffer_delete(&reach[i].first);
        gl_buffer_delete(&reach[i].spans);
    }
    free(reach);
}
