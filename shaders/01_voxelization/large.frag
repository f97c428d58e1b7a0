// large.frag: one column of voxels a fragment.
#include "01_voxelization/columns.glsl"

flat in vec4 corner0, corner1, corner2, plane; // struct Columns
flat in ivec4 base;
uniform int axis;

void main()
{
    Columns c = Columns(corner0, corner1, corner2, plane, base);
    voxelize_column(c, ivec2(gl_FragCoord.xy) - base.xy, axis);
}
