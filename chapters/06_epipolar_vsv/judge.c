// judge: see judge.h.
#include "judge.h"
#include "truth.h"

Image judge_truth(const Scene *scene, const Camera *camera, int width, int height, int every,
                  const AirlightSettings *settings, float ambient)
{
    const TruthPhase phase = {settings->phase, (double)scene->medium.mean_cosine,
                              (double)settings->rayleigh_share};
    return truth_airlight_picture(scene, camera, width, height, every, &phase, ambient);
}

void judge_errors(Run *run, AirlightKept *kept, const Raster *raster, const Scene *scene,
                  const Camera *camera, const RenderSettings *settings, const Image *got)
{
    const int width = got->width, height = got->height, every = truth_every(height);
    AirlightSettings limit = settings->airlight;
    limit.method = "segments";
    limit.shader = NULL;
    limit.variant = "intervals";
    limit.shadowed = true;
    limit.nodes = 24;
    limit.steps = 1; // segments have none: rows that differ in them have one picture
    const Image *converged = airlight_picture_kept(kept, truth_hash_scene(scene), raster, scene, camera,
                                                   width, height, settings->map, &limit);
    Image truth = judge_truth(scene, camera, width, height, every, &settings->airlight, -1.0f);
    Image some = image_every(got, every), some_converged = image_every(converged, every);
    run_image_errors(run, "converged", got, converged, "");
    run_image_errors(run, "truth", &some, &truth, "");
    // How much of the error no technique on this map could avoid.
    run_image_errors(run, "truth", &some_converged, &truth, "map_");
    image_free(&some);
    image_free(&some_converged);
    image_free(&truth);
}

// One sweep holds the paper's tables 2 (map), 3 (θ) and 4 (growth along α, θ, φ), the diagrams' fronts, and brute force on the same map.
const RunRow judge_sweep[] = {
    {"march", NULL, "method=march steps=64", NULL},
    {"march", NULL, "method=march steps=256", NULL},
    {"march", NULL, "method=march steps=1024", NULL},
    {"equiangular", NULL, "method=equiangular steps=16", NULL},
    {"equiangular", NULL, "method=equiangular steps=64", NULL},
    {"equiangular", NULL, "method=equiangular steps=256", NULL},
    {"equiangular", NULL, "method=equiangular steps=1024", NULL},
    // chapter 04's best at an equal error
    {"factored", NULL, "method=factored steps=64", NULL},
    {"factored", NULL, "method=factored steps=256", NULL},
    {"factored", NULL, "method=factored steps=512", NULL},
    {"bounds", NULL, "method=bounds steps=16", NULL},
    {"bounds", NULL, "method=bounds steps=64", NULL},
    {"bounds", NULL, "method=bounds steps=256", NULL},
    {"segments", NULL, "method=segments", NULL},
    {"map", NULL, "method=map theta=128", NULL},
    {"map", NULL, "method=map theta=256", NULL},
    {"map", NULL, "method=map theta=512", NULL},
    {"map", NULL, "method=map theta=1024", NULL},
    {"map", NULL, "method=map theta=2048", NULL},
    {"map", NULL, "method=map alpha=128", NULL},
    {"map", NULL, "method=map alpha=256", NULL},
    {"map", NULL, "method=map alpha=1024", NULL},
    {"map", NULL, "method=map phi=128", NULL},
    {"map", NULL, "method=map phi=256", NULL},
    {"map", NULL, "method=map phi=1024", NULL},
    {"map", NULL, "method=map map=512", NULL},
    {"map", NULL, "method=map map=2048", NULL},
    {"map", NULL, "method=map map=4096", NULL},
    {"map", NULL, "method=map warp=square", NULL},
    {"map", NULL, "method=map warp=borders", NULL},
    {"map", NULL, "method=map slices=pixel", NULL},
    {"map", NULL, "method=map warp=square slices=pixel theta=2048 map=2048", NULL},
    {"map", NULL, "method=map integral=riemann", NULL},
    {"map", NULL, "method=map integral=factored", NULL},
    {"map", NULL, "method=map filter=epipolar", NULL},
    {"prefix", NULL, "method=map integral=prefix", NULL},
    {"prefix", NULL, "method=map integral=prefix filter=epipolar", NULL},
    {"prefix", NULL, "method=map integral=prefix filter=epipolar warp=square", NULL},
    {"prefix", NULL, "method=map integral=prefix filter=epipolar warp=borders", NULL},
    {"sparse", NULL, "method=map integral=sparse", NULL},
    {"sparse", NULL, "method=map integral=sparse alpha=256", NULL},
    {"sparse", NULL, "method=map integral=sparse alpha=256 theta=512", NULL},
    {"map", NULL, "method=map scan=logstep", NULL},
    // What the figures of speed are of: --row runs,totals,rays,factored.
    {"runs", NULL, "method=map integral=runs", NULL},
    {"totals", NULL, "method=map integral=prefix filter=epipolar alpha=256 theta=512", NULL},
    {"totals", NULL, "method=map integral=prefix filter=epipolar alpha=256 theta=512 warp=borders", NULL},
    {"conservative", NULL, "method=conservative", NULL},
    // Embree's rays at the same angles, and at ever fewer: the fewest that are as near to the truth as the volume make the honest comparison.
    {"rays", NULL, "method=rays phi=128", NULL},
    {"rays", NULL, "method=rays phi=512", NULL},
    {"rays", NULL, "method=rays samples=768", NULL},
    {"rays", NULL, "method=rays samples=256", NULL},
    {"rays", NULL, "method=rays samples=128", NULL},
    {"rays", NULL, "method=rays samples=64", NULL},
    {"rays", NULL, "method=rays samples=32", NULL},
    {"rays", NULL, "method=rays samples=16", NULL},
    {NULL, NULL, NULL, NULL},
};
