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
    vec2 lower = min(c.corner0.xy, min(c.corner1.xy, c.corner2.xy)) - SLACK;
    vec2 upper = max(c.corner0.xy, max(c.corner1.xy, c.corner2.xy)) + SLACK;
    ivec2 first = max(ivec2(floor(lower)), -c.base.xy);
    ivec2 last = min(ivec2(floor(upper)), TURN(grid_size, axis).xy - 1 - c.base.xy);
    if (any(lessThan(last, first)))
        return;
    // One loop over all voxels, not three nested ones: invocations run in step, and each waits for the longest in every loop.
    ivec2 column = first;
    ivec2 span = column_span(c, column, axis);
    int depth = span.x;
    while (true) {
        if (depth <= span.y) {
            if (touches(c, ivec3(column, depth), column_extent(c, column, span), axis))
                voxel_found(TURN_BACK(c.base.xyz + ivec3(column, depth), axis), triangle);
            depth++;
        }
        if (depth > span.y) {
            column.x++;
            if (column.x > last.x) {
                column.x = first.x;
                if (++column.y > last.y)
                    break;
            }
            span = column_span(c, column, axis);
            depth = span.x;
        }
    }
}
//]
