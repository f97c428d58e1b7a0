// large.geom: a polygon whose pixels' centres include every pixel that the triangle's projection touches: the Minkowski sum of the
// triangle and a pixel, which is the bounding box grown by half a pixel, cut by the three edges moved outwards likewise
// (Hasselgren, Akenine-Möller and Ohlsson, "Conservative rasterization", GPU Gems 2 (2005), section 42.2). A cut of a
// rectangle stays inside it, so neither a sliver nor a triangle of a million grids' size makes a far vertex.
#include "01_voxelization/columns.glsl"

layout(points) in;
layout(triangle_strip, max_vertices = 7) out;
in uint listed[];
uniform int axis;
#ifdef ANY_DEPTH
flat out ivec4 base; // w: the triangle
#else
flat out Columns columns;
#endif

vec2 polygon[7]; // pixels from the box's first
int count = 4;

//[cut
// Keep the part of the polygon where normal · p + offset ≥ 0.
void cut(vec2 normal, float offset)
{
    vec2 kept[7];
    int kept_count = 0;
    vec2 from = polygon[count - 1];
    float from_side = dot(normal, from) + offset;
    for (int i = 0; i < count; i++) {
        vec2 to = polygon[i];
        float to_side = dot(normal, to) + offset;
        if ((from_side < 0.0) != (to_side < 0.0))
            kept[kept_count++] = mix(from, to, from_side / (from_side - to_side));
        if (to_side >= 0.0)
            kept[kept_count++] = to;
        from = to;
        from_side = to_side;
    }
    count = kept_count;
    for (int i = 0; i < count; i++)
        polygon[i] = kept[i];
}
//]

void main()
{
    Columns c = columns_of(listed[0], axis);
#ifdef ANY_DEPTH // a solid is as solid behind a surface before the grid
    if (any(lessThan(c.last.xy, c.first.xy)))
        return;
#else
    if (any(lessThan(c.last, c.first)))
        return;
#endif
    vec2 end = vec2(c.last.xy - c.first.xy + 1);
    polygon[0] = vec2(0.0);
    polygon[1] = vec2(end.x, 0.0);
    polygon[2] = end;
    polygon[3] = vec2(0.0, end.y);
    //[cuts
    // The tests along the depth are linear in a pixel's lower corner, which is half a pixel before the centre.
    for (int edge = 0; edge < 3; edge++) {
        vec2 normal = vec2(c.overlap.a[edge].z, c.overlap.b[edge].z);
        float slack = SLACK * (abs(normal.x) + abs(normal.y));
        if (count > 2)
            cut(normal, c.overlap.c[edge].z - 0.5 * (normal.x + normal.y) + slack);
    }
    //]
    for (int i = 0; i < count; i++) {
#ifdef ANY_DEPTH
        base = ivec4(c.first, listed[0]);
#else
        columns = c;
#endif
        // a convex polygon as a strip: 0, 1, last, 2, last - 1, …
        vec2 p = polygon[(i & 1) == 1 ? (i + 1) / 2 : (count - i / 2) % count] + vec2(c.first.xy);
        gl_Position = vec4(2.0 * p / vec2(TURN(grid_size, axis).xy) - 1.0, 0.0, 1.0);
        EmitVertex();
    }
}
