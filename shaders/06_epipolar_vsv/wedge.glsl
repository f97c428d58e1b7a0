// wedge: what of a triangle lies in a slice. Nothing is bent there: α and φ are angles of straight lines through the eye and the light, so that clipping in space, where
// triangles are flat, leaves nothing to subdivide. Wyman (2011) connects corners in (α, θ, φ), where edges are curved; flat.glsl does that.
#include "06_epipolar_vsv/boundaries.glsl"

layout(std430, binding = 6) readonly buffer Positions { float positions[]; }; // 3 a vertex, metres
layout(std430, binding = 7) readonly buffer Indices { uint indices[]; };      // 3 a triangle

uniform dvec3 eye, across, upwards, axis; // metres; a right-angled frame, axis towards the light; θ from `across` to `upwards`
uniform double light_distance;            // metres; negative: the light is at infinity

//[corner
// (x, y, z): across the axis, and along it from the eye.
dvec3 epipolar_corner(uint triangle, uint corner)
{
    uint at = 3u * indices[3u * triangle + corner];
    dvec3 p = dvec3(positions[at], positions[at + 1u], positions[at + 2u]) - eye;
    return dvec3(dot(p, across), dot(p, upwards), dot(p, axis));
}
double from_light(double z)
{
    return light_distance < 0.0 ? 1.0LF : light_distance - z;
}
//]

// Metres of doubt about any sum of products of coordinates up to `reach`: some ten roundings of 2^-53 each.
const double DOUBT = 1e-14LF;
double reach_of(dvec3 a, dvec3 b, dvec3 c)
{
    dvec3 most = max(abs(a), max(abs(b), abs(c)));
    return most.x + most.y + most.z + abs(light_distance);
}

// A convex polygon by its sides (r, z, w); a side that has been cut away is not `there`. Sides need no order: what is asked is how far they reach.
struct Side {
    dvec3 from, to;
    bool there;
};
const int SIDES = 5; // of a triangle's part in a wedge: its three edges, and what the two half-planes cut off

//[keep
// Keep the part of a segment where its ends' distances are not below 0.
void keep(inout Side side, double at_from, double at_to)
{
    double share = at_from / (at_from - at_to); // where it crosses
    dvec3 crossing = side.from + share * (side.to - side.from);
    side.from = at_from < 0.0 ? crossing : side.from;
    side.to = at_to < 0.0 ? crossing : side.to;
    side.there = side.there && (at_from >= 0.0 || at_to >= 0.0);
}
// Where the triangle's edges cross a plane: a segment, there if two do.
Side crossed(dvec3 p[3], dvec3 distance)
{
    Side side = Side(p[0], p[0], false);
    bool any = false;
    for (int i = 0; i < 3; i++) {
        int next = i == 2 ? 0 : i + 1;
        bool crosses = (distance[i] < 0.0) != (distance[next] < 0.0);
        dvec3 crossing = mix(p[i], p[next], distance[i] / (distance[i] - distance[next]));
        side.there = side.there || (crosses && any);
        side.to = crosses && any ? crossing : side.to;
        side.from = crosses && !any ? crossing : side.from;
        any = any || crosses;
    }
    return side;
}
//]

//[wedge
// The part of the triangle between the two half-planes of slice j, by its sides. Returns `wide` (see boundaries.glsl).
double sides_in_slice(uint triangle, int j, out double slack, out Side sides[SIDES])
{
    dvec3 p[3] = dvec3[3](epipolar_corner(triangle, 0u), epipolar_corner(triangle, 1u), epipolar_corner(triangle, 2u));
    slack = DOUBT * reach_of(p[0], p[1], p[2]);
    dvec2 from = boundaries[first_boundary(1) + j], to = boundaries[first_boundary(1) + j + 1];
    dvec2 before = dvec2(-from.y, from.x), behind = dvec2(to.y, -to.x); // both look into the wedge
    dvec3 a = dvec3(dot(before, p[0].xy), dot(before, p[1].xy), dot(before, p[2].xy)) + slack;
    dvec3 b = dvec3(dot(behind, p[0].xy), dot(behind, p[1].xy), dot(behind, p[2].xy)) + slack;
    for (int i = 0; i < 3; i++) {
        int next = i == 2 ? 0 : i + 1;
        sides[i] = Side(p[i], p[next], true);
        keep(sides[i], a[i], a[next]);
        keep(sides[i], dot(behind, sides[i].from.xy) + slack, dot(behind, sides[i].to.xy) + slack);
    }
    sides[3] = crossed(p, a);
    keep(sides[3], dot(behind, sides[3].from.xy) + slack, dot(behind, sides[3].to.xy) + slack);
    sides[4] = crossed(p, b);
    keep(sides[4], dot(before, sides[4].from.xy) + slack, dot(before, sides[4].to.xy) + slack);
    dvec2 middle = normalize(from + to); // slices are narrower than π
    for (int i = 0; i < SIDES; i++) {
        sides[i].from = dvec3(max(dot(middle, sides[i].from.xy), 0.0), sides[i].from.z, from_light(sides[i].from.z));
        sides[i].to = dvec3(max(dot(middle, sides[i].to.xy), 0.0), sides[i].to.z, from_light(sides[i].to.z));
    }
    return 1.0 / dot(middle, from);
}
//]

//[range
// The least and the greatest angle of directions (r, along). Of a convex polygon's points they are those of its sides' ends.
struct Range {
    dvec2 least, greatest;
    bool any, all; // all: one is at the eye (the light) itself, where the angle is every angle
};
const Range NO_RANGE = Range(dvec2(0.0), dvec2(0.0), false, false);

void range_add(inout Range range, dvec2 p, bool there, double slack)
{
    range.all = range.all || (there && max(p.x, abs(p.y)) <= slack);
    // the angle of p is less than that of q where p.x q.y < q.x p.y
    bool less = there && (!range.any || p.x * range.least.y < range.least.x * p.y);
    bool more = there && (!range.any || p.x * range.greatest.y > range.greatest.x * p.y);
    range.least = less ? p : range.least;
    range.greatest = more ? p : range.greatest;
    range.any = range.any || there;
}
// The voxels along α (0) or φ (2) that it touches.
ivec2 range_touches(int coordinate, Range range, double wide, double slack)
{
    return range.all ? ivec2(-1, epipolar_count[coordinate]) : touched(coordinate, range.least, range.greatest, wide, slack);
}
//]
