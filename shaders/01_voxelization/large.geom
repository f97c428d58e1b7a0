// large.geom: a polygon whose pixels' centres include every pixel that the triangle's projection touches: the Minkowski sum of the
// triangle and a pixel, which is the bounding box grown by half a pixel, cut by the three edges moved outwards likewise
// (Hasselgren, Akenine-Möller and Ohlsson, "Conservative rasterization", GPU Gems 2 (2005), section 42.2). A cut of a
// rectangle stays inside it, so neither a sliver nor a triangle of a million grids' size makes a far vertex.
#include "01_voxelization/columns.glsl"

layout(points) in;
layout(triangle_strip, max_vertices = 7) out;
in uint listed[];
uniform int axis;
flat out vec4 corner0, corner1, corner2, plane; // struct Columns
flat out ivec4 base;

const float REACH = 0.5 + SLACK; // pixels

vec2 polygon[7]; // pixels from base
int count = 4;

//[cut
// Keep the part of the polygon where normal · p + offset ≥ 0.
void cut(dvec2 normal, double offset)
{
    vec2 kept[7];
    int kept_count = 0;
    vec2 from = polygon[count - 1];
    float from_side = float(dot(normal, dvec2(from)) + offset);
    for (int i = 0; i < count; i++) {
        vec2 to = polygon[i];
        float to_side = float(dot(normal, dvec2(to)) + offset);
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

void cut_edge(uint triangle, uint corner, dvec2 base_corner, double inner)
{
    dvec2 from = TURN(triangle_corner(triangle, corner), axis).xy / voxel_size - base_corner;
    dvec2 to = TURN(triangle_corner(triangle, (corner + 1u) % 3u), axis).xy / voxel_size - base_corner;
    dvec2 normal = inner * dvec2(from.y - to.y, to.x - from.x);
    if (count > 2)
        cut(normal, REACH * (abs(normal.x) + abs(normal.y)) - dot(normal, from));
}
//]

void main()
{
    Columns c = columns_of(listed[0], axis);
    vec3 lower = min(c.corner0.xyz, min(c.corner1.xyz, c.corner2.xyz));
    vec3 upper = max(c.corner0.xyz, max(c.corner1.xyz, c.corner2.xyz));
    vec3 grid_low = vec3(-c.base.xyz), grid_high = vec3(TURN(grid_size, axis) - c.base.xyz);
    vec2 low = max(lower.xy - REACH, grid_low.xy), high = min(upper.xy + REACH, grid_high.xy);
#ifdef ANY_DEPTH // a solid is as solid behind a surface before the grid
    lower.z = upper.z = grid_low.z;
#endif
    if (any(greaterThanEqual(low, high)) || lower.z > grid_high.z + SLACK || upper.z < grid_low.z - SLACK)
        return;

    polygon[0] = low;
    polygon[1] = vec2(high.x, low.y);
    polygon[2] = high;
    polygon[3] = vec2(low.x, high.y);
    for (uint corner = 0u; corner < 3u; corner++)
        cut_edge(listed[0], corner, dvec2(c.base.xy), double(c.corner2.w));

    for (int i = 0; i < count; i++) {
        corner0 = c.corner0;
        corner1 = c.corner1;
        corner2 = c.corner2;
        plane = c.plane;
        base = c.base;
        // a convex polygon as a strip: 0, 1, last, 2, last - 1, …
        vec2 p = polygon[(i & 1) == 1 ? (i + 1) / 2 : (count - i / 2) % count] - grid_low.xy;
        gl_Position = vec4(2.0 * p / (grid_high.xy - grid_low.xy) - 1.0, 0.0, 1.0);
        EmitVertex();
    }
}
