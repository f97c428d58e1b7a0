// epipolar: points as three angles that eye and light make of them, so that light rays and view rays both run along an axis of a grid (Hunt and Mark 2008; Wyman
// 2011, section 2.1). Taught line by line in chapter 06.
//
//   α  at the eye, between the way to the light and the point: a view ray has one α;
//   θ  about the line from eye to light, from `epipolar_up` towards `epipolar_side`: eye, light and one θ make half a plane;
//   φ  at the light, between the way to the eye and the point: a light ray has one θ and one φ.
//
// α + φ < π. Along a view ray φ grows from 0 at the eye towards π - α; along a light ray α grows from 0 at the light. A directional light is infinitely far
// (EPIPOLE_AT_INFINITY): φ is 0 everywhere, and what tells light rays apart is the distance from the axis, which takes its place.
// Points are relative to the eye. chapters/06_epipolar_vsv/epipolar.h sets the uniforms.
#ifndef EPIPOLAR_GLSL
#define EPIPOLAR_GLSL

#ifndef EPIPOLE_AT_INFINITY
#define EPIPOLE_AT_INFINITY 0
#endif
// How φ is spread over the grid: evenly, as the square, or by a table (densely where shadows have borders).
#define WARP_EVEN 0
#define WARP_SQUARE 1
#define WARP_TABLE 2
#define WARP_STEPS 256 // of φ, by which the table is made
#ifndef WARP
#define WARP WARP_EVEN
#endif
// How θ is: evenly, or by a table (slices that lie at most a pixel apart).
#ifndef THETA_TABLE
#define THETA_TABLE 0
#endif

uniform vec3 epipolar_axis, epipolar_up, epipolar_side; // unit, at right angles; the axis points from the eye to the light
uniform float epipolar_distance;                        // metres from the eye to the light; not for EPIPOLE_AT_INFINITY
uniform vec3 epipolar_least, epipolar_span;             // what the grid covers of (α, θ, φ), from where and how much
uniform ivec3 epipolar_count;                           // voxels along (α, θ, φ)
#if THETA_TABLE
layout(std430, binding = 3) readonly buffer ThetaTable { float theta_border[]; }; // rising from 0 to 1, epipolar_count.y + 1 of them
#endif

#if WARP == WARP_TABLE
layout(std430, binding = 7) readonly buffer WarpTable { float warp_border[]; }; // rising from 0 to 1 over a row's bytes, whose voxels are of one width
#endif

const float EPIPOLAR_PI = 3.14159265;

//[to_epipolar
// Wyman prints acos of dot products, clamped, since rounding may leave [-1, 1]. Near 0 and π a step of 2^-24 in the cosine is 3.5e-4 rad, though; the tangent's
// two parts, |cross| and dot, are as exact as the point itself. The light's |cross| is the eye's: both are the distance from the axis.
vec3 to_epipolar(vec3 from_eye)
{
    float along = dot(epipolar_axis, from_eye), beside = length(cross(epipolar_axis, from_eye));
    float theta = atan(dot(epipolar_side, from_eye), dot(epipolar_up, from_eye));
#if EPIPOLE_AT_INFINITY
    float phi = beside;
#else
    float phi = atan(beside, epipolar_distance - along);
#endif
    return vec3(atan(beside, along), theta, phi);
}
//]

//[along
// How far along the view ray of this (sin α, cos α) the light ray φ crosses it: the law of sines. Infinite where they do not meet.
float epipolar_along(vec2 alpha, float phi)
{
#if EPIPOLE_AT_INFINITY
    return phi / max(alpha.x, 1e-30);
#else
    float sine = sin(phi), third = alpha.x * cos(phi) + alpha.y * sine; // sin(α + φ)
    return third > 0.0 ? epipolar_distance * (sine / max(third, 1e-30)) : 1.0 / 0.0;
#endif
}

// The φ of the point at `along` on that ray: the other way round.
float epipolar_phi(vec2 alpha, float along)
{
#if EPIPOLE_AT_INFINITY
    return along * alpha.x;
#else
    float far = min(along, 1e30); // at infinity: π - α
    return atan(far * alpha.x, epipolar_distance - far * alpha.y);
#endif
}

// The α of the point at `way` from the light (for a directional one: along the axis from the eye) on the light ray φ.
float epipolar_alpha(float phi, float way)
{
#if EPIPOLE_AT_INFINITY
    return atan(phi, way);
#else
    return atan(way * sin(phi), epipolar_distance - way * cos(phi));
#endif
}
//]

