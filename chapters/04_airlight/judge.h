// judge: what the chapter's airlight is judged by: the truth's picture, and cases of which it is known what must come out.
#ifndef JUDGE_H
#define JUDGE_H

#include "airlight.h"
#include "run.h"
#include "truth.h"

// The truth's picture: in-scattered radiance, and with ambient >= 0 the surfaces behind it; of every n-th pixel along both sides; kept under out/truth.
Image airlight_truth(const Scene *scene, const Camera *camera, int width, int height, int every,
                     const AirlightSettings *settings, float ambient);

// The error rows of a sweep, of the in-scattered radiance alone: against the truth, and against what the same map says, integrated exactly
// (`converged`; for the closed forms: without shadow). The truth is asked of truth_every's pixels; `kept` holds the other from row to row.
void airlight_errors(Run *run, AirlightKept *kept, const Raster *raster, const Camera *camera,
                     const AirlightSettings *settings, const Image *got);

// Whether a ray's lit stretch is long enough to be judged by its own radiance: a cone's border can be met in a chord as short as you like, whose length is then all
// rounding. At least a hundredth of the way to the light and to the stretch counts. `far`: from the eye to the light.
static inline bool airlight_chord_counts(TruthSpan lit, double far)
{
    return lit.t1 - lit.t0 >= 0.01 * (lit.t0 + far);
}

// The checks of a stability case.
void airlight_case(Run *run, const Raster *raster, const AirlightHaze *haze, const Camera *camera,
                   const AirlightSettings *settings, const Image *got);

#endif
