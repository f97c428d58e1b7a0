// triangles_vsv: the voxelizations of triangles.h for a voxelized shadow volume as vsv.h holds it.
#ifndef TRIANGLES_VSV_H
#define TRIANGLES_VSV_H

#include "triangles.h"
#include "vsv.h"

// Whether the method's voxels come from triangles.
bool triangles_method(const char *method);
TriangleSplits triangles_splits(const char *split); // all none wrap epipole
// The volume has been aimed and cleared. What was counted is in triangles->counted.
void triangles_vsv_list(Triangles *triangles, const RasterMesh *mesh, const Vsv *vsv, const Light *light);
void triangles_vsv_fill(const Triangles *triangles, const RasterMesh *mesh, const Vsv *vsv,
                        const Light *light);

#endif
