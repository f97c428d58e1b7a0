// Airlight from the volume's bits, by METHOD: runs of equal bits, each lit one integrated in closed form; the sum over all of them (Wyman 2011, equation 5); or
// slices of bits whose lit share is factored out of the rest (Dobashi et al. 2002).
#include "common/airlight_ray.glsl"
#include "06_epipolar_vsv/query.glsl"
#include "06_epipolar_vsv/sample.glsl"
#include "06_epipolar_vsv/stretch.glsl"

#define RUNS 0
#define RIEMANN 1
#define FACTORED 2

//[border
// φ of a border between voxels; the outermost borders are the ends of the ray's stretch. The grid ends where all light rays miss the scene, but the stretch may go
// on, for a directional light without end: a run takes it along, a sum of samples must not.
float border_phi(Query query, int place)
{
    float end = max(min(query.to, epipolar_phi_at(float(epipolar_count.z))), query.from);
    return place <= query.first ? query.from : place >= query.last ? end : clamp(epipolar_phi_at(float(place)), query.from, end);
}
//]

#if METHOD == RUNS
#include "06_epipolar_vsv/runs.glsl"
#else
//[riemann
// Voxels that share one evaluation of what is smooth: one each for the sum of equation 5. Of its N + 1 terms, from 0 to N, the last is one too many: N steps
// make up the ray.
#if METHOD == RIEMANN
const int SHARE = 1;
#else
const int SHARE = SLICE;
#endif

vec3 integral_of(Ray ray, Query query, Row row, inout uint fetches)
{
    vec3 sum = vec3(0.0);
#if EVERYTHING
    int start = 0, stop = epipolar_count.z;
#else
    int start = query.first & ~127, stop = row.dark || (row.lit && TEXTURE == 0) ? start : query.last;
#endif
    for (int quarter = start; quarter < stop; quarter += 128) {
        uvec4 texel = query_texel(row, quarter >> 7);
        fetches++;
        for (int k = 0; k < 128; k += SHARE) {
            int place = quarter + k, from = clamp(query.first - place, 0, SHARE), to = clamp(query.last - place, from, SHARE);
            int lit = to - from - bitCount(bitfieldExtract(texel[k >> 5], (k & 31) + from, to - from));
            float near = border_phi(query, place + from), width = border_phi(query, place + to) - near, middle = near + 0.5 * width;
            if (lit > 0)
                sum += float(lit) / float(to - from) * width * sample_phi(ray, query, middle) * light_texture(query.theta, middle);
        }
    }
#if TEXTURE == 0
    // What is lit throughout needs no sum. Else the sum ends with the grid, beyond which all is lit.
    float last = max(query.from, epipolar_phi_at(float(epipolar_count.z)));
    bool beyond = query.to > last;
    if (row.lit || beyond)
        sum = row.lit ? stretch(ray, ray.from, ray.to) : sum + stretch(ray, clamp(epipolar_along(query.alpha, last), ray.from, ray.to), ray.to);
#endif
    return sum;
}
//]
#endif

//[filter
// Near the epipole a pixel covers many slices, and voxels are long: what one of them says is not the pixel's mean (Wyman 2011, figure 15). Filtered in epipolar
// space, a pixel asks four rows, spread over its own width in θ, or over the voxel where that is wider.
const vec2 taps[4] = vec2[](vec2(-0.375, 0.125), vec2(-0.125, -0.375), vec2(0.125, 0.375), vec2(0.375, -0.125)); // (θ, α)

vec3 filtered(Ray ray, Query query, inout uint fetches)
{
#if FILTER
    float pixel = length(ray_up) / float(imageSize(airlight).y); // its angle, about
    float slices_wide = pixel / max(query.alpha.x, 1e-6) / epipolar_span.y * float(epipolar_count.y);
    float rows_wide = pixel / epipolar_span.x * float(epipolar_count.x);
    vec2 wide = clamp(vec2(rows_wide, slices_wide), vec2(1.0), vec2(epipolar_count.xy));
    vec3 sum = vec3(0.0);
    for (int k = 0; k < 4; k++)
        sum += 0.25 * integral_of(ray, query, query_row(query, taps[k].yx * wide), fetches);
    return sum;
#else
    return integral_of(ray, query, query_row(query, vec2(0.0)), fetches);
#endif
}
//]

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    Ray ray = ray_of(pixel);
    if (!ray_needed(pixel, ray))
        return;
    uint fetches = 0u;
    vec3 sum = filtered(ray, query_of(ray), fetches);
    ray_store(pixel, ray, sum, fetches);
}
