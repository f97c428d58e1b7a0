// judge: see judge.h.
#include "judge.h"
#include "closed_form.h"
#include "truth.h"

Image airlight_truth(const Scene *scene, const Camera *camera, int width, int height,
                     const AirlightSettings *settings, float ambient)
{
    const TruthPhase phase = {settings->phase, (double)scene->medium.mean_cosine,
                              (double)settings->rayleigh_share};
    return truth_airlight_picture(scene, camera, width, height, &phase, ambient);
}

void airlight_errors(Run *run, const Raster *raster, const Camera *camera, const AirlightSettings *settings,
                     const Image *got)
{
    const int width = got->width, height = got->height;
    Image truth = airlight_truth(run_scene(run), camera, width, height, settings, -1.0f);
    run_image_errors(run, "truth", got, &truth, "");
    image_free(&truth);
    if (settings->exact) // no map
        return;
    AirlightSettings limit = *settings;
    limit.shadowed = !closed_form_is(settings->method);
    limit.method = limit.shadowed ? "segments" : "gauss";
    limit.variant = "intervals";
    limit.nodes = 24;
    limit = closed_form_settings(limit, 0);
    Image converged =
        airlight_picture(raster, run_scene(run), camera, width, height, run_integer(run, "map"), &limit);
    run_image_errors(run, "converged", got, &converged, "");
    image_free(&converged);
}
