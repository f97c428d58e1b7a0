// binary.frag: a column's 128 voxels of one slab as the bits of one pixel; the framebuffer's logic operation ORs them to what is there.
#define COLUMN_ONLY
#include "01_voxelization/columns.glsl"

flat in Columns columns;
uniform int slab;
layout(location = 0) out uvec4 bits;

//[binary
void main()
{
    ivec2 column = ivec2(gl_FragCoord.xy) - columns.first.xy;
    ivec2 span = column_span(columns, column);
    int first = 128 * slab - columns.first.z;
    bits = uvec4(0u);
    for (int depth = max(span.x, first); depth <= min(span.y, first + 127); depth++)
        if (touches(columns, ivec3(column, depth), 2))
            bits[(depth - first) >> 5] |= 1u << ((depth - first) & 31);
    if (bits == uvec4(0u))
        discard;
}
//]
