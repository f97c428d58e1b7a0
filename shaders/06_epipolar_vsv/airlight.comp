// Airlight from the volume's bits. METHOD 0: runs of equal bits, each lit one integrated in closed form.
#include "common/airlight_ray.glsl"
#include "06_epipolar_vsv/query.glsl"

#define RUNS 0
#define RIEMANN 1
#define FACTORED 2

vec3 stretch(Ray ray, float from, float to)
{
#if MAP_KIND == DIRECTIONAL
#define INTEGRAL(sigma) airlight_directional(from, to, sigma)
    float scattered = phase(phase_half_angle(light_direction, ray.direction));
#else
#define INTEGRAL(sigma) airlight_point(ray.nearest, ray.foot, light_radius, from, to, sigma)
    const float scattered = 1.0;
#endif
#if GREY && !EVERYTHING
    return vec3(scattered * INTEGRAL(extinction.x));
#else
    return scattered * vec3(INTEGRAL(extinction.x), INTEGRAL(extinction.y), INTEGRAL(extinction.z));
#endif
}

// Where along the ray the border `place` of the grid lies; the ends are the ray's own.
float border_along(Ray ray, Query query, float place, float first, float last)
{
    float along = clamp(epipolar_along(query.alpha, epipolar_phi_at(place)), ray.from, ray.to);
    return place <= first ? ray.from : place >= last ? ray.to : along;
}

//[runs
// The next place at or after `place` whose bit is `value`; `last` where there is none. Words are looked at whole.
int next_bit(ivec2 row, int place, int last, bool value, inout uint fetches)
{
    bool found = place >= last;
    while (!found) {
        uint word = query_texel(row, place >> 7)[(place >> 5) & 3];
        fetches++;
        uint rest = (value ? word : ~word) & (~0u << (place & 31));
        place = rest != 0u ? (place & ~31) + findLSB(rest) : (place & ~31) + 32;
        found = rest != 0u || place >= last;
    }
    return min(place, last);
}

vec3 integral_of(Ray ray, Query query, inout uint fetches)
{
    ivec2 row = query_row(query);
    float first = floor(clamp(epipolar_phi_place(query.from), 0.0, float(epipolar_count.z - 1)));
    float last = ceil(clamp(epipolar_phi_place(query.to), first + 1.0, float(epipolar_count.z)));
    vec3 sum = vec3(0.0);
    int place = next_bit(row, int(first), int(last), false, fetches);
    while (place < int(last)) {
        int end = next_bit(row, place, int(last), true, fetches);
        sum += stretch(ray, border_along(ray, query, float(place), first, last), border_along(ray, query, float(end), first, last));
        place = next_bit(row, end, int(last), false, fetches);
    }
    return sum;
}
//]

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    Ray ray = ray_of(pixel);
    if (!ray_needed(pixel, ray))
        return;
    uint fetches = 0u;
    Query query = query_of(ray);
    vec3 sum = integral_of(ray, query, fetches);
    ray_store(pixel, ray, sum, fetches);
}
