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
    ivec2 row = query_row(query);
    int from = int(clamp(epipolar_phi_place(query.from), 0.0, float(epipolar_count.z - 1)));
    int last = int(clamp(ceil(epipolar_phi_place(query.to)), float(from) + 1.0, float(epipolar_count.z)));
    int set = 0;
    for (int quarter = from >> 7; quarter < (last + 127) >> 7; quarter++) {
        uvec4 texel = query_texel(row, quarter);
        for (int k = 0; k < 4; k++) {
            int before = 128 * quarter + 32 * k; // what lies outside [from, last) is not counted
            int low = clamp(from - before, 0, 32), high = clamp(last - before, low, 32);
            set += bitCount(bitfieldExtract(texel[k], low, high - low));
        }
    }
    imageStore(airlight, pixel, imageLoad(airlight, pixel) + vec4(vec3(ray.inside * float(set) / float(last - from)), 0.0));
}
//]
