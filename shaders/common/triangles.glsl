// triangles: a mesh's triangles read as storage buffers, in the space of a voxel grid. Taught in chapter 01.
#ifndef TRIANGLES_GLSL
#define TRIANGLES_GLSL

layout(std430, binding = 1) readonly buffer Positions { float positions[]; }; // 3 a vertex, metres
layout(std430, binding = 2) readonly buffer Indices { uint indices[]; };      // 3 a triangle

uniform dvec3 grid_origin; // metres; a float32 value held in double
uniform double voxel_size; // metres; a float32 value held in double

//[rebase
// Corner 0, 1 or 2 of a triangle in metres from the grid's origin. Far from the world's origin a float32 difference
// would be wrong by whole voxels; the difference of two float32 numbers in double is right to its last bit or next to it.
// (Coordinates below 2^-126 m are 0 here where the renderer flushes denormals, as llvmpipe's fragment stage does.)
dvec3 triangle_corner(uint triangle, uint corner)
{
    uint at = 3u * indices[3u * triangle + corner];
    return dvec3(positions[at], positions[at + 1u], positions[at + 2u]) - grid_origin;
}
//]

#endif
