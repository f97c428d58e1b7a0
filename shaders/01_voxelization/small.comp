// small: one invocation a triangle walks the columns under it. For a triangle of a few voxels this costs less than drawing it.
#include "01_voxelization/columns.glsl"

layout(local_size_x = 64) in;
uniform uint list_first, list_count;
layout(std430, binding = 3) readonly buffer Lists { uint lists[]; };

//[small
void main()
{
    uint item = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationID.x;
    if (item >= list_count)
        return;
    uint triangle = lists[list_first + item];
    dvec3 p0 = triangle_corner(triangle, 0u);
    int axis = dominant_axis(cross(triangle_corner(triangle, 1u) - p0, triangle_corner(triangle, 2u) - p0));
    Columns c = columns_of(triangle, axis);
    if (any(lessThan(c.last, c.first)))
        return;
    // One loop over all voxels, not three nested ones: invocations run in step, and each waits for the longest in every loop.
    ivec2 column = ivec2(0), last = c.last.xy - c.first.xy;
    ivec2 span = column_span(c, column);
    int depth = span.x;
    while (true) {
        if (depth <= span.y) {
            if (touches(c, ivec3(column, depth), axis))
                voxel_found(TURN_BACK(c.first + ivec3(column, depth), axis), triangle);
            depth++;
        }
        if (depth > span.y) {
            column.x++;
            if (column.x > last.x) {
                column.x = 0;
                if (++column.y > last.y)
                    break;
            }
            span = column_span(c, column);
            depth = span.x;
        }
    }
}
//]