// The unit vector at right angles to the axis in the half plane θ.
vec3 epipolar_beside(float theta)
{
    return cos(theta) * epipolar_up + sin(theta) * epipolar_side;
}

// The point again, relative to the eye.
vec3 from_epipolar(vec3 epipolar)
{
    float sine = sin(epipolar.x), cosine = cos(epipolar.x);
    return epipolar_along(vec2(sine, cosine), epipolar.z) * (cosine * epipolar_axis + sine * epipolar_beside(epipolar.y));
}

//[grid
// Place in the grid, in voxels: voxel i covers [i, i + 1], and stands for the light rays through i + 1/2. What the grid does not cover lies beside it.
float epipolar_phi_place(float phi)
{
    float u = (phi - epipolar_least.z) / epipolar_span.z;
#if WARP == WARP_SQUARE
    u = sqrt(max(u, 0.0));
#elif WARP == WARP_TABLE
    int below = 0, above = epipolar_count.z / 8;
    u = max(u, 0.0);
    for (int step = 0; step < 7; step++) { // halves up to 128 bytes
        int middle = (below + above) / 2;
        bool beyond = warp_border[middle] > u;
        above = beyond ? middle : above;
        below = beyond ? below : middle;
    }
    float inside = clamp((u - warp_border[below]) / (warp_border[below + 1] - warp_border[below]), 0.0, 1.0);
    u = (float(below) + inside) * 8.0 / float(epipolar_count.z);
#endif
    return u * float(epipolar_count.z);
}

float epipolar_phi_at(float place)
{
    float u = place / float(epipolar_count.z);
#if WARP == WARP_SQUARE
    u *= u;
#elif WARP == WARP_TABLE
    int byte = clamp(int(place / 8.0), 0, epipolar_count.z / 8 - 1);
    u = mix(warp_border[byte], warp_border[byte + 1], place / 8.0 - float(byte));
#endif
    return epipolar_least.z + u * epipolar_span.z;
}

float epipolar_alpha_place(float alpha)
{
    return (alpha - epipolar_least.x) / epipolar_span.x * float(epipolar_count.x);
}

float epipolar_alpha_at(float place)
{
    return epipolar_least.x + place / float(epipolar_count.x) * epipolar_span.x;
}

// θ goes round: it is taken the nearest way to the middle of what the grid covers.
float epipolar_theta_place(float theta)
{
    float from_middle = theta - (epipolar_least.y + 0.5 * epipolar_span.y);
    from_middle -= 2.0 * EPIPOLAR_PI * round(from_middle / (2.0 * EPIPOLAR_PI));
    float u = clamp(from_middle / epipolar_span.y + 0.5, 0.0, 1.0);
#if THETA_TABLE
    int below = 0, above = epipolar_count.y;
    for (int step = 0; step < 16; step++) { // halves up to 65536 slices
        int middle = (below + above) / 2;
        bool beyond = theta_border[middle] > u;
        above = beyond ? middle : above;
        below = beyond ? below : middle;
    }
    float width = theta_border[below + 1] - theta_border[below];
    return float(below) + (width > 0.0 ? clamp((u - theta_border[below]) / width, 0.0, 1.0) : 0.5);
#else
    return u * float(epipolar_count.y);
#endif
}

float epipolar_theta_at(float place)
{
#if THETA_TABLE
    int slice = clamp(int(place), 0, epipolar_count.y - 1);
    float u = mix(theta_border[slice], theta_border[slice + 1], place - float(slice));
#else
    float u = place / float(epipolar_count.y);
#endif
    return epipolar_least.y + u * epipolar_span.y;
}

vec3 epipolar_place(vec3 epipolar)
{
    return vec3(epipolar_alpha_place(epipolar.x), epipolar_theta_place(epipolar.y), epipolar_phi_place(epipolar.z));
}
//]

//[address
// A bit a voxel: 32 φ a word, 4 words a texel of 128 bits; all φ of a view ray (α, θ) lie side by side, then θ, then α, so that what scans along α reads and
// writes whole lines of memory. A word column is the words of one θ and 32 φ at all α.
int epipolar_row_words()
{
    return epipolar_count.z / 32;
}
int epipolar_columns()
{
    return epipolar_count.y * epipolar_row_words();
}
int epipolar_column(int theta, int word)
{
    return theta * epipolar_row_words() + word;
}
int epipolar_word(int alpha, int theta, int word)
{
    return alpha * epipolar_columns() + epipolar_column(theta, word);
}
//]

#endif
