// columns: a triangle seen along its dominant axis, and the columns of voxels under it. What `small.comp` does a triangle at a time and
// `large.geom` with `large.frag` do a column at a time.
#include "common/grid.glsl"
#include "common/triangles.glsl"
#include "common/overlap.glsl"

layout(std430, binding = 0) buffer Grid { uint grid_words[]; };

// Turn space about its diagonal so that the axis to look along (0 x, 1 y, 2 z) comes last, and back. A turn keeps right-handedness.
#define TURN(v, axis) ((axis) == 0 ? (v).yzx : (axis) == 1 ? (v).zxy : (v).xyz)
#define TURN_BACK(v, axis) ((axis) == 0 ? (v).zxy : (axis) == 1 ? (v).yzx : (v).xyz)

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
    // A plane seen edge on reaches everywhere; the bounding box then holds the depth.
    bool edge_on = normal.z == 0.0;
    dvec2 slope = edge_on ? dvec2(0.0) : -normal.xy / normal.z;
    double depth = p0.z + dot(slope, 0.5 - p0.xy);
    double reach = edge_on ? last.z + abs(depth) : 0.5 * (abs(slope.x) + abs(slope.y)) + SLACK;
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
// Set the voxels of one column (from `base`) that the triangle touches; only those are tested that its plane can reach.
void voxelize_column(Columns c, ivec2 column, int axis)
{
    vec3 lower = min(c.corner0.xyz, min(c.corner1.xyz, c.corner2.xyz));
    vec3 upper = max(c.corner0.xyz, max(c.corner1.xyz, c.corner2.xyz));
    float depth = c.plane.z + dot(c.plane.xy, vec2(column));
    float least = max(floor(max(depth - c.plane.w, lower.z - SLACK)), float(-c.base.z));
    float most = min(floor(min(depth + c.plane.w, upper.z + SLACK)), float(TURN(grid_size, axis).z - 1 - c.base.z));
    vec3 far = max(max(abs(lower), abs(upper)), abs(vec3(column, max(abs(least), abs(most)))));
    float extent = 2.0 + max(far.x, max(far.y, far.z));
    for (int depth_voxel = int(least); depth_voxel <= int(most); depth_voxel++)
        if (touches(c, ivec3(column, depth_voxel), extent, axis)) {
            uint place, word = grid_word(TURN_BACK(c.base.xyz + ivec3(column, depth_voxel), axis), place);
            atomicOr(grid_words[word], 1u << place);
        }
}
//]
