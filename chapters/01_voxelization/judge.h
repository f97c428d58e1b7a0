// judge: the rows of --sweep and --stability: a surface's voxels against the truth's, a solid's volume against the mesh's own.
#ifndef JUDGE_H
#define JUDGE_H

#include "run.h"
#include "solid.h"

// While run_measuring_error or run_checking. Fragments and invocations of one run of the method are a sweep's; a stability case needs none.
void judge_surface(Run *run, const Mesh *mesh, const Voxels *voxels, double fragments, double invocations);
void judge_solid(Run *run, const SolidMesh *solid, const Voxels *voxels, double fragments,
                 double invocations);

#endif
