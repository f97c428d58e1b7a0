// sort: which triangles are small, and along which axis to look at the others: that of the largest component of their normal (thesis
// 2.1.2: there the projection is largest). Triangles outside the grid are in no list.
#include "01_voxelization/columns.glsl"

layout(local_size_x = 64) in;
uniform uint triangle_count;
uniform float small_side; // voxels
layout(std430, binding = 3) writeonly buffer Lists { uint lists[]; };  // list i begins at i · triangle_count
layout(std430, binding = 4) buffer Counts { uint counts[4], outside; }; // along x, y, z; small

//[sort
void main()
{
    uint triangle = (gl_GlobalInvocationID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationID.x;
    if (triangle >= triangle_count)
        return;
    dvec3 p0 = triangle_corner(triangle, 0u), p1 = triangle_corner(triangle, 1u), p2 = triangle_corner(triangle, 2u);
    dvec3 lower = min(p0, min(p1, p2)), upper = max(p0, max(p1, p2));
#if !EVERYTHING
    // Strictly outside: a triangle that lies in the grid's outer face touches voxels.
    if (any(lessThan(upper, dvec3(0.0))) || any(greaterThan(lower, dvec3(grid_size) * voxel_size))) {
        atomicAdd(outside, 1u);
        return;
    }
#endif
    vec3 sides = vec3((upper - lower) / voxel_size);
    bool small = max(sides.x, max(sides.y, sides.z)) <= small_side;
    uint list = small ? 3u : uint(dominant_axis(cross(p1 - p0, p2 - p0)));
    lists[list * triangle_count + atomicAdd(counts[list], 1u)] = triangle;
}
//]
