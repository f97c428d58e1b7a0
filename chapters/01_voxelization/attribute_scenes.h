// attribute_scenes: a scene for what voxels store.
#ifndef ATTRIBUTE_SCENES_H
#define ATTRIBUTE_SCENES_H

#include "scene.h"

// A wall of 16 by 16 voxels of 1 m. Voxel (x, y), counted from the lower left, holds 2(16y + x + 1) small triangles, dark and light in turn, 100.5 and
// 156.5 of 255. So every voxel's mean is 128.5 of 255, whatever its count, which goes from 2 to 512.
void make_averages(Scene *scene, uint64_t seed);

#endif
