// Airlight by runs of the pixels that no row speaks for.
#include "common/airlight_ray.glsl"
#include "06_epipolar_vsv/query.glsl"
#include "06_epipolar_vsv/stretch.glsl"
#include "06_epipolar_vsv/runs.glsl"
#include "06_epipolar_vsv/sparse.glsl"

void main()
{
    uint at = (gl_WorkGroupID.y * uint(SPARSE_WIDE) + gl_WorkGroupID.x) * 64u + gl_LocalInvocationIndex;
    if (at >= left)
        return;
    uint listed = left_pixel[at];
    ivec2 pixel = ivec2(listed & 65535u, (listed >> 16) & 32767u);
    Ray ray = ray_of(pixel);
    Query query = query_of(ray);
    uint fetches = 0u;
    vec3 sum = integral_of(ray, query, query_row(query, vec2(0.0)), fetches);
    if (listed >> 31 == 0u) // with --everything the others ask, too, for nothing
        ray_store(pixel, ray, sum, fetches);
}
