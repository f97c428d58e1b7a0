// The methods that sample the ray: uniform midpoints, jittered, equiangular, and factored. `steps` samples each.
#include "common/airlight_ray.glsl"
#if EXACT
#include "common/airlight_exact.glsl"
#endif

#define MARCH 0
#define JITTERED 1
#define EQUIANGULAR 2
#define FACTORED 3
uniform int steps;
uniform uint seed;

const int SUBSAMPLES = 4; // factored: lookups that share one evaluation of what is smooth

// PCG's permutation of 32 bits (Jarzynski and Olano 2020), as a number in [0, 1).
float random(uvec3 item)
{
    uint state = (item.x + 8192u * item.y) * 747796405u + item.z * 2654435769u + seed * 3266489917u;
    state = state * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return float(((word >> 22u) ^ word) >> 8u) * exp2(-24.0);
}

// 1 lit, 0 in shadow.
float lit_at(Ray ray, float t)
{
#if EXACT
    return exact_lit(t);
#else
    return ray_lit(ray, t);
#endif
}

//[sample
// The place t of x in [0, 1] along the ray, and dt/dx.
vec2 sample_uniform(Ray ray, float x)
{
    return vec2(mix(ray.from, ray.to, x), ray.to - ray.from);
}
//]

#if MAP_KIND == DIRECTIONAL
//[sample_directional
// No point on the ray is nearer to a directional light: samples follow the transmittance instead, x ∝ 1 - e^(-σ t).
vec2 sample_equiangular(Ray ray, float x)
{
    float sigma = max(extinction.x, max(extinction.y, extinction.z)), thickness = sigma * (ray.to - ray.from);
    if (thickness < 1e-3)
        return sample_uniform(ray, x);
    float all = 1.0 - exp(-thickness), rest = 1.0 - x * all;
    return vec2(ray.from - log(rest) / sigma, all / (sigma * rest));
}
//]
#else
//[equiangular
// Kulla and Fajardo (2012): t - foot = D tan φ with φ uniform in x, so that dt/dx = (D² + (t - foot)²)/D · Δφ cancels the inverse square. D is the light's
// distance from the ray. On the ray D = 0, and both tan and Δφ/D lose their meaning; any D > 0 is as right, though, and inside r0 the integrand grows no more:
// so D is never less than r0. φ comes from the end that is farther from the foot: by the tangent of a difference, no angle near π/2 is formed.
vec2 sample_equiangular(Ray ray, float x)
{
    float d = max(ray.nearest, light_radius), before = ray.from - ray.foot, behind = ray.to - ray.foot;
    float whole = atan(d * (ray.to - ray.from), d * d + before * behind), share = d * tan(x * whole), rest = d * tan((1.0 - x) * whole);
    float from_foot = abs(before) > abs(behind) ? d * (before * d + d * share) / (d * d - before * share)
                                                : d * (behind * d - d * rest) / (d * d + behind * rest);
    return vec2(ray.foot + from_foot, (d * d + from_foot * from_foot) / d * whole);
}
//]
#endif

vec2 sample_ray(Ray ray, float x)
{
#if METHOD >= EQUIANGULAR
    return sample_equiangular(ray, x);
#else
    return sample_uniform(ray, x);
#endif
}

//[smooth
// The integrand without visibility, at t: ρ Lin e^(-σt t) for I = 1.
vec3 integrand(Ray ray, float t)
{
#if MAP_KIND == DIRECTIONAL
    return ray_transmittance(t) * phase(phase_half_angle(light_direction, ray.direction));
#else
    float from_foot = t - ray.foot, r = airlight_hypotenuse(ray.nearest, from_foot), sum = r + abs(from_foot);
    float held = max(r, light_radius), larger = 0.5 * sum / r, smaller = 0.5 * (ray.nearest / sum) * (ray.nearest / r);
    vec2 half_angle = from_foot >= 0.0 ? vec2(larger, smaller) : vec2(smaller, larger);
    return ray_transmittance(t + r) * (phase(half_angle) / held / held);
#endif
}
//]

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    Ray ray = ray_of(pixel);
    if (!ray_needed(pixel, ray))
        return;
#if EXACT
    exact_begin(pixel, imageSize(airlight).x);
#endif
    vec3 sum = vec3(0.0);
#if METHOD == FACTORED
    //[factored
    // Dobashi et al. (2002): what is smooth is evaluated once a slice, visibility several times.
    int slices = (steps + SUBSAMPLES - 1) / SUBSAMPLES;
    for (int i = 0; i < slices; i++) {
        float lit = 0.0;
        for (int k = 0; k < SUBSAMPLES; k++)
            lit += lit_at(ray, sample_ray(ray, (float(i) + (float(k) + 0.5) / float(SUBSAMPLES)) / float(slices)).x);
        vec2 middle = sample_ray(ray, (float(i) + 0.5) / float(slices));
        sum += lit / float(SUBSAMPLES) * middle.y * integrand(ray, middle.x);
    }
    sum /= float(slices);
    //]
#else
    //[march
#if EVERYTHING
    int last = 2 * steps; // also as far again behind the first surface, for nothing
#else
    int last = steps;
#endif
    for (int i = 0; i < last; i++) {
#if METHOD == JITTERED
        float x = (float(i) + random(uvec3(pixel, i))) / float(steps);
#else
        float x = (float(i) + 0.5) / float(steps);
#endif
        float counted = float(i < steps);
        vec2 at = sample_ray(ray, min(x, 1.0));
        sum += counted * lit_at(ray, at.x) * at.y * integrand(ray, at.x);
    }
    sum /= float(steps);
    //]
#endif
    ray_store(pixel, ray, sum, EXACT == 0 && (SHADOWED != 0 || EVERYTHING != 0) ? uint(steps) : 0u);
}
