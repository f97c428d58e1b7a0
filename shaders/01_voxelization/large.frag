// large.frag: one column of voxels a fragment.
#include "01_voxelization/columns.glsl"

flat in Columns columns;
uniform int axis;

//[column
void main()
{
    ivec2 column = ivec2(gl_FragCoord.xy) - columns.first.xy;
    ivec2 span = column_span(columns, column);
    for (int depth = span.x; depth <= span.y; depth++)
        if (touches(columns, ivec3(column, depth), axis))
            voxel_found(TURN_BACK(columns.first + ivec3(column, depth), axis), columns.triangle);
}
//]
