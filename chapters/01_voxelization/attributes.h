// attributes: what colour, and which way does a voxel's surface face? Of the voxels that `exact` has set, and of them alone.
//
// A fragment is a triangle and a voxel that touch. Three ways to gather a voxel's fragments:
//   sums     integers and a count a voxel, divided when asked: the same for any order, right up to ATTRIBUTES_MOST fragments
//   list     every fragment, as the number of its voxel and of its triangle, in one buffer whose place is handed out by an atomic counter. A pass
//            counts first, so that the buffer holds them all; none is ever dropped
//   average  a running average by compare-and-swap as the thesis prints it (listing 4.9): 4 bytes a voxel, and wrong
#ifndef ATTRIBUTES_H
#define ATTRIBUTES_H

#include "voxelize.h"

// Fragments of one voxel whose sums still fit 32 bits: 2^32 / 1023 of albedo, 2^31 / 511 of normals.
#define ATTRIBUTES_MOST 4198404u

typedef struct VoxelAttributes {
    uint32_t fragments;
    vec3 albedo; // mean over the fragments, 0 to 1
    vec3 normal; // mean of unit normals: its length is below 1 where they disagree
} VoxelAttributes;

// For the set voxels of one grid, in the order of their bits: voxel i's slot is the number of set bits before bit i.
typedef struct Attributes {
    Voxels voxels; // not owned
    GLuint ranks, sums, averages;
    GLuint fragments, fragment_count; // the list: (voxel, triangle) pairs
    uint32_t slots;                   // set voxels
    uint64_t capacity;                // fragments that the list has room for
} Attributes;

typedef struct Attributer {
    Shader *rank, *list_sums;
    Shader *small[4], *large[4]; // count, sums, list, average
} Attributer;
Attributer attributer_open(void);
void attributer_close(Attributer *attributer);

// After `voxels` have been found exactly: number them. Passes below fill what they name, which is made by them.
Attributes attributes_rank(const Attributer *attributer, const Voxels *voxels);
void attributes_delete(Attributes *attributes);

// The triangles, sorted as voxelize_sort left them.
typedef struct Fragments {
    const Voxelizer *voxelizer;
    const RasterMesh *mesh;
    const TriangleLists *lists;
} Fragments;

// This and fragment_list_sum end the program (status 1) where a voxel has more than ATTRIBUTES_MOST fragments.
void attributes_sum(const Attributer *attributer, const Fragments *from, Attributes *attributes);
void attributes_average(const Attributer *attributer, const Fragments *from, Attributes *attributes);
// Count, and make room: ends the program (status 1), naming the bytes needed, where a buffer cannot hold the list. Returns the count.
uint64_t fragment_list_count(const Attributer *attributer, const Fragments *from, Attributes *attributes);
// Ends the program where another number of fragments comes than was counted.
void fragment_list_fill(const Attributer *attributer, const Fragments *from, Attributes *attributes);
// Sums of the list: bit for bit those of attributes_sum.
void fragment_list_sum(const Attributer *attributer, const Fragments *from, Attributes *attributes);

// Of each slot, in new memory. Ends the program where a voxel has more than ATTRIBUTES_MOST fragments, or none.
VoxelAttributes *attributes_read(const Attributes *attributes);
// Red, green, blue and count a byte each, lowest first, as listing 4.9 leaves them: in new memory.
uint32_t *attributes_read_averages(const Attributes *attributes);
// Pairs in new memory, in any order; fragment_list_count's number of them.
uint32_t *fragment_list_read(const Attributes *attributes);
// Of all that it holds.
size_t attributes_bytes(const Attributes *attributes);

#endif
