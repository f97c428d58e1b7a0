// Where along φ the picture's shadows have their borders: a ray in stride² is walked through the depth map, and each change between light and shadow counts by
// how much light a voxel's width there is worth, of all that its ray could bring. chapters/06_epipolar_vsv/spread.c makes the table of it.
#include "common/airlight_ray.glsl"
#include "06_epipolar_vsv/query.glsl"
#include "06_epipolar_vsv/sample.glsl"
#include "06_epipolar_vsv/stretch.glsl"
layout(std430, binding = 5) buffer Borders { uint weight[]; };
uniform int stride; // pixels

//[borders
void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy) * stride + stride / 2;
    if (any(greaterThanEqual(pixel, imageSize(distances))))
        return;
    Ray ray = ray_of(pixel);
    Query query = query_of(ray);
    float step = epipolar_span.z / float(WARP_STEPS), whole = stretch(ray, ray.from, ray.to).x;
    int first = int(ceil((query.from - epipolar_least.z) / step - 0.5)), last = int(floor(min((query.to - epipolar_least.z) / step, float(WARP_STEPS)) - 0.5));
    bool lit = true;
    for (int i = max(first, 0); i <= last && ray.inside > 0.0; i++) {
        float phi = epipolar_least.z + (float(i) + 0.5) * step;
        bool before = lit;
        lit = ray_lit(ray, epipolar_along(query.alpha, phi)) > 0.5;
        if (lit != before && i > max(first, 0)) {
            float share = sample_phi(ray, query, phi).x * epipolar_span.z / whole;
            atomicAdd(weight[i], uint(min(1.0 + 16.0 * share * share, 1e5))); // at most 2^15 rays
        }
    }
}
//]
