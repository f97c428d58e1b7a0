// conservative: every voxel of a slice that a triangle touches. One invocation an item of the list that extent.comp makes.
// After the scan along α no voxel is lit in which any part is shadowed: what shadows a point lies on its light ray, so it has the point's θ and φ, and its voxel is set.
#include "06_epipolar_vsv/wedge.glsl"
#include "06_epipolar_vsv/items.glsl"

//[range
// The least and the greatest φ of the polygon between two lines through the eye, as directions (r, w). Such a part of a convex polygon is convex: every φ
// between is met, too; and its corners lie on the polygon's edges, cut to the strip.
struct Range {
    dvec2 least, greatest;
    bool any, all; // all: it reaches the light itself, where φ is every angle
};

void range_add(inout Range range, dvec2 p, double slack)
{
    range.all = range.all || max(p.x, abs(p.y)) <= slack;
    // φ of p is less than that of q where p.r q.w < q.r p.w
    bool less = !range.any || p.x * range.least.y < range.least.x * p.y;
    bool more = !range.any || p.x * range.greatest.y > range.greatest.x * p.y;
    range.least = less ? p : range.least;
    range.greatest = more ? p : range.greatest;
    range.any = true;
}

// Metres by which a corner lies within the strip's two sides. What comes before the first column counts as in it: it shadows all that its light rays meet later.
dvec2 within(int column, dvec2 p, double wide, double slack)
{
    double after = column == 0 ? 1.0LF : beyond_most(boundaries[column], p, wide);
    return dvec2(after, -beyond_least(boundaries[column + 1], p, wide)) + slack;
}

Range range_between(int column, double wide, double slack)
{
    Range range = Range(dvec2(0.0), dvec2(0.0), false, false);
    dvec3 from = polygon[corners - 1];
    dvec2 from_side = within(column, from.xy, wide, slack);
    for (int i = 0; i < corners; i++) {
        dvec3 to = polygon[i];
        dvec2 to_side = within(column, to.xy, wide, slack);
        double begin = 0.0, end = 1.0;
        for (int k = 0; k < 2; k++) {
            double at = from_side[k] / (from_side[k] - to_side[k]);
            if (from_side[k] < 0.0)
                begin = to_side[k] < 0.0 ? 2.0LF : max(begin, at);
            else if (to_side[k] < 0.0)
                end = min(end, at);
        }
        if (begin <= end) {
            range_add(range, mix(from.xz, to.xz, begin), slack);
            range_add(range, mix(from.xz, to.xz, end), slack);
        }
        from = to;
        from_side = to_side;
    }
    return range;
}
//]

//[columns
void main()
{
    uint at = invocation();
    if (at >= item_count)
        return;
    Item item = items[at];
    int slice = item_slice(item);
    double slack, wide = polygon_in_slice(item.triangle, slice, slack);
    if (corners == 0)
        return;
    ivec2 stretch = item_columns(item), columns = polygon_touches(0, wide, slack);
    if (columns.x >= epipolar_count.x)
        return;
    columns = clamp(columns, 0, epipolar_count.x - 1); // what comes before the range, too, shadows what is in it
    int last = min(columns.y, stretch.y);
    for (int column = max(columns.x, stretch.x); column <= last; column++) {
        Range range = range_between(column, wide, slack);
        if (!range.any)
            continue;
        ivec2 bits = touched(2, range.least, range.greatest, wide, slack);
        if (range.all)
            bits = ivec2(0, epipolar_count.z - 1);
        if (bits.x < epipolar_count.z && bits.y >= 0)
            voxels_set_row(column, slice, clamp(bits, 0, epipolar_count.z - 1));
    }
}
//]
