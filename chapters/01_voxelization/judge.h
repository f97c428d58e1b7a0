// judge: what the chapter's voxels and pictures are judged by: the truth's voxels, and its picture of them.
#ifndef JUDGE_H
#define JUDGE_H

#include "run.h"
#include "walk.h"

// The error rows of a sweep, or the checks of a stability case.
//   missing, extra   voxels a true voxel
//   extra_gap        voxels: how far the farthest extra voxel lies from every triangle; 0 where there is none
//   rounding_bound   voxels: the proven bound on the truth's own rounding, within which an extra voxel would prove nothing
void judge(Run *run, const Mesh *mesh, const Voxels *voxels);

// walk_truth of the true voxels, kept under out/truth: the same view again costs reading a file.
Image judge_truth(const Scene *scene, const VoxelGrid *grid, WalkShow show, const Camera *camera, int width,
                  int height);

#endif
