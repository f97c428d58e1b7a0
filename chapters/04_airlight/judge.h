// judge: what the chapter's airlight is judged by: the truth's picture, and cases of which it is known what must come out.
#ifndef JUDGE_H
#define JUDGE_H

#include "airlight.h"
#include "run.h"

// The truth's picture: in-scattered radiance, and with ambient >= 0 the surfaces behind it; kept under out/truth.
Image airlight_truth(const Scene *scene, const Camera *camera, int width, int height,
                     const AirlightSettings *settings, float ambient);

// The error rows of a sweep, of the in-scattered radiance alone: against the truth, and against what the same map says, integrated exactly
// (`converged`; for the closed forms: without shadow).
void airlight_errors(Run *run, const Raster *raster, const Camera *camera, const AirlightSettings *settings,
                     const Image *got);

// The checks of a stability case.
void airlight_case(Run *run, const Raster *raster, const AirlightHaze *haze, const Camera *camera,
                   const AirlightSettings *settings, const Image *got);

#endif
