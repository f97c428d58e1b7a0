// extent: which slices and columns a triangle can touch, as items for conservative.comp and solid.comp. What lies outside of what the grid covers makes none.
#include "06_epipolar_vsv/wedge.glsl"
uniform double first_angle; // θ where the first slice begins
#include "06_epipolar_vsv/item_list.glsl"

// θ is told in single precision here, and only has to be told generously: the wedge itself is cut exactly.
const float ANGLE_DOUBT = 1e-5;
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
        double wide = 1.0 / cos(0.5 * arc.y + ANGLE_DOUBT), slack = DOUBT * reach_of(a, b, c);
        dvec3 r = max(dvec3(dot(way, a.xy), dot(way, b.xy), dot(way, c.xy)), 0.0), z = dvec3(a.z, b.z, c.z);
        Range alpha = NO_RANGE, phi = NO_RANGE;
        for (int i = 0; i < 3; i++) {
            range_add(alpha, dvec2(r[i], z[i]), true, slack);
            range_add(phi, dvec2(r[i], from_light(z[i])), true, slack);
        }
        columns = range_touches(0, alpha, wide, slack);
        ivec2 bits = range_touches(2, phi, wide, slack);
#if !EVERYTHING
        // Behind all view rays it shades nothing that is seen; before or beyond the light rays' range neither, but a solid's far side says where its inside begins.
        if (columns.x >= epipolar_count.x || bits.y < 0 || (bits.x >= epipolar_count.z && !KEEP_BEYOND)) {
            atomicAdd(outside, 1u);
            return;
        }
#endif
        columns = clamp(columns, 0, epipolar_count.x - 1);
    }
    if (!add_arc(triangle, 0u, arc.x - ANGLE_DOUBT, arc.y + 2.0 * ANGLE_DOUBT, columns / STRETCH))
        atomicAdd(outside, 1u);
}
