// conservative: every voxel of a slice that a triangle touches. One invocation an item of the list that extent.comp makes.
// After the scan along α no voxel is lit in which any part is shadowed: what shadows a point lies on its light ray, so it has the point's θ and φ, and its voxel is set.
#include "06_epipolar_vsv/wedge.glsl"
#include "06_epipolar_vsv/items.glsl"

//[strip
// Metres by which a corner lies within the two faces of a column. What comes before the first column counts as in it: it shadows all that its light rays meet later.
dvec2 within(int column, dvec2 p, double wide, double slack)
{
    double after = column == 0 ? 1.0LF : beyond_most(boundaries[column], p, wide);
    return dvec2(after, -beyond_least(boundaries[column + 1], p, wide)) + slack;
}

// A strip between two lines through the eye leaves a convex polygon of a convex polygon: every φ between its least and greatest is met, and these are at ends of what
// the strip leaves of the sides.
void strip_add(inout Range range, Side side, int column, double wide, double slack)
{
    dvec2 from = within(column, side.from.xy, wide, slack), to = within(column, side.to.xy, wide, slack);
    dvec2 at = from / (from - to);
    double begin = max(from.x < 0.0 ? at.x : 0.0LF, from.y < 0.0 ? at.y : 0.0LF);
    double end = min(to.x < 0.0 ? at.x : 1.0LF, to.y < 0.0 ? at.y : 1.0LF);
    bool there = side.there && begin <= end && max(from.x, to.x) >= 0.0 && max(from.y, to.y) >= 0.0;
    range_add(range, side.from.xz + begin * (side.to.xz - side.from.xz), there, slack);
    range_add(range, side.from.xz + end * (side.to.xz - side.from.xz), there, slack);
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
    Side sides[SIDES];
    double slack, wide = sides_in_slice(item.triangle, slice, slack, sides);
    Range alpha = NO_RANGE;
    for (int i = 0; i < SIDES; i++) {
        range_add(alpha, sides[i].from.xy, sides[i].there, slack);
        range_add(alpha, sides[i].to.xy, sides[i].there, slack);
    }
    if (!alpha.any)
        return;
    ivec2 stretch = item_columns(item), columns = range_touches(0, alpha, wide, slack);
    if (columns.x >= epipolar_count.x)
        return;
    columns = clamp(columns, 0, epipolar_count.x - 1); // what comes before the range, too, shadows what is in it
    int last = min(columns.y, stretch.y);
    for (int column = max(columns.x, stretch.x); column <= last; column++) {
        Range phi = NO_RANGE;
        for (int i = 0; i < SIDES; i++)
            strip_add(phi, sides[i], column, wide, slack);
        ivec2 bits = range_touches(2, phi, wide, slack);
        if (phi.any && bits.x < epipolar_count.z && bits.y >= 0)
            voxels_set_row(column, slice, clamp(bits, 0, epipolar_count.z - 1));
    }
}
//]
