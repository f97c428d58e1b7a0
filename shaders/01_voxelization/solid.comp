// solid.comp: one invocation a triangle. A triangle over few columns is done at once, another one is put on the list of those to draw.
#include "01_voxelization/solid.glsl"

layout(local_size_x = 64) in;
uniform uint triangle_count;
uniform float small_side; // voxels
layout(std430, binding = 3) writeonly buffer Lists { uint lists[]; };
layout(std430, binding = 5) buffer Counts { uint listed, outside; };

void main()
{
    uint triangle = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationID.x;
    if (triangle >= triangle_count)
        return;
    dvec3 p0 = TURN(triangle_corner(triangle, 0u), axis), p1 = TURN(triangle_corner(triangle, 1u), axis);
    dvec3 p2 = TURN(triangle_corner(triangle, 2u), axis);
    dvec2 lower = min(p0.xy, min(p1.xy, p2.xy)) / voxel_size, upper = max(p0.xy, max(p1.xy, p2.xy)) / voxel_size;
    ivec2 columns = TURN(grid_size, axis).xy;
#if !EVERYTHING
    // Beside the grid. One before it matters: the column behind is inside.
    if (any(lessThan(upper, dvec2(0.0))) || any(greaterThan(lower, dvec2(columns)))) {
        atomicAdd(outside, 1u);
        return;
    }
#endif
    if (max(upper.x - lower.x, upper.y - lower.y) > small_side) {
        lists[atomicAdd(listed, 1u)] = triangle;
        return;
    }
    // a column more on each side than the triangle covers centres
    ivec2 first = ivec2(clamp(floor(lower - 0.5), dvec2(0.0), dvec2(columns)));
    ivec2 last = ivec2(clamp(ceil(upper - 0.5), dvec2(-1.0), dvec2(columns - 1)));
    for (int y = first.y; y <= last.y; y++)
        for (int x = first.x; x <= last.x; x++)
            flip_column(p0, p1, p2, ivec2(x, y));
}
