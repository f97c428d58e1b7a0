// Airlight of each pixel from the four rows about it, those of them that end as its own ray does. Pixels that have none are listed.
#include "common/airlight_ray.glsl"
#include "06_epipolar_vsv/query.glsl"
#include "06_epipolar_vsv/sparse.glsl"
layout(binding = 5, rgba32f) readonly uniform image2D rows; // (θ, α)

// How far the interpolated span of φ may be from the pixel's: voxels, or of the span. One row alone may be four times as far, for on a sloping surface rows to
// both sides make up for each other; beyond that it is another surface's. Below a twentieth of all shares a pixel hangs on what is farthest from it.
const float VOXELS = 2.0, SPAN = 0.02, ROW = 4.0, SHARE = 0.05;

// The four rows about a place (α, θ), in voxels, and their shares.
struct Corners {
    vec4 row[4], share;
    bool between; // not before the first α: towards the light's image airlight grows without end, and what is nearest there says little
};

Corners corners_of(vec2 place)
{
    Between at = query_between(place);
    vec2 beyond = at.beyond, before = 1.0 - beyond;
    Corners corners;
    corners.row = vec4[](imageLoad(rows, at.least.yx), imageLoad(rows, ivec2(at.least.y, at.most.x)), imageLoad(rows, ivec2(at.most.y, at.least.x)), imageLoad(rows, at.most.yx));
    corners.between = place.x >= 0.5;
    corners.share = vec4(before.x, beyond.x, before.x, beyond.x) * vec4(before.yy, beyond.yy);
    return corners;
}

//[between
void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    Ray ray = ray_of(pixel);
    if (!ray_needed(pixel, ray))
        return;
    vec3 epipolar = to_epipolar(ray.direction);
    vec2 alpha = vec2(length(cross(epipolar_axis, ray.direction)), dot(epipolar_axis, ray.direction));
    float span = epipolar_phi(alpha, ray.to) - (ray.from > 0.0 ? epipolar_phi(alpha, ray.from) : 0.0);
    Corners corners = corners_of(vec2(epipolar_alpha_place(epipolar.x), epipolar_theta_place(epipolar.y)));
    // Airlight is an integral over φ: where spans are alike it does not matter that surfaces are not.
    vec4 off = vec4(corners.row[0].w, corners.row[1].w, corners.row[2].w, corners.row[3].w) - span;
    float alike = max(VOXELS * epipolar_span.z / float(epipolar_count.z), SPAN * span);
    vec4 share = corners.share * vec4(lessThan(abs(off), vec4(ROW * alike)));
    float all = dot(share, vec4(1.0));
    bool found = all > SHARE && abs(dot(share, off)) <= all * alike && corners.between && sparse_outside(ray);
    if (!found || EVERYTHING == 1) {
        uint at = atomicAdd(left, 1u);
        if ((at & (64u * uint(SPARSE_WIDE) - 1u)) == 0u)
            atomicAdd(left_high, 1u);
        left_pixel[at] = uint(found) << 31 | uint(pixel.y) << 16 | uint(pixel.x);
    }
    if (found) {
        vec3 sum = share.x * corners.row[0].rgb + share.y * corners.row[1].rgb + share.z * corners.row[2].rgb + share.w * corners.row[3].rgb;
        ray_store(pixel, ray, sum / (all * sparse_smooth(ray)), 4u);
    }
}
//]
