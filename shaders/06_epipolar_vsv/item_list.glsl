// item_list: making the list of items: which slices an arc of θ touches.
#include "06_epipolar_vsv/items.glsl"

layout(std430, binding = 8) readonly buffer SliceAngles { float slice_angles[]; }; // from the first slice's beginning on, radians; one more than slices
layout(std430, binding = 9) buffer Counts { uint item_total, outside; };
uniform uint triangle_count;

const float TWO_PI = 6.28318531;

// Slices that [from, to] (angles from the first slice's beginning, 0 to 2π) touches; none where last < first.
ivec2 slices_in(float from, float to)
{
    ivec2 below = ivec2(0), above = ivec2(epipolar_count.y + 1);
    for (int halves = epipolar_count.y + 1; halves > 0; halves /= 2) {
        ivec2 middle = min((below + above) / 2, ivec2(epipolar_count.y));
        bvec2 open = lessThan(below, above), passed = bvec2(slice_angles[middle.x] < from, slice_angles[middle.y] <= to);
        below = ivec2(open.x && passed.x ? middle.x + 1 : below.x, open.y && passed.y ? middle.y + 1 : below.y);
        above = ivec2(open.x && !passed.x ? middle.x : above.x, open.y && !passed.y ? middle.y : above.y);
    }
    return ivec2(max(below.x - 1, 0), min(below.y - 1, epipolar_count.y - 1));
}

void add_items(uint triangle, uint part, ivec2 slices, ivec2 stretches)
{
    int across = stretches.y - stretches.x + 1, count = max(slices.y - slices.x + 1, 0) * across;
    uint at = atomicAdd(item_total, uint(count));
    for (int i = 0; i < count; i++)
        if (at + uint(i) < item_count)
            items[at + uint(i)] = item_make(triangle, part, uint(slices.x + i / across) | uint(stretches.x + i % across) << 16);
}

// The arc from `from` on, `width` wide, goes round past the last slice to the first. False where it touches none.
bool add_arc(uint triangle, uint part, float from, float width, ivec2 stretches)
{
    bool all = width >= TWO_PI;
    from -= float(first_angle);
    from = all ? 0.0 : from - TWO_PI * floor(from / TWO_PI);
    float to = all ? TWO_PI : from + width;
    ivec2 slices = slices_in(from, to), wrapped = slices_in(0.0, to - TWO_PI);
    wrapped.y = to < TWO_PI || all ? -1 : min(wrapped.y, slices.x - 1); // no slice twice
    add_items(triangle, part, slices, stretches);
    add_items(triangle, part, wrapped, stretches);
    return slices.y >= slices.x || wrapped.y >= 0;
}
