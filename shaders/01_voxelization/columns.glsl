// columns: a triangle seen along its dominant axis, and the columns of voxels under it. What `small.comp` does a triangle at a time and
// `large.geom` with `large.frag` do a column at a time.
#include "common/grid.glsl"
#include "common/triangles.glsl"
#include "common/overlap.glsl"
#include "01_voxelization/turn.glsl"

// What becomes of a voxel that is touched: its bit is set, or with STORE its triangle's attributes are kept; with COLUMN_ONLY the includer says.
#ifdef STORE
#include "01_voxelization/store.glsl"
#elif !defined COLUMN_ONLY
layout(std430, binding = 0) buffer Grid { uint grid_words[]; };

void voxel_found(ivec3 voxel, uint triangle)
{
    uint place, word = grid_word(voxel, place);
    atomicOr(grid_words[word], 1u << place);
}
#endif

// In turned space and voxels from the voxel `base`.
struct Columns {
    vec4 corner0, corner1, corner2; // w: the inner side along x, y, z
    vec4 plane;                     // depth over the base's centre, its slopes, and how far it reaches within a pixel
    ivec4 base;                     // w: the triangle
};

//[slack
// Voxels. Covers what moves a polygon's edge or a depth in single precision: the rasterizer snaps vertices to 1/256 pixel (1/512 off
// at most), and at 16384 pixels a position is off by 1/1024 and a cut by 1/256. Too large costs only time.
const float SLACK = 1.0 / 64.0;
//]

// A column's depth is not worth computing on a plane steeper than this: its rounding is beyond the grid.
const double STEEPEST = 16384.0LF;

int dominant_axis(dvec3 normal)
{
    dvec3 n = abs(normal);
    return n.z >= max(n.x, n.y) ? 2 : n.y >= n.x ? 1 : 0;
}

//[columns
Columns columns_of(uint triangle, int axis)
{
    dvec3 p0 = TURN(triangle_corner(triangle, 0u), axis), p1 = TURN(triangle_corner(triangle, 1u), axis);
    dvec3 p2 = TURN(triangle_corner(triangle, 2u), axis);
    dvec3 normal = cross(p1 - p0, p2 - p0);
    vec3 inner = vec3(overlap_inner(normal));
    // Small numbers near the triangle: single precision then tells most voxels.
    dvec3 voxels = dvec3(1.0 / voxel_size), last = dvec3(TURN(grid_size, axis) - 1);
    dvec3 base = clamp(floor(min(p0, min(p1, p2)) * voxels), dvec3(0.0), last);
    p0 = p0 * voxels - base;
    // A plane seen (nearly) edge on reaches everywhere; the bounding box then holds the depth.
    bool edge_on = STEEPEST * abs(normal.z) <= abs(normal.x) + abs(normal.y);
    dvec2 slope = edge_on ? dvec2(0.0) : -normal.xy / normal.z;
    double depth = edge_on ? 0.0 : p0.z + dot(slope, 0.5 - p0.xy);
    // Along another axis than the dominant one slopes are large, and so is what rounding does to a depth.
    double steep = abs(slope.x) + abs(slope.y);
    double reach = edge_on ? last.z + 2.0 : 0.5 * steep + SLACK * max(1.0, steep);
    return Columns(vec4(p0, inner.x), vec4(p1 * voxels - base, inner.y), vec4(p2 * voxels - base, inner.z),
                   vec4(slope, depth, reach), ivec4(base, triangle));
}
//]

bool touches(Columns c, ivec3 voxel, float extent, int axis)
{
    vec3 inner = vec3(c.corner0.w, c.corner1.w, c.corner2.w);
    int answer = overlap_fast(c.corner0.xyz, c.corner1.xyz, c.corner2.xyz, inner, vec3(voxel), extent);
    if (answer != 0)
        return answer > 0;
    uint triangle = uint(c.base.w);
    return overlap_exact(TURN(triangle_corner(triangle, 0u), axis), TURN(triangle_corner(triangle, 1u), axis),
                         TURN(triangle_corner(triangle, 2u), axis), dvec3(c.base.xyz + voxel) * voxel_size, voxel_size);
}

//[column
// The voxels of a column (from `base`) that the triangle's plane and box can reach: first and last.
ivec2 column_span(Columns c, ivec2 column, int axis)
{
    float lower = min(c.corner0.z, min(c.corner1.z, c.corner2.z)), upper = max(c.corner0.z, max(c.corner1.z, c.corner2.z));
    float depth = c.plane.z + dot(c.plane.xy, vec2(column));
    float first = float(-c.base.z), last = float(TURN(grid_size, axis).z - 1 - c.base.z);
    float least = floor(max(depth - c.plane.w, lower - SLACK)), most = floor(min(depth + c.plane.w, upper + SLACK));
    return ivec2(clamp(least, first, last + 1.0), clamp(most, first - 1.0, last));
}

// Above every coordinate's magnitude, for the error bounds of overlap_fast.
float column_extent(Columns c, ivec2 column, ivec2 span)
{
    vec3 far = max(abs(c.corner0.xyz), max(abs(c.corner1.xyz), abs(c.corner2.xyz)));
    far = max(far, abs(vec3(column, max(abs(span.x), abs(span.y)))));
    return 2.0 + max(far.x, max(far.y, far.z));
}

#ifndef COLUMN_ONLY
// Set the voxels of one column that the triangle touches.
void voxelize_column(Columns c, ivec2 column, int axis)
{
    ivec2 span = column_span(c, column, axis);
    float extent = column_extent(c, column, span);
    for (int depth = span.x; depth <= span.y; depth++)
        if (touches(c, ivec3(column, depth), extent, axis))
            voxel_found(TURN_BACK(c.base.xyz + ivec3(column, depth), axis), uint(c.base.w));
}
#endif
//]
