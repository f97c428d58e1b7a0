// How much of each view ray lies in shadow, as a share of its voxels up to the first surface (Wyman 2011, figure 7).
#include "common/airlight_ray.glsl"
#include "06_epipolar_vsv/query.glsl"

//[counts
void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    Ray ray = ray_of(pixel);
    if (!ray_needed(pixel, ray))
        return;
    Query query = query_of(ray);
    Row row = query_row(query, vec2(0.0));
    int set = 0;
    for (int quarter = query.first >> 7; quarter < (query.last + 127) >> 7; quarter++) {
        uvec4 texel = row.lit ? uvec4(0u) : query_texel(row, quarter);
        for (int k = 0; k < 4; k++) {
            int before = 128 * quarter + 32 * k; // what lies outside [first, last) is not counted
            int low = clamp(query.first - before, 0, 32), high = clamp(query.last - before, low, 32);
            set += bitCount(bitfieldExtract(texel[k], low, high - low));
        }
    }
    imageStore(airlight, pixel, imageLoad(airlight, pixel) + vec4(vec3(ray.inside * float(set) / float(query.last - query.first)), 0.0));
}
//]
