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

dvec3 polygon[5]; // first (x, y, z), then (r, z, w)
int corners;

//[cut
// Keep the part of the polygon where normal · (x, y) ≥ -slack.
void cut(dvec2 normal, double slack)
{
    dvec3 kept[5];
    int count = 0;
    dvec3 from = corners > 0 ? polygon[corners - 1] : dvec3(0.0);
    double from_side = dot(normal, from.xy) + slack;
    for (int i = 0; i < corners; i++) {
        dvec3 to = polygon[i];
        double to_side = dot(normal, to.xy) + slack;
        if ((from_side < 0.0) != (to_side < 0.0) && count < 5)
            kept[count++] = mix(from, to, from_side / (from_side - to_side));
        if (to_side >= 0.0 && count < 5)
            kept[count++] = to;
        from = to;
        from_side = to_side;
    }
    corners = count;
    for (int i = 0; i < count; i++)
        polygon[i] = kept[i];
}
//]

//[wedge
// The part of the triangle between the two half-planes of slice j, as a polygon of (r, z, w). Returns `wide` (see boundaries.glsl).
double polygon_in_slice(uint triangle, int j, out double slack)
{
    for (int i = 0; i < 3; i++)
        polygon[i] = epipolar_corner(triangle, uint(i));
    corners = 3;
    slack = DOUBT * reach_of(polygon[0], polygon[1], polygon[2]);
    dvec2 from = boundaries[first_boundary(1) + j], to = boundaries[first_boundary(1) + j + 1];
    cut(dvec2(-from.y, from.x), slack);
    cut(dvec2(to.y, -to.x), slack);
    dvec2 middle = normalize(from + to); // slices are narrower than π
    for (int i = 0; i < corners; i++)
        polygon[i] = dvec3(max(dot(middle, polygon[i].xy), 0.0), polygon[i].z, from_light(polygon[i].z));
    return 1.0 / dot(middle, from);
}
//]

//[extent
// The voxels along α (0) or φ (2) that the polygon touches. Angles at the eye or the light are greatest and least at a polygon's corners; if a corner is
// at the eye (the light) itself, its angle is every angle.
ivec2 polygon_touches(int coordinate, double wide, double slack)
{
    dvec2 least = dvec2(0.0), greatest = dvec2(0.0);
    bool all = false;
    for (int i = 0; i < corners; i++) {
        dvec2 p = coordinate == 0 ? polygon[i].xy : polygon[i].xz;
        all = all || max(p.x, abs(p.y)) <= slack;
        least = i == 0 || p.x * least.y < least.x * p.y ? p : least; // the angle of p is less than that of q where p.x q.y < q.x p.y
        greatest = i == 0 || p.x * greatest.y > greatest.x * p.y ? p : greatest;
    }
    return all ? ivec2(-1, epipolar_count[coordinate]) : touched(coordinate, least, greatest, wide, slack);
}
//]
