// flat: triangles as Wyman voxelizes them (2011, sections 2.2.1 and 4.1.1): corners are taken to (α, θ, φ) and joined by straight edges there. Straight lines in space are
// curved there, so a triangle is subdivided until they are nearly straight; and where θ jumps, or is no number at all, it must be split.
// Angles are single precision here, by to_epipolar, as in the paper.
#include "06_epipolar_vsv/voxels.glsl"

layout(std430, binding = 6) readonly buffer Positions { float positions[]; }; // 3 a vertex, metres
layout(std430, binding = 7) readonly buffer Indices { uint indices[]; };      // 3 a triangle
uniform dvec3 eye;
uniform double first_angle; // θ where the first slice begins
uniform int splits;         // SPLIT_WRAP, SPLIT_EPIPOLE
uniform int parts_most;     // along an edge

const int SPLIT_WRAP = 1, SPLIT_EPIPOLE = 2;
const float TURN = 6.28318531;

vec3 flat_corner(uint triangle, uint corner)
{
    uint at = 3u * indices[3u * triangle + corner];
    return vec3(dvec3(positions[at], positions[at + 1u], positions[at + 2u]) - eye);
}
float nearest_turn(float angle)
{
    return angle - TURN * round(angle / TURN);
}

//[parts
// Into how many parts each edge is cut: an edge's middle deviates from the straight one by d voxels, which falls with the square of the parts. A quarter of a
// voxel is allowed; `parts_most` is a limit for walls that pass near the eye or the light, where d has none.
const float DEVIATION = 0.25;
int parts_of(vec3 p[3])
{
    float deviation = 0.0;
    for (int i = 0; i < 3; i++) {
        vec3 a = to_epipolar(p[i]), b = to_epipolar(p[(i + 1) % 3]), middle = to_epipolar(0.5 * (p[i] + p[(i + 1) % 3]));
        b.y = a.y + nearest_turn(b.y - a.y);
        middle.y = a.y + nearest_turn(middle.y - a.y);
        vec3 off = abs(0.5 * (a + b) - middle) / epipolar_span * vec3(epipolar_count);
        deviation = max(deviation, max(off.x, max(off.y, off.z)));
    }
    return clamp(int(ceil(sqrt(deviation / DEVIATION))), 1, parts_most);
}

// Part `part` of n²: rows of 1, 3, 5, … triangles from the first corner on.
void cut_part(inout vec3 p[3], int n, int part)
{
    int row = int(sqrt(float(part) + 0.5)), at = part - row * row, j = at / 2;
    bool down = (at & 1) == 1;
    vec3 u = (p[1] - p[0]) / float(n), v = (p[2] - p[0]) / float(n), from = p[0];
    p[0] = from + float(row - j) * u + float(j) * v;
    p[1] = down ? p[0] - u + v : p[0] + u;
    p[2] = p[0] + v;
}
//]

vec3 around[4]; // the corners as (α, θ, φ), the first one again at the end; θ from the first slice's beginning on
bool pierced;   // by the axis
vec2 pole;      // (α, φ) there

//[split
// The two splits of section 4.1.1. The wrap: θ goes on from corner to corner the near way, past 2π or below 0, and what lies there is a copy in the grid one turn
// away. The epipole: if θ has gone a whole turn when it comes back to the first corner, the axis pierces the triangle; each edge then makes a piece with two virtual
// corners on the axis, where α is 0 or π for every θ.
void split(vec3 p[3])
{
    for (int i = 0; i < 3; i++) {
        around[i] = to_epipolar(p[i]);
        around[i].y -= float(first_angle);
        around[i].y -= TURN * floor(around[i].y / TURN);
    }
    float to_1 = nearest_turn(around[1].y - around[0].y), to_2 = nearest_turn(around[2].y - around[1].y), to_0 = nearest_turn(around[0].y - around[2].y);
    pierced = abs(to_1 + to_2 + to_0) > 1.0 && (splits & SPLIT_EPIPOLE) != 0;
    if ((splits & SPLIT_WRAP) != 0 || pierced) {
        around[1].y = around[0].y + to_1;
        around[2].y = around[1].y + to_2;
    }
    around[3] = vec3(around[0].x, pierced ? around[2].y + to_0 : around[0].y, around[0].z);
    vec3 normal = cross(p[1] - p[0], p[2] - p[0]);
    float along = dot(normal, p[0]) / dot(normal, epipolar_axis);
#if EPIPOLE_AT_INFINITY
    pole = vec2(along < 0.0 ? EPIPOLAR_PI : 0.0, 0.0);
#else
    pole = vec2(along < 0.0 ? EPIPOLAR_PI : 0.0, along > epipolar_distance ? EPIPOLAR_PI : 0.0);
#endif
}
//]

vec3 polygon[6];
int corners;

// One of three pieces of a pierced triangle; else its only one.
void piece(int i, float turn)
{
    polygon[0] = around[pierced ? i : 0];
    polygon[1] = around[pierced ? i + 1 : 1];
    polygon[2] = pierced ? vec3(pole.x, polygon[1].y, pole.y) : around[2];
    polygon[3] = vec3(pole.x, polygon[0].y, pole.y);
    corners = pierced ? 4 : 3;
    for (int k = 0; k < 4; k++)
        polygon[k].y += turn;
}
