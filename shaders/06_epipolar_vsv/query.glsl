// query: what a pixel asks of the scanned volume. Comes after common/airlight_ray.glsl, which knows the pixel's ray.
#ifndef QUERY_GLSL
#define QUERY_GLSL
#define EPIPOLE_AT_INFINITY (MAP_KIND == DIRECTIONAL)
#include "common/epipolar.glsl"
#include "06_epipolar_vsv/slices.glsl"
layout(binding = 4, rgba32ui) readonly uniform uimageBuffer texels; // the words of voxels.glsl, four a texel

// A view ray in the epipolar space: its angle to the axis, and which of the volume's view rays are nearest.
struct Query {
    vec2 alpha;           // sine, cosine
    float from, to;       // φ of the ends of the ray's stretch that light can reach
    float alpha_place, theta_place;
};

//[query
Query query_of(Ray ray)
{
    vec3 epipolar = to_epipolar(ray.direction); // α and θ do not depend on the length
    vec2 alpha = vec2(length(cross(epipolar_axis, ray.direction)), dot(epipolar_axis, ray.direction));
    return Query(alpha, epipolar_phi(alpha, ray.from), epipolar_phi(alpha, ray.to), epipolar_alpha_place(epipolar.x), epipolar_theta_place(epipolar.y));
}

// The row of the nearest view ray: (α, θ).
ivec2 query_row(Query query)
{
    return clamp(ivec2(floor(vec2(query.alpha_place, query.theta_place))), ivec2(0), epipolar_count.xy - 1);
}

// 128 visibilities along a view ray by one fetch; a set bit is in shadow.
uvec4 query_texel(ivec2 row, int quarter)
{
    return imageLoad(texels, epipolar_word(row.x, row.y, 4 * quarter) >> 2);
}
//]

#endif
