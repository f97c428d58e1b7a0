// baseline: the airlight by Embree's shadow rays (rays.h) as one more way to add a light's airlight to a picture.
#ifndef BASELINE_H
#define BASELINE_H

#include "query.h"
#include "rays.h"

// Add it at the light rays φ that the volume has, aimed and its range known; or at `samples` > 0 of them, spread over the same range.
RaysCount baseline_airlight(const Rays *rays, const Vsv *vsv, const QueryView *view,
                            const AirlightSettings *settings, int samples, GLuint picture);
// How fast the same rays are when nothing else is done: those of every `stride`-th tile of pixels.
RaysCount baseline_bare(const Rays *rays, const Vsv *vsv, const QueryView *view,
                        const AirlightSettings *settings, int samples, int stride);

#endif
