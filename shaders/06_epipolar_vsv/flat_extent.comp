// flat_extent: the slices that each part of a subdivided triangle covers, as items for flat.comp. One invocation a row of parts.
#define FLAT 1
#include "06_epipolar_vsv/flat.glsl"
#include "06_epipolar_vsv/item_list.glsl"

void main()
{
    uint triangle = invocation() / uint(parts_most);
    int row = int(invocation() % uint(parts_most));
    if (triangle >= triangle_count)
        return;
    vec3 whole[3] = vec3[3](flat_corner(triangle, 0u), flat_corner(triangle, 1u), flat_corner(triangle, 2u));
    int n = parts_of(whole);
    for (int part = row * row; part < (row + 1) * (row + 1) && row < n; part++) {
        vec3 p[3] = whole;
        cut_part(p, n, part);
        split(p);
        vec3 least = min(around[0], min(around[1], min(around[2], around[3])));
        vec3 most = max(around[0], max(around[1], max(around[2], around[3])));
        bool all = pierced || most.y - least.y >= TURN;
        int last = epipolar_count.x - 1;
        ivec2 columns = ivec2(floor(vec2(epipolar_alpha_place(least.x), epipolar_alpha_place(most.x))));
        columns = pierced ? ivec2(0, last) : clamp(columns + ivec2(-1, 1), 0, last);
        add_arc(triangle, uint(n) << 16 | uint(part), float(first_angle) + least.y - 1e-5, all ? TURN : most.y - least.y + 2e-5, columns / STRETCH);
    }
}
