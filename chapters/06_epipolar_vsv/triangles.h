// triangles: a mesh's own triangles voxelized into the epipolar grid, without a shadow map between (Wyman 2011, sections 2.2.1 and 4.1). Three ways:
//
//   conservative  every voxel that any part of a triangle touches (closed: touching counts). After the scan no voxel is lit in which any part is shadowed; some
//                 are dark that are partly or, behind a voxel that is only grazed, wholly lit. Triangles are cut to slices in space, where they are flat and
//                 view rays and light rays straight: no edge is curved, nothing needs to be subdivided.
//   flat          the paper's way: corners are taken to (α, θ, φ) and joined by straight edges there. Edges would be curved, so a triangle is
//                 subdivided first; and those that cross θ = 0 or that the axis pierces must be split. Voxels that the flat pieces touch are set.
//   solid         a voxel is set where the view ray through the middle of its column is inside a closed mesh, at the middle of its φ (Eisemann and Décoret
//                 2006, 2008). Other meshes are refused. The grid's α must begin at 0: what is before its first column is not sampled.
#ifndef TRIANGLES_H
#define TRIANGLES_H

#include "epipolar.h"
#include "raster.h"

// Which of the paper's two splits (section 4.1.1) `flat` makes: to show what breaks without them.
typedef enum TriangleSplits {
    SPLIT_NONE = 0,
    SPLIT_WRAP = 1,
    SPLIT_EPIPOLE = 2,
    SPLIT_ALL = 3
} TriangleSplits;

typedef struct TrianglesSettings {
    const char *method;    // conservative flat solid
    TriangleSplits splits; // flat
    int parts;             // flat: into how many an edge is cut at most, 1 to 16
} TrianglesSettings;

// What a listing counted: triangles that make no item since nothing of them is in the grid's range or shadows it; pieces of work.
typedef struct TrianglesCounts {
    uint32_t items, outside;
} TrianglesCounts;

typedef struct Triangles {
    TrianglesSettings settings;
    Shader *extent[2], *fill[2]; // [1]: of a light at infinity; compiled when first used
    GLuint boundaries, slice_angles, counts, items;
    uint32_t item_room;
    TrianglesCounts counted;
} Triangles;
Triangles triangles_open(const TrianglesSettings *settings);
void triangles_close(Triangles *triangles);

// The grid, of one light and eye. `theta_borders`: as epipolar_theta_borders makes them; NULL: even slices. `phi_squared`: WARP_SQUARE of epipolar.glsl.
typedef struct TrianglesGrid {
    const EpipolarFrame *frame;
    const EpipolarRange *range;
    const Light *light;
    const float *theta_borders;
    bool phi_squared;
} TrianglesGrid;
void triangles_aim(Triangles *triangles, const TrianglesGrid *grid);
// List the pieces of work; then set their voxels' bits. `voxels` and `first`: the buffers of 06_epipolar_vsv/voxels.glsl, cleared.
void triangles_list(Triangles *triangles, const RasterMesh *mesh, const TrianglesGrid *grid);
void triangles_fill(const Triangles *triangles, const RasterMesh *mesh, const TrianglesGrid *grid,
                    GLuint voxels, GLuint first);

// Edges of the mesh that do not belong to an even number of triangles (ends are compared by position): 0 for a closed mesh.
size_t triangles_open_edges(const Mesh *mesh);
// Ends the program (a wrong request, status 2) where `solid` cannot take the scene's mesh.
void triangles_need_closed(const Scene *scene);

#endif
