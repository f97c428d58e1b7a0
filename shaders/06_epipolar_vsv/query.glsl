// query: what a pixel asks of the scanned volume. Comes after common/airlight_ray.glsl, which knows the pixel's ray.
#ifndef QUERY_GLSL
#define QUERY_GLSL
#define EPIPOLE_AT_INFINITY (MAP_KIND == DIRECTIONAL)
#include "common/epipolar.glsl"
#include "06_epipolar_vsv/slices.glsl"
layout(binding = 4, rgba32ui) readonly uniform uimageBuffer texels; // the words of voxels.glsl, four a texel

// A pixel's ray in the epipolar space.
struct Query {
    float angle, theta;              // α, θ
    vec2 alpha;                      // its sine and cosine
    float from, to;                  // φ of the ends of the stretch that light can reach
    int first, last;                 // voxels [first, last) whose middles it meets, at least one; what lies beside the grid counts to its outermost voxels
    float alpha_place, theta_place;  // which of the grid's view rays is nearest
};

//[query
Query query_of(Ray ray)
{
    vec3 epipolar = to_epipolar(ray.direction); // α and θ do not depend on the length
    Query query;
    query.angle = epipolar.x;
    query.theta = epipolar.y;
    query.alpha = vec2(length(cross(epipolar_axis, ray.direction)), dot(epipolar_axis, ray.direction));
    query.from = epipolar_phi(query.alpha, ray.from);
    query.to = epipolar_phi(query.alpha, ray.to);
    query.first = int(round(clamp(epipolar_phi_place(query.from), 0.0, float(epipolar_count.z - 1))));
    query.last = int(round(clamp(epipolar_phi_place(query.to), float(query.first) + 1.0, float(epipolar_count.z))));
    query.alpha_place = epipolar_alpha_place(epipolar.x);
    query.theta_place = epipolar_theta_place(epipolar.y);
    return query;
}
//]

// One row of voxels: a view ray (α, θ) of the grid, and what its slice says of it.
struct Row { ivec2 at; bool lit, dark; };

//[row
// `beside`: how far from the pixel's own place, in voxels. Round a whole turn the first slice follows the last.
Row query_row(Query query, vec2 beside)
{
    Row row;
    row.at = ivec2(floor(vec2(query.alpha_place, query.theta_place) + beside));
    if (epipolar_span.y > 6.28)
        row.at.y = (row.at.y + epipolar_count.y) % epipolar_count.y;
    row.at = clamp(row.at, ivec2(0), epipolar_count.xy - 1);
    Slice slice = slices[row.at.y];
    row.lit = row.at.x < int(slice.any);
    row.dark = row.at.x >= int(slice.all);
    return row;
}

//[four
// The four rows about a place (α, θ), in voxels: a row stands for the middle of its own. Round a whole turn the first slice follows the last.
struct Between { ivec2 least, most; vec2 beyond; }; // beyond: how much of the way to `most`

Between query_between(vec2 place)
{
    place -= 0.5;
    vec2 below = floor(place);
    bool round_trip = epipolar_span.y > 2.0 * EPIPOLAR_PI - 1e-4;
    ivec2 last = epipolar_count.xy - 1, least = clamp(ivec2(below), ivec2(0), last), most = clamp(ivec2(below) + 1, ivec2(0), last);
    least.y = round_trip && below.y < 0.0 ? last.y : least.y;
    most.y = round_trip && int(below.y) == last.y ? 0 : most.y;
    return Between(least, most, place - below);
}
//]

// 128 visibilities along a view ray by one fetch; a set bit is in shadow.
uvec4 query_texel(Row row, int quarter)
{
    return imageLoad(texels, epipolar_word(row.at.x, row.at.y, 4 * quarter) >> 2);
}
//]

#endif
