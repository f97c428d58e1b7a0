// solid: where does the line through the centres of a column's voxels cross a triangle? What `solid.comp` does a small triangle at a time and
// `solid.frag` a column at a time. Eisemann and Décoret, "Single-pass GPU solid voxelization for real-time applications" (2008), take the
// rasterizer's answer; it snaps vertices to 1/256 pixel, so here the answer is computed, in double.
#include "common/grid.glsl"
#include "common/triangles.glsl"
#include "01_voxelization/turn.glsl"

uniform int axis; // along which the columns run
layout(std430, binding = 0) buffer Flips { uint flips[]; };
layout(std430, binding = 4) buffer Crossings { int crossings[]; }; // 2 a column: how many; the sum over its voxels of how often each is wound

//[half_open
// Does a ray from p in the direction of +x cross the edge? An end at p's own height counts as below it and a ray that begins on the edge
// does not cross it: of two neighbours that share a border, one owns it. The ends are taken in an order that both triangles of
// an edge agree on, and no multiplication may be fused into an addition here and not there: so both get the same answer, rounding included.
bool edge_crossed(dvec2 a, dvec2 b, dvec2 p)
{
    bool a_above = a.y > p.y, b_above = b.y > p.y;
    if (a_above == b_above)
        return false;
    dvec2 low = a_above ? b : a, high = a_above ? a : b;
    precise double right = (high.x - low.x) * (p.y - low.y) - (p.x - low.x) * (high.y - low.y);
    return right > 0.0;
}

// Inside: an odd number of the three. Summed over a mesh whose every edge belongs to an even number of triangles, each column is
// therefore crossed an even number of times, however much rounding there was.
bool column_crosses(dvec3 p0, dvec3 p1, dvec3 p2, dvec2 p)
{
    return (edge_crossed(p0.xy, p1.xy, p) != edge_crossed(p1.xy, p2.xy, p)) != edge_crossed(p2.xy, p0.xy, p);
}
//]

//[flip
void flip_column(dvec3 p0, dvec3 p1, dvec3 p2, ivec2 column)
{
    dvec2 p = (dvec2(column) + 0.5) * voxel_size;
    if (!column_crosses(p0, p1, p2, p))
        return;
    ivec3 size = TURN(grid_size, axis);
    precise dvec3 normal = cross(p1 - p0, p2 - p0);
    double lower = min(p0.z, min(p1.z, p2.z)), upper = max(p0.z, max(p1.z, p2.z));
    double depth = p0.z - dot(normal.xy, p - p0.xy) / normal.z;
    depth = normal.z == 0.0 ? lower : clamp(depth, lower, upper); // edge on: all its depths are as right
    // the first voxel whose centre is not before the surface; what lies before the grid flips all of the column
    int first = int(clamp(ceil(depth / voxel_size - 0.5), 0.0, double(size.z)));
    if (first < size.z) {
        uint place, word = grid_word(TURN_BACK(ivec3(column, first), axis), place);
        atomicXor(flips[word], 1u << place);
    }
    int at = 2 * (column.y * size.x + column.x), wound = size.z - first;
    atomicAdd(crossings[at], 1);
    atomicAdd(crossings[at + 1], normal.z < 0.0 ? wound : -wound); // in by a face that looks back, out by one that looks ahead
}
//]
