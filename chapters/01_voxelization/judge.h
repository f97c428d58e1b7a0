// judge: what the chapter's voxels and pictures are judged by: a surface's voxels by the truth's, a solid's volume by the mesh's own, the picture by rays.
#ifndef JUDGE_H
#define JUDGE_H

#include "run.h"
#include "solid.h"
#include "walk.h"

// The error rows of a sweep, or the checks of a stability case (while run_measuring_error or run_checking). Fragments and invocations of one run of the
// method are a sweep's; a stability case needs none.
//   missing, extra   voxels a true voxel; wrong: both
//   extra_gap        voxels: how far the farthest extra voxel lies from every triangle; 0 where there is none
//   rounding_bound   voxels: the proven bound on the truth's own rounding, within which an extra voxel would prove nothing
//   volume           of a solid: |voxels' volume / the mesh's own − 1|
void judge_surface(Run *run, const Mesh *mesh, const Voxels *voxels, double fragments, double invocations);
void judge_solid(Run *run, const SolidMesh *solid, const SolidWork *work, double fragments,
                 double invocations);
// The rows of a sweep, or the check of a stability case, for what `stored` holds of the voxels: sums, or listing 4.9's averages.
//   albedo, albedo_worst, albedo_bias   of a display's 255 steps (attributes_truth.h); stored_bytes: `bytes`, beside the bits
void judge_attributes(Run *run, const Attributes *stored, bool averaged, size_t bytes);

// Which voxels a picture's truth shows: those that the surface touches or those whose centres are inside; or ("x", "-x", … but "none") what is
// in their shadow.
typedef struct TrueVoxels {
    bool solid;
    const char *shadow;
} TrueVoxels;
// walk_truth of them, kept under out/truth: the same view again costs reading a file.
Image judge_truth(const Scene *scene, const VoxelGrid *grid, TrueVoxels of, WalkShow show,
                  const Camera *camera, int width, int height);

#endif
