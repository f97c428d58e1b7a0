// oracle: one stage of the technique made exact, so that a difference tells how much of the error that stage makes.
#ifndef ORACLE_H
#define ORACLE_H

#include "airlight.h"

// `settings` with one stage exact. map: the light's reach as the truth knows it stands for the depth map, and a closed form, which knows no shadow, is summed over the lit
// stretches. quadrature: the same visibility, the depth map's or none, integrated without samples, by Gauss's rule to 5e-5. none: as they are.
AirlightSettings oracle_settings(AirlightSettings settings, const char *oracle);

// The reach of each of the scene's lights in this picture; buffers and array are the caller's, for oracle_reach_free.
AirlightReach *oracle_reach(const Scene *scene, const Camera *camera, int width, int height);
void oracle_reach_free(AirlightReach *reach, const Scene *scene); // NULL is allowed

#endif
