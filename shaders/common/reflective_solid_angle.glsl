// reflective_solid_angle: how much of all directions a texel of a perspective map covers. Taught in chapter 02.
#ifndef REFLECTIVE_SOLID_ANGLE_GLSL
#define REFLECTIVE_SOLID_ANGLE_GLSL

//[solid_angle
// atan(x) for x ≥ 0 to a few units in the last place: GLSL's own is off by 3e-6, more than a texel's whole angle. Each of three steps halves the
// angle, atan x = 2 atan(x / (1 + √(1 + x²))), so that the series below meets π/16 at most, where its first term left out is 1e-8.
float angle_of_tangent(float x)
{
    for (int i = 0; i < 3; i++)
        x = x / (1.0 + sqrt(1.0 + x * x));
    float s = x * x;
    return 8.0 * x * (1.0 - s * (1.0 / 3.0 - s * (1.0 / 5.0 - s * (1.0 / 7.0 - s / 9.0))));
}

// Solid angle of the triangle a, b, c seen from 0 (van Oosterom and Strackee 1983): tan(Ω/2) = a·(b×c) / (|a||b||c| + a·b |c| + b·c |a| + c·a |b|).
// `triple` is a·(b×c), which the caller knows without loss.
float solid_angle_of_triangle(vec3 a, vec3 b, vec3 c, float triple)
{
    float la = length(a), lb = length(b), lc = length(c);
    return 2.0 * angle_of_tangent(triple / (la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb));
}

// Of the square [corner, corner + side]² in the plane at distance 1. Two triangles, both with the triple product side²: nothing cancels, while the
// textbook's four arc tangents, of order 1 each, lose all digits of a small texel in their difference.
float solid_angle_of_square(vec2 corner, float side)
{
    vec3 a = vec3(corner, 1.0), b = vec3(corner.x + side, corner.y, 1.0), c = vec3(corner + side, 1.0),
         d = vec3(corner.x, corner.y + side, 1.0);
    float triple = side * side;
    return solid_angle_of_triangle(a, b, c, triple) + solid_angle_of_triangle(a, c, d, triple);
}
//]

#endif
