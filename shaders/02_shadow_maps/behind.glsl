// behind: a vertex in its place on a paraboloid's half, cut off where it lies too far behind.
#include "common/paraboloid.glsl"

// Around the direction straight back the places of a triangle's corners lie all about the square, and the triangle would cover it. Cut off
// behind here, which is outside the square (PARABOLOID_LEAST_Z) by the size of a piece.
const float CUT_BEHIND_Z = -0.6;

vec4 paraboloid_position(int side, vec3 from_origin)
{
    gl_ClipDistance[0] = normalize(paraboloid_turn(side, from_origin)).z - CUT_BEHIND_Z;
    return vec4(paraboloid_place(side, from_origin), 0.0, 1.0);
}
