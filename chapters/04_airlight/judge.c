// judge: see judge.h.
#include "judge.h"
#include "closed_form.h"
#include "truth.h"

Image airlight_truth(const Scene *scene, const Camera *camera, int width, int height, int every,
                     const AirlightSettings *settings, float ambient)
{
    const TruthPhase phase = {settings->phase, (double)scene->medium.mean_cosine,
                              (double)settings->rayleigh_share};
    return truth_airlight_picture(scene, camera, width, height, every, &phase, ambient);
}

void airlight_errors(Run *run, AirlightKept *kept, const Raster *raster, const Camera *camera,
                     const AirlightSettings *settings, const Image *got)
{
    const Scene *scene = run_scene(run);
    const int width = got->width, height = got->height, every = truth_every(height);
    Image truth = airlight_truth(scene, camera, width, height, every, settings, -1.0f);
    Image some = image_every(got, every);
    run_image_errors(run, "truth", &some, &truth, "");
    image_free(&some);
    image_free(&truth);
    if (settings->exact) // no map
        return;
    AirlightSettings limit = *settings;
    limit.shadowed = !closed_form_is(settings->method);
    limit.method = limit.shadowed ? "segments" : "gauss";
    limit.variant = "intervals";
    limit.nodes = 24;
    limit.steps = 1; // neither has any: rows that differ in them have one picture
    limit = closed_form_settings(limit, 0);
    const Image *converged = airlight_picture_kept(kept, truth_hash_scene(scene), raster, scene, camera,
                                                   width, height, run_integer(run, "map"), &limit);
    run_image_errors(run, "converged", got, converged, "");
}
