// walk: pictures of voxels by walking each pixel's ray through the bits (Amanatides and Woo 1987; shaders/common/grid_walk.glsl), and the
// same picture by the truth, which knows no grid: Embree against the voxels' boxes.
#ifndef WALK_H
#define WALK_H

#include "attributes.h"
#include "image.h"
#include "truth.h"

typedef enum WalkShow {
    WALK_SHADED,
    WALK_NORMALS, // of the face that the ray comes in by
    WALK_STEPS,
    WALK_DISTANCE,
    WALK_ALBEDO, // the voxel's mean, shaded
    WALK_MEAN_NORMALS
} WalkShow;

typedef struct Walker {
    Shader *blocks, *walk, *grid_lines;
    GLuint fetches; // counted by the last picture
} Walker;
Walker walker_open(void);
void walker_close(Walker *walker);

// A word for each block of 8³ voxels: whether a bit of it is set. The walk strides across empty blocks.
GLuint blocks_create(const VoxelGrid *grid);
size_t blocks_count(const VoxelGrid *grid);
void blocks_find(const Walker *walker, const Voxels *voxels, GLuint blocks);
// How many hold no bit.
size_t blocks_empty(const VoxelGrid *grid, GLuint blocks);

// What to walk and how to show it.
typedef struct WalkPicture {
    const Voxels *voxels;
    GLuint blocks;        // blocks_find's of `voxels`
    const Voxels *marked; // shown in red; NULL: none
    WalkShow show;
    const Attributes *stored; // what ALBEDO and MEAN_NORMALS show, of the same grid; else not read
    bool averaged;            // ALBEDO: `stored` holds averages instead of sums
    bool lines;               // outline each voxel
    const Camera *camera;
    int width, height;
    GLuint framebuffer; // one RGBA32F texture
} WalkPicture;
// Returns how many words and blocks were fetched.
double walk_draw(const Walker *walker, const Raster *raster, const WalkPicture *picture);

// The grid's lines over a lit picture of the G-buffer's size.
void grid_lines_draw(const Walker *walker, const GBuffer *gbuffer, const Camera *camera,
                     const VoxelGrid *grid, GLuint picture);

// What walk_draw draws (without lines and marks) for these bits, by Embree: 3 channels. Steps are counted from the hit's voxel. ALBEDO and
// MEAN_NORMALS want the value of each set bit, in their order; else NULL will do.
Image walk_truth(const uint32_t *bits, const VoxelGrid *grid, WalkShow show, const vec3 *values,
                 const Camera *camera, int width, int height);

#endif
