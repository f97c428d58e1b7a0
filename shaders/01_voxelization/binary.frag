// binary.frag: a column's 128 voxels of one slab as the bits of one pixel; the framebuffer's logic operation ORs them to what is there.
#define COLUMN_ONLY
#include "01_voxelization/columns.glsl"

flat in vec4 corner0, corner1, corner2, plane; // struct Columns
flat in ivec4 base;
uniform int slab;
layout(location = 0) out uvec4 bits;

//[binary
void main()
{
    Columns c = Columns(corner0, corner1, corner2, plane, base);
    ivec2 column = ivec2(gl_FragCoord.xy) - base.xy;
    ivec2 span = column_span(c, column, 2);
    float extent = column_extent(c, column, span);
    int first = 128 * slab - base.z;
    bits = uvec4(0u);
    for (int depth = max(span.x, first); depth <= min(span.y, first + 127); depth++)
        if (touches(c, ivec3(column, depth), extent, 2))
            bits[(depth - first) >> 5] |= 1u << ((depth - first) & 31);
    if (bits == uvec4(0u))
        discard;
}
//]
