// flat: every voxel that the flat pieces of a part touch. One invocation an item of the list that flat_extent.comp makes.
#define FLAT 1
#include "06_epipolar_vsv/flat.glsl"
#include "06_epipolar_vsv/items.glsl"

layout(std430, binding = 8) readonly buffer SliceAngles { float slice_angles[]; };
const float SLACK = 1e-3; // voxels: more than what single precision does to an angle

//[slab
// Keep what has sign · θ ≥ sign · border.
void cut(float sign, float border)
{
    vec3 kept[6];
    int count = 0;
    vec3 from = corners > 0 ? polygon[corners - 1] : vec3(0.0);
    float from_side = sign * (from.y - border) + 1e-6;
    for (int i = 0; i < corners; i++) {
        vec3 to = polygon[i];
        float to_side = sign * (to.y - border) + 1e-6;
        if ((from_side < 0.0) != (to_side < 0.0) && count < 6)
            kept[count++] = mix(from, to, from_side / (from_side - to_side));
        if (to_side >= 0.0 && count < 6)
            kept[count++] = to;
        from = to;
        from_side = to_side;
    }
    corners = count;
    for (int i = 0; i < count; i++)
        polygon[i] = kept[i];
}
//]

// Least and greatest φ of the polygon between two α, in voxels; none where least > greatest.
vec2 range_between(int column)
{
    vec2 range = vec2(1e30, -1e30), from = vec2(epipolar_alpha_place(polygon[corners - 1].x), epipolar_phi_place(polygon[corners - 1].z));
    for (int i = 0; i < corners; i++) {
        vec2 to = vec2(epipolar_alpha_place(polygon[i].x), epipolar_phi_place(polygon[i].z));
        float low = column == 0 ? -1e30 : float(column) - SLACK, high = float(column + 1) + SLACK;
        vec2 ends = vec2(low - from.x, high - from.x) / (to.x - from.x); // where the edge enters and leaves the strip
        float begin = to.x == from.x ? 0.0 : max(0.0, min(ends.x, ends.y)), end = to.x == from.x ? 1.0 : min(1.0, max(ends.x, ends.y));
        if (begin <= end && max(from.x, to.x) >= low && min(from.x, to.x) <= high) {
            vec2 phi = mix(vec2(from.y), vec2(to.y), vec2(begin, end));
            range = vec2(min(range.x, min(phi.x, phi.y)), max(range.y, max(phi.x, phi.y)));
        }
        from = to;
    }
    return range + vec2(-SLACK, SLACK);
}

void fill(int slice, ivec2 stretch)
{
    float least = 1e30, most = -1e30;
    for (int i = 0; i < corners; i++) {
        least = min(least, epipolar_alpha_place(polygon[i].x));
        most = max(most, epipolar_alpha_place(polygon[i].x));
    }
    int first_column = max(int(floor(clamp(least - SLACK, 0.0, float(epipolar_count.x)))), stretch.x);
    int last_column = min(int(floor(max(most + SLACK, 0.0))), stretch.y);
    for (int column = first_column; column <= last_column; column++) {
        vec2 range = range_between(column);
        if (range.y < 0.0 || range.x >= float(epipolar_count.z) || range.x > range.y)
            continue;
        voxels_set_row(column, slice, clamp(ivec2(floor(range)), 0, epipolar_count.z - 1));
    }
}

void main()
{
    uint at = invocation();
    if (at >= item_count)
        return;
    Item item = items[at];
    int slice = item_slice(item);
    vec3 p[3] = vec3[3](flat_corner(item.triangle, 0u), flat_corner(item.triangle, 1u), flat_corner(item.triangle, 2u));
    cut_part(p, int(item.part >> 16), int(item.part & 0xffffu));
    split(p);
    int copies = (splits & SPLIT_WRAP) != 0 ? 1 : 0;
    for (int i = 0; i < (pierced ? 3 : 1); i++)
        for (int copy = -copies; copy <= copies; copy++) {
            piece(i, float(copy) * TURN);
            cut(1.0, slice_angles[slice]);
            cut(-1.0, slice_angles[slice + 1]);
            if (corners > 0)
                fill(slice, item_columns(item));
        }
}
