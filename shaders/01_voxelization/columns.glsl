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

// In turned space; voxels from the grid's corner, but `overlap` and `depth` from voxel `first`.
struct Columns {
    ivec3 first, last; // the voxels of the triangle's box, none where last < first
    uint triangle;
    vec4 depth; // over the middle of column (0, 0), its slopes, and how far it reaches within a column
    Overlap overlap;
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
    Columns c;
    c.triangle = triangle;
    dvec3 p0 = TURN(triangle_corner(triangle, 0u), axis), p1 = TURN(triangle_corner(triangle, 1u), axis);
    dvec3 p2 = TURN(triangle_corner(triangle, 2u), axis), normal = cross(p1 - p0, p2 - p0);
    // The box's test, exactly: a voxel's faces are products without rounding, only the divisions need to be put right.
    dvec3 lower = min(p0, min(p1, p2)), upper = max(p0, max(p1, p2)), size = dvec3(TURN(grid_size, axis));
    dvec3 first = floor(lower / voxel_size), last = floor(upper / voxel_size);
    first -= dvec3(greaterThanEqual(first * voxel_size, lower)); // in a face: the voxel before it touches, too
    last -= dvec3(greaterThan(last * voxel_size, upper));
    c.first = ivec3(clamp(first, dvec3(0.0), size));
    c.last = ivec3(clamp(last, dvec3(-1.0), size - 1.0));
    // Counted from the box's first voxel numbers are small: single precision then tells most voxels.
    dvec3 base = dvec3(c.first);
    ivec3 extent = max(c.last - c.first, ivec3(0)) + 2;
    c.overlap = overlap_prepare(p0, p1, p2, voxel_size, base, float(max(extent.x, max(extent.y, extent.z))));
    // A plane seen (nearly) edge on reaches everywhere. Along another axis than the dominant one slopes are large, and so is what rounding
    // does to a depth.
    bool edge_on = STEEPEST * abs(normal.z) <= abs(normal.x) + abs(normal.y);
    dvec2 slope = edge_on ? dvec2(0.0) : -normal.xy / normal.z;
    p0 = p0 / voxel_size - base;
    double steep = abs(slope.x) + abs(slope.y);
    c.depth = vec4(slope, p0.z + dot(slope, 0.5 - p0.xy), edge_on ? 1e30 : 0.5 * steep + SLACK * max(1.0, steep));
    return c;
}
//]

//[column
// The voxels of a column (from c.first) that the triangle's plane and box can reach: first and last.
ivec2 column_span(Columns c, ivec2 column)
{
    float depth = c.depth.z + dot(c.depth.xy, vec2(column)), most = float(c.last.z - c.first.z);
    return ivec2(floor(clamp(vec2(depth - c.depth.w, depth + c.depth.w), vec2(0.0, -1.0), vec2(most + 1.0, most))));
}
//]

bool touches_exactly(uint triangle, ivec3 voxel, int axis) // in turned space
{
    return overlap_exact(TURN(triangle_corner(triangle, 0u), axis), TURN(triangle_corner(triangle, 1u), axis),
                         TURN(triangle_corner(triangle, 2u), axis), dvec3(voxel) * voxel_size, voxel_size);
}

#ifdef LATER
layout(std430, binding = 5) buffer Undecided { uint undecided_count; uvec4 undecided[]; }; // voxel, triangle
uniform uint undecided_most;
#endif

//[touches
// `voxel` within the box, from c.first. Undecided voxels are decided in double at once, or LATER, by decide.comp: processors that work in
// step, as a GPU's and this renderer's do, take both branches of an `if` when a single one of their voxels needs the long one.
bool touches(Columns c, ivec3 voxel, int axis)
{
    float value = overlap_value(c.overlap, vec3(voxel));
    if (abs(value) <= c.overlap.error) {
#ifdef LATER
        uint at = atomicAdd(undecided_count, 1u);
        if (at < undecided_most)
            undecided[at] = uvec4(TURN_BACK(c.first + voxel, axis), c.triangle);
        return false;
#else
        return touches_exactly(c.triangle, c.first + voxel, axis);
#endif
    }
    return value > 0.0;
}
//]
