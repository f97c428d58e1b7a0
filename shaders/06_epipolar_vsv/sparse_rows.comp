// Airlight of each of the grid's own view rays, by its runs, up to the surface in the pixel that it passes through: what pixels are interpolated between.
#include "common/airlight_ray.glsl"
#include "06_epipolar_vsv/query.glsl"
#include "06_epipolar_vsv/stretch.glsl"
#include "06_epipolar_vsv/runs.glsl"
#include "06_epipolar_vsv/sparse.glsl"
layout(binding = 5, rgba32f) writeonly uniform image2D rows; // (θ, α)

// Where in the picture, in pixels, a direction is; far outside where it is behind the eye.
vec2 place_of(vec3 direction)
{
    vec4 clip = camera_clip(direction, 0.0);
    return clip.w > 0.0 ? vec2(imageSize(distances)) * (0.5 + 0.5 * clip.xy / clip.w) : vec2(1e9);
}

//[rows
void main()
{
    ivec2 at = ivec2(gl_GlobalInvocationID.yx); // (α, θ)
    if (any(greaterThanEqual(at, epipolar_count.xy)))
        return;
    float alpha = epipolar_alpha_at(float(at.x) + 0.5), sine = sin(alpha);
    vec3 direction = cos(alpha) * epipolar_axis + sine * epipolar_beside(epipolar_theta_at(float(at.y) + 0.5));
    // A row beside the picture is of use to the pixels at its border alone, and ends where they do.
    vec2 size = vec2(imageSize(distances)), place = place_of(direction), inside = clamp(place, vec2(0.5), size - 0.5);
    float apart = max(epipolar_span.x / float(epipolar_count.x), sine * epipolar_span.y / float(epipolar_count.y));
    bool used = distance(place, inside) < 2.0 + 2.0 * apart * size.y / length(ray_up);
#if !EVERYTHING
    if (!used) {
        imageStore(rows, at.yx, SPARSE_NONE);
        return;
    }
#endif
    Ray ray = ray_along(direction, imageLoad(distances, ivec2(inside)).x);
    Query query = query_of(ray);
    query.alpha_place = float(at.x) + 0.5; // not the neighbour's, by rounding
    query.theta_place = float(at.y) + 0.5;
    uint fetches = 0u;
    vec3 sum = integral_of(ray, query, query_row(query, vec2(0.0)), fetches) * sparse_smooth(ray);
    imageStore(rows, at.yx, used && sparse_outside(ray) ? ray.inside * vec4(sum, query.to - query.from) : SPARSE_NONE);
#if COUNT
    atomicAdd(lookups, fetches);
#endif
}
//]
