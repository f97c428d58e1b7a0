// scenes: the chapter's own scenes, whose voxels can be counted by hand.
#ifndef SCENES_H
#define SCENES_H

#include "scene.h"

extern const SceneKind voxel_scenes[];

// How many voxels a stability case of this name has, in closed form; -1 where there is none.
double scenes_voxels(const char *stability_case);

#endif
