// scenes: the chapter's own scenes, small enough to know what should come out, and the cases that it is tried on.
#ifndef SCENES_H
#define SCENES_H

#include "run.h"

extern const SceneKind airlight_scenes[];
extern const RunRow airlight_cases[];

#endif
