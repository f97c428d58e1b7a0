// solid: which voxels lie inside a closed mesh? A voxel is inside where its centre is, one bit a voxel.
//
// Eisemann and Décoret (2008): a line from outside to the centre crosses the surface an odd number of times. Each triangle flips, in each column
// of voxels whose centres' line it crosses, the first voxel whose centre is not before it; a prefix XOR along the columns then sets what lies
// behind an odd number of flips. XOR does not care about order, so neither do the voxels: not about triangles' order, not about threads.
//
// The rule for meshes that are no proper solids:
//   duplicated       a triangle that comes again with the same corners (in space) and the same winding counts once.
//   back to back     two triangles with the same corners and opposite windings both count, so they cancel: a wall between two parts that touch
//                    is no wall. A mesh whose triangles all come in such pairs (two-sided paper) has no inside.
//   not closed       a mesh is closed where each edge belongs to an even number of triangles; ends are compared by position. Then every column along
//                    every axis is crossed an even number of times, and one axis (z) decides. Else all three vote: inside is what two axes
//                    say, and a column that is crossed an odd number of times says nothing.
//   self-overlapping what an even number of parts covers is outside, what an odd number covers is inside. Columns in which this happens are
//                    counted: there the surface's winding number differs from 0 and 1.
//   inside out       filled as any other; counted by the winding number -1, and by the sign of the mesh's volume.
#ifndef SOLID_H
#define SOLID_H

#include "voxelize.h"

// A scene's triangles without duplicates, and what its edges say. `triangles` shares the scene's positions; only its indices are its own.
typedef struct SolidMesh {
    RasterMesh triangles;
    bool closed;
    size_t duplicates, back_to_back, odd_edges;
    double volume; // m³, by the divergence theorem: negative inside out; of no meaning unless closed
} SolidMesh;
SolidMesh solid_mesh_create(const Scene *scene, const RasterMesh *mesh);
void solid_mesh_delete(SolidMesh *solid);

// Of one axis, in columns: crossed at all, an odd number of times, inside out, overlapping.
typedef struct SolidColumns {
    uint32_t crossed, odd, inside_out, overlapping;
} SolidColumns;

typedef struct SolidWork {
    Voxels flips, along[3], result; // `along` x and y only where they are needed
    GLuint lists, counts, crossings, reports[3];
    bool three_axes;
} SolidWork;
// `everything`: room for three axes although one decides. Ends the program (status 1) where a buffer cannot hold the grid.
SolidWork solid_work_create(const VoxelGrid *grid, const SolidMesh *solid, bool everything);
void solid_work_delete(SolidWork *work);

typedef struct Solids {
    Shader *flip, *flip_large, *scan, *vote;
    GLuint framebuffer, vertex_array;
    float
        small_side; // voxels: a triangle whose projection is no longer is done without drawing it. Any value gives the same voxels
} Solids;
Solids solids_open(void);
void solids_close(Solids *solids);

// Along z, and for a mesh that is not closed along x and y: flip, then scan. Then for such a mesh: vote.
void solid_flip(const Solids *solids, const SolidMesh *solid, const SolidWork *work, int axis);
void solid_scan(const Solids *solids, const SolidWork *work, int axis);
void solid_vote(const Solids *solids, const SolidMesh *solid, const SolidWork *work);
// The passes above, those that are needed.
void solid_voxelize(const Solids *solids, const SolidMesh *solid, const SolidWork *work);

SolidColumns solid_columns(const SolidWork *work, int axis);
// One line for people about what is wrong with the mesh by the rule above; NULL where nothing is. The caller frees it.
char *solid_message(const char *name, const SolidMesh *solid, const SolidWork *work);
// |voxels · h³ / volume − 1| of a closed mesh, with the voxels' count.
double solid_volume_error(const SolidMesh *solid, const VoxelGrid *grid, double voxels);

#endif
