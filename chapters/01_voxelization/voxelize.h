// voxelize: which voxels does a mesh's surface touch? Two answers by the GPU, one bit a voxel.
//
//   raster  Gomes (2015) section 2.1.2, after Crassin and Green (2012): one draw; the geometry stage looks along each triangle's dominant
//           axis, each pixel whose centre is covered sets one voxel. Fast, and full of holes.
//   exact   every voxel that a triangle touches (closed boxes: touching in a point counts) and no other. Triangles are sorted
//           by dominant axis; along each axis the geometry stage grows their projections to cover every pixel that they touch
//           (Hasselgren et al. 2005), and the fragment stage decides voxel by voxel (Schwarz and Seidel 2010).
//
// A scene's voxels depend on its triangles, the grid and the method alone: not on eye, light or the order of triangles.
#ifndef VOXELIZE_H
#define VOXELIZE_H

#include "raster.h"

// Cubic voxels over the part of the scene's box between `from` and `to` (0 to 1 on each axis), `resolution` along its longest side. A
// wrong request (status 2) where `from` is not below `to`.
VoxelGrid voxelize_grid(const Scene *scene, vec3 from, vec3 to, int resolution);

// One bit a voxel in a storage buffer, ordered as grid_words (scene.h) says.
typedef struct Voxels {
    VoxelGrid grid;
    GLuint words;
    size_t bytes;
} Voxels;

// All bits 0. Ends the program (status 1), naming the bytes needed, where one buffer cannot hold the grid, or a side is longer than
// the largest viewport.
Voxels voxels_create(const VoxelGrid *grid, const char *label);
void voxels_delete(Voxels *voxels);
void voxels_clear(const Voxels *voxels);
// The bits in new memory, grid_words(&voxels->grid) words.
uint32_t *voxels_read(const Voxels *voxels);
// How many of the bits `in` are not among the bits `but_not`; NULL: how many there are.
double voxels_count(const uint32_t *in, const uint32_t *but_not, size_t words);

// Large triangles by dominant axis, and small ones. Those outside the grid are in no list.
enum { LIST_X, LIST_Y, LIST_Z, LIST_SMALL, LIST_COUNT };
typedef struct TriangleLists {
    GLuint lists, counts; // list i begins at i · triangle_count
    uint32_t triangle_count, count[LIST_COUNT], outside;
} TriangleLists;
TriangleLists triangle_lists_create(const RasterMesh *mesh);
void triangle_lists_delete(TriangleLists *lists);

typedef struct Voxelizer {
    Shader *raster, *sort, *small[2], *large[2], *decide,
        *compare; // [1]: decide in double at once, not later
    GLuint framebuffer, vertex_array, undecided;
    // Any value of these gives the same voxels, in another time:
    float small_side;        // voxels: a triangle whose box is no longer is small
    uint32_t undecided_most; // at most as many as voxelizer_open sets: voxels put off to be decided in double
} Voxelizer;
Voxelizer voxelizer_open(void);
void voxelizer_close(Voxelizer *voxelizer);

// Set the bits of method `raster`.
void voxelize_raster(const Voxelizer *voxelizer, const RasterMesh *mesh, const Voxels *voxels);
// Method `exact`: sort, then every list that is not empty (an empty one may be done: it does nothing).
void voxelize_sort(const Voxelizer *voxelizer, const RasterMesh *mesh, const VoxelGrid *grid,
                   TriangleLists *lists);
// Returns how many pairs of a triangle and a voxel single precision could not decide.
uint32_t voxelize_list(const Voxelizer *voxelizer, const RasterMesh *mesh, const TriangleLists *lists,
                       int list, const Voxels *voxels);
// All of it at once: clear, sort, every list.
void voxelize_exact(const Voxelizer *voxelizer, const RasterMesh *mesh, TriangleLists *lists,
                    const Voxels *voxels);
// either = a | b, only_b = b & ~a; the three have one grid.
void voxels_compare(const Voxelizer *voxelizer, const Voxels *a, const Voxels *b, const Voxels *either,
                    const Voxels *only_b);

// For every method that the rasterizer or a compute shader serves. The uniforms of shaders/common/grid.glsl and triangles.glsl:
void voxelize_set_grid(const Shader *shader, const VoxelGrid *grid);
// Use the shader on a mesh: its grid, and the triangles at bindings 1 and 2.
void voxelize_use(const Shader *shader, const RasterMesh *mesh, const VoxelGrid *grid);
// A framebuffer without pixels of this size, and the voxels' words at binding 0.
void voxelize_begin(GLuint framebuffer, const Voxels *voxels, int width, int height);
int voxelize_side(const VoxelGrid *grid); // the longest, in voxels
// One invocation an item in groups of 64.
void voxelize_dispatch(uint32_t items);

#endif
