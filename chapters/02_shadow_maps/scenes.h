// scenes: what the stability table is about, each with closed forms.
#ifndef SCENES_H
#define SCENES_H

#include "scene.h"

extern const SceneKind shadow_scenes[];

#endif
