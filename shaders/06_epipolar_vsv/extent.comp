// extent: which slices and columns a triangle can touch, as items for conservative.comp and solid.comp. What lies outside of what the grid covers makes none.
#include "06_epipolar_vsv/wedge.glsl"
#include "06_epipolar_vsv/items.glsl"

layout(std430, binding = 8) readonly buffer SliceAngles { float slice_angles[]; }; // from the first slice's beginning on, radians; one more than slices
layout(std430, binding = 9) buffer Counts { uint item_total, outside; };
uniform uint triangle_count;
uniform double first_angle;

// θ is told in single precision here, and only has to be told generously: the wedge itself is cut exactly.
const float ANGLE_DOUBT = 1e-5, TWO_PI = 6.28318531;
const double ON_AXIS = DOUBT / ANGLE_DOUBT; // nearer, and the doubt about a corner is more than that about its θ

//[sweep
// The arc of θ that a triangle covers: from its least angle on, as wide as y. Corners on both sides of θ = 0 are neighbours (the wrap), and a triangle that
// the axis pierces, or nearly, covers all (the epipole).
vec2 sweep(dvec3 a, dvec3 b, dvec3 c)
{
    vec3 theta = atan(vec3(a.y, b.y, c.y), vec3(a.x, b.x, c.x));
    // along an edge that does not cross the axis θ turns by less than π
    float to_b = theta.y - theta.x, to_c = theta.z - theta.x;
    to_b -= TWO_PI * round(to_b / TWO_PI);
    to_c -= TWO_PI * round(to_c / TWO_PI);
    vec2 ends = vec2(min(0.0, min(to_b, to_c)), max(0.0, max(to_b, to_c)));
    dvec3 beside = abs(dvec3(a.x, b.x, c.x)) + abs(dvec3(a.y, b.y, c.y)); // a corner on the axis has every θ
    if (ends.y - ends.x > 0.5 * TWO_PI - 1e-3 || min(beside.x, min(beside.y, beside.z)) <= ON_AXIS * reach_of(a, b, c))
        return vec2(0.0, TWO_PI);
    return vec2(theta.x + ends.x, ends.y - ends.x);
}
//]

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

void add_items(uint triangle, ivec2 slices, ivec2 stretches)
{
    int across = stretches.y - stretches.x + 1, count = max(slices.y - slices.x + 1, 0) * across;
    uint at = atomicAdd(item_total, uint(count));
    for (int i = 0; i < count; i++)
        if (at + uint(i) < item_count)
            items[at + uint(i)] = Item(triangle, uint(slices.x + i / across) | uint(stretches.x + i % across) << 16);
}

void main()
{
    uint triangle = invocation();
    if (triangle >= triangle_count)
        return;
    dvec3 a = epipolar_corner(triangle, 0u), b = epipolar_corner(triangle, 1u), c = epipolar_corner(triangle, 2u);
    vec2 arc = sweep(a, b, c);
    ivec2 columns = ivec2(0, epipolar_count.x - 1);
    // A triangle in less than a third of a turn is itself in a wedge: its corners' angles bound its own.
    if (arc.y < TWO_PI / 3.0) {
        float middle = arc.x + 0.5 * arc.y;
        dvec2 way = normalize(dvec2(cos(middle), sin(middle)));
        polygon[0] = dvec3(dot(way, a.xy), a.z, from_light(a.z));
        polygon[1] = dvec3(dot(way, b.xy), b.z, from_light(b.z));
        polygon[2] = dvec3(dot(way, c.xy), c.z, from_light(c.z));
        corners = 3;
        double wide = 1.0 / cos(0.5 * arc.y + ANGLE_DOUBT), slack = DOUBT * reach_of(a, b, c);
        columns = polygon_touches(0, wide, slack);
        ivec2 bits = polygon_touches(2, wide, slack);
        if (columns.x >= epipolar_count.x || bits.y < 0 || (bits.x >= epipolar_count.z && !KEEP_BEYOND)) {
            atomicAdd(outside, 1u);
            return;
        }
        columns = clamp(columns, 0, epipolar_count.x - 1);
    }
    float from = arc.x - float(first_angle) - ANGLE_DOUBT, width = arc.y + 2.0 * ANGLE_DOUBT;
    from -= TWO_PI * floor(from / TWO_PI);
    bool all = width >= TWO_PI;
    ivec2 slices = slices_in(all ? 0.0 : from, all ? TWO_PI : from + width);
    ivec2 wrapped = all || from + width < TWO_PI ? ivec2(0, -1) : slices_in(0.0, from + width - TWO_PI);
    wrapped.y = min(wrapped.y, slices.x - 1); // no slice twice
    if (slices.y < slices.x && wrapped.y < wrapped.x) {
        atomicAdd(outside, 1u);
        return;
    }
    add_items(triangle, slices, columns / STRETCH);
    add_items(triangle, wrapped, columns / STRETCH);
}
