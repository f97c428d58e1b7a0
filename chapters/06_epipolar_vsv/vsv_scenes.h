// vsv_scenes: the scenes of this chapter alone: pictures, and places where epipolar space is at its edge.
#ifndef VSV_SCENES_H
#define VSV_SCENES_H

#include "scene.h"

extern const SceneKind vsv_scenes[];

#endif
