// solid: which voxels' middles are inside a closed mesh? Eisemann and Décoret ("Fast scene voxelization and applications", 2006; "Single-pass GPU solid voxelization",
// 2008) in epipolar space: a view ray through the middle of a column crosses the surface; each crossing flips all bits on one side of it.
// One invocation an item of the list that extent.comp makes.
#include "06_epipolar_vsv/wedge.glsl"
#include "06_epipolar_vsv/items.glsl"

//[plane
// Where the half-plane through a slice's middle cuts the triangle: two ends (r, z); r is negative beyond the axis, in the other half-plane. An end lies on an edge of
// the mesh and is computed from that edge's corners alone, in an order that all its triangles agree on, and without fused roundings: so around a closed mesh the
// ends meet to the last bit, and each line through the eye crosses an even number of times, however much rounding there was.
bool cut_by_plane(uint triangle, dvec2 middle, out dvec2 ends[2])
{
    dvec2 corner[3]; // (r, z)
    double side[3];
    for (int i = 0; i < 3; i++) {
        dvec3 p = epipolar_corner(triangle, uint(i));
        precise double beside = p.y * middle.x - p.x * middle.y, r = p.x * middle.x + p.y * middle.y;
        side[i] = beside;
        corner[i] = dvec2(r, p.z);
    }
    int count = 0;
    for (int i = 0; i < 3; i++) {
        int next = (i + 1) % 3;
        if ((side[i] > 0.0) == (side[next] > 0.0))
            continue;
        int low = side[i] > 0.0 ? next : i, high = side[i] > 0.0 ? i : next;
        precise double share = side[low] / (side[low] - side[high]);
        precise dvec2 end = corner[low] + share * (corner[high] - corner[low]);
        ends[min(count++, 1)] = end;
    }
    return count == 2;
}
//]

// The bits before n, the number of voxels' middles along φ that lie before the crossing.
int middles_before(dvec2 direction)
{
    int base = first_boundary(2), below = 0, above = epipolar_count.z;
    while (below < above) {
        int middle = (below + above) / 2;
        if (beyond_most(boundaries[base + middle] + boundaries[base + middle + 1], direction, 1.0LF) > 0.0)
            below = middle + 1;
        else
            above = middle;
    }
    return below;
}

//[flip
// The papers flip what lies behind a crossing, as seen from outside. We flip what lies before it: at infinity one is outside for certain, in the eye one may
// be inside. So an eye within an occluder sees its inside, and what lies beyond the grid's φ counts without being stored.
void flip(int column, int slice, int bits)
{
    for (int word = 0; 32 * word < bits; word++) {
        atomicXor(voxels[epipolar_word(column, slice, word)], bits - 32 * word >= 32 ? 0xffffffffu : (1u << (bits & 31)) - 1u);
        atomicMin(first[epipolar_column(slice, word)], uint(column)); // the scan begins no later
    }
}
//]

//[main
void main()
{
    uint at = invocation();
    if (at >= item_count)
        return;
    Item item = items[at];
    int slice = item_slice(item);
    dvec2 ends[2], middle = normalize(boundaries[first_boundary(1) + slice] + boundaries[first_boundary(1) + slice + 1]);
    if (!cut_by_plane(item.triangle, middle, ends))
        return;
    // the columns of what lies on this side of the axis
    if (max(ends[0].x, ends[1].x) < 0.0)
        return;
    double slack = DOUBT * reach_of(dvec3(ends[0], 0.0), dvec3(ends[1], 0.0), dvec3(0.0));
    Range alpha = NO_RANGE;
    for (int i = 0; i < 2; i++) {
        dvec2 end = ends[i].x < 0.0 ? mix(ends[i], ends[1 - i], ends[i].x / (ends[i].x - ends[1 - i].x)) : ends[i];
        range_add(alpha, dvec2(max(end.x, 0.0), end.y), true, slack);
    }
    ivec2 stretch = item_columns(item), columns = range_touches(0, alpha, 1.0LF, slack);
    columns = ivec2(max(columns.x, stretch.x), min(columns.y, stretch.y));
    for (int column = columns.x; column <= columns.y; column++) {
        precise dvec2 ray = boundaries[column] + boundaries[column + 1]; // (cos, sin), longer than 0
        precise double before = ends[0].x * ray.x - ends[0].y * ray.y, behind = ends[1].x * ray.x - ends[1].y * ray.y;
        if ((before > 0.0) == (behind > 0.0))
            continue;
        dvec2 crossing = ends[0] + before / (before - behind) * (ends[1] - ends[0]);
        if (dot(crossing.yx, ray) > 0.0) // not behind the eye
            flip(column, slice, middles_before(dvec2(max(crossing.x, 0.0), from_light(crossing.y))));
    }
}
//]
