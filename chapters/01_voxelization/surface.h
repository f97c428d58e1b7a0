// surface: the other ways to voxelize a surface that the sources describe. Each sets bits of `voxels`, which the caller has cleared.
//
//   threepass  each axis draws the triangles whose dominant axis it is: what `raster` does in one pass
//   slicing    Fang and Chen (2000): every slice of every axis is a pass of its own, between a near and a far plane
//   peeling    Li et al. (2005): along every axis the nearest layer, then the nearest behind it, until no layer is left
//   msaa       four samples a pixel, a voxel for each sample that is covered
//   expanded   Gomes (2015), listings 4.1 to 4.5 in effect: triangles moved outwards, one voxel a fragment
//   binary     128 voxels of a column are the bits of one RGBA32UI texel, ORed by the framebuffer; decided as `exact` decides
#ifndef SURFACE_H
#define SURFACE_H

#include "voxelize.h"

typedef struct Surfaces {
    Shader *axis, *slice_sort, *slice, *slice_all, *peel, *layer, *samples, *expanded, *binary, *unpack;
    GLuint framebuffer, sampled, vertex_array;
} Surfaces;
Surfaces surfaces_open(void);
void surfaces_close(Surfaces *surfaces);

void surface_threepass(const Surfaces *surfaces, const RasterMesh *mesh, const Voxels *voxels);
void surface_msaa(const Surfaces *surfaces, const RasterMesh *mesh, const Voxels *voxels);
void surface_expanded(const Surfaces *surfaces, const RasterMesh *mesh, const Voxels *voxels);

// Which triangles reach into which slice of which axis. Slice i of axis k has the entries first[k][i] to first[k][i + 1] of `lists`.
typedef struct SliceLists {
    GLuint lists;
    uint32_t *first[3];
    int slices, empty; // of the three axes together
} SliceLists;
// Ends the program (status 1) where triangles times their slices do not fit a list.
SliceLists slice_lists_make(const Surfaces *surfaces, const RasterMesh *mesh, const VoxelGrid *grid);
void slice_lists_delete(SliceLists *lists); // zeroed lists are allowed
// A pass for each slice that is not empty; lists NULL: for each slice, with all triangles.
void surface_slicing(const Surfaces *surfaces, const RasterMesh *mesh, const SliceLists *lists,
                     const Voxels *voxels);

// Layers peeled along x, y, z. Along each axis peeling stops after the layer that is empty, after `most`, or after as many as
// the axis has voxels.
typedef struct PeelCount {
    int layers[3];
    double voxels; // of all layers; a voxel that several axes see counts for each
} PeelCount;
// `everything`: goes on to the last of `most` layers although nothing is left.
PeelCount surface_peeling(const Surfaces *surfaces, const RasterMesh *mesh, int most, bool everything,
                          const Voxels *voxels);

// Texel (x, y) of layer s holds voxels 128·s to 128·s + 127 of the column along z: bit z & 31 of channel z >> 5 & 3.
typedef struct BinaryGrid {
    VoxelGrid grid;
    GLuint texture; // 2D array
    int slabs;
} BinaryGrid;
BinaryGrid binary_create(const VoxelGrid *grid); // ends the program where the renderer has too few layers
void binary_delete(BinaryGrid *binary);
void binary_draw(const Surfaces *surfaces, const RasterMesh *mesh, const BinaryGrid *binary);
void binary_unpack(const Surfaces *surfaces, const BinaryGrid *binary, const Voxels *voxels);

#endif
