// boundaries: where the voxels' faces lie, as directions, and between which of them a direction lies. In double, since a sign decides.
//
// Within a slice (the wedge between two half-planes θ through eye and light) a point is (r, z, w): r across the axis, along the slice's middle; z along
// the axis from the eye; w along it from the light back to the eye. α is the angle of (r, z), φ that of (r, w), each from 0 (r = 0, the other
// positive) to π. All three are linear in the point: a face of α is a line through the eye, one of φ a line through the light. Under a light at
// infinity w is 1 m everywhere, a boundary (1, distance): its rays are lines of equal r.
#ifndef BOUNDARIES_GLSL
#define BOUNDARIES_GLSL
#include "06_epipolar_vsv/voxels.glsl"

layout(std430, binding = 5) readonly buffer Boundaries { dvec2 boundaries[]; }; // cosine and sine; of α, then of θ, then of φ

int first_boundary(int coordinate)
{
    return coordinate == 0 ? 0 : coordinate == 1 ? epipolar_count.x + 1 : epipolar_count.x + epipolar_count.y + 2;
}

//[beyond
// How far the direction (r, along) lies beyond a boundary, in metres: |(r, along)| sin(its angle - the boundary's). A slice is a wedge, and r is measured along
// its middle: the distance from the axis is anything from r to r · wide, wide = 1/cos(half the wedge's angle). So there is a least and a most.
double beyond_least(dvec2 boundary, dvec2 direction, double wide)
{
    return direction.x * boundary.x * (boundary.x > 0.0 ? 1.0LF : wide) - direction.y * boundary.y;
}
double beyond_most(dvec2 boundary, dvec2 direction, double wide)
{
    return direction.x * boundary.x * (boundary.x > 0.0 ? wide : 1.0LF) - direction.y * boundary.y;
}
//]

//[touched
// The voxel that single precision says the direction is in: nearly always right.
int guess(int coordinate, dvec2 direction)
{
#if EPIPOLE_AT_INFINITY
    float angle = coordinate == 2 ? float(direction.x) : atan(float(direction.x), float(direction.y));
#else
    float angle = atan(float(direction.x), float(direction.y));
#endif
    return int(floor(clamp(coordinate == 2 ? epipolar_phi_place(angle) : epipolar_alpha_place(angle), 0.0, float(epipolar_count[coordinate]))));
}

// The first and last voxel along a coordinate that directions from `least` to `greatest` touch; closed: what lies in a face touches both sides. -1 is before the
// range, its count beyond it. `slack`: metres of doubt. The search begins at the guess; if its voxel is right, the second step is the last.
ivec2 touched(int coordinate, dvec2 least, dvec2 greatest, double wide, double slack)
{
    int base = first_boundary(coordinate), count = epipolar_count[coordinate];
    ivec2 below = ivec2(0), above = ivec2(count + 1); // boundaries below `below` are passed, those from `above` on are not
    ivec2 next = ivec2(guess(coordinate, least), guess(coordinate, greatest)), step = ivec2(0);
    for (int i = 0; any(lessThan(below, above)); i++) {
        ivec2 probe = clamp(i == 0 ? next : i == 1 ? next + step : (below + above) / 2, below, max(above - 1, below));
        bvec2 open = lessThan(below, above);
        probe = min(probe, ivec2(count));
        bvec2 passed = bvec2(beyond_least(boundaries[base + probe.x], least, wide) > slack,
                             beyond_most(boundaries[base + probe.y], greatest, wide) >= -slack);
        step = ivec2(passed.x ? 1 : -1, passed.y ? 1 : -1);
        below = ivec2(open.x && passed.x ? probe.x + 1 : below.x, open.y && passed.y ? probe.y + 1 : below.y);
        above = ivec2(open.x && !passed.x ? probe.x : above.x, open.y && !passed.y ? probe.y : above.y);
    }
    return below - 1;
}
//]

#endif
