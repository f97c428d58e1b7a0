// judge: how far the chapter's airlight is from what it should be.
#ifndef JUDGE_H
#define JUDGE_H

#include "render.h"
#include "run.h"

// The truth's in-scattered radiance, and with ambient >= 0 the surfaces behind it; of every n-th pixel along both sides (truth_airlight_picture).
Image judge_truth(const Scene *scene, const Camera *camera, int width, int height, int every,
                  const AirlightSettings *settings, float ambient);

// The error rows of a sweep: against the truth, and against what a map of this resolution says, integrated exactly (`converged`): then what is left is the
// grid's own error. The truth is asked of truth_every's pixels, `converged` of all; `kept` holds the latter from row to row.
void judge_errors(Run *run, AirlightKept *kept, const Raster *raster, const Scene *scene,
                  const Camera *camera, const RenderSettings *settings, const Image *got);

// The checks of a stability case.
void judge_case(Run *run, const Raster *raster, const Camera *camera, const RenderSettings *settings,
                const Image *got);

extern const RunRow judge_sweep[], judge_cases[];

#endif
