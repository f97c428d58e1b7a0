// Lit intervals of a ray, found by walking through the depth map, each integrated on its own: what the map says, without sampling error.
// VARIANT 1: as Billeter et al. (2010, eq. 3) sum them, signed integrals from the eye to each border in any order.
#include "common/airlight_ray.glsl"
#if EXACT
#include "common/airlight_exact.glsl"
#endif

#define INTERVALS 0
#define SIGNED 1

// One face of the map as the ray crosses it: place in [-1, 1]² is xy / z of `at + t · along`.
struct Walk {
    vec3 at, along;
    int face;
    ivec2 texel, step;
    float t, last; // how far; where the face ends
};

#if MAP_KIND == CUBE
const int FACES = 6;
#else
const int FACES = 1;
#endif

vec3 on_map(int face, vec3 vector, float w)
{
#if MAP_KIND == CUBE
    return cube_on_face(face, vector);
#else
    vec4 clip = to_clip * vec4(vector, w);
    return clip.xyw;
#endif
}

ivec2 map_size()
{
    return imageSize(depth_map).xy;
}

float map_load(Walk walk)
{
#if MAP_KIND == CUBE
    return imageLoad(depth_map, ivec3(walk.texel, walk.face)).x;
#else
    return imageLoad(depth_map, walk.texel).x;
#endif
}

// Clip [t, last] to where a + t·b >= 0. A ray that lies in the plane between two faces is 0 for both: `ours` says which has it.
void walk_clip(inout Walk walk, float a, float b, bool ours)
{
    float t = -a / b;
    walk.t = b > 0.0 ? max(walk.t, t) : walk.t;
    walk.last = b < 0.0 ? min(walk.last, t) : b == 0.0 && (a < 0.0 || (a == 0.0 && !ours)) ? -1.0 : walk.last;
}

//[start
Walk walk_start(Ray ray, int face)
{
    Walk walk;
    walk.face = face;
    walk.at = on_map(face, eye_from_origin, 1.0);
    walk.along = on_map(face, ray.direction, 0.0);
    walk.t = ray.from;
    walk.last = ray.to;
    // the face's four sides; of two faces the one whose axis comes first, as in cube_face
    bool ours_x = FACES == 1 || face < 2, ours_y = FACES == 1 || face < 4;
    walk_clip(walk, walk.at.z - walk.at.x, walk.along.z - walk.along.x, ours_x);
    walk_clip(walk, walk.at.z + walk.at.x, walk.along.z + walk.along.x, ours_x);
    walk_clip(walk, walk.at.z - walk.at.y, walk.along.z - walk.along.y, ours_y);
    walk_clip(walk, walk.at.z + walk.at.y, walk.along.z + walk.along.y, ours_y);
    // x/z turns one way along a line
    vec2 turning = walk.along.xy * walk.at.z - walk.at.xy * walk.along.z;
    walk.step = ivec2(greaterThan(turning, vec2(0.0))) * 2 - 1;
    vec3 place = walk.at + walk.t * walk.along;
    walk.texel = shadow_texel(place.xy / max(place.z, AIRLIGHT_LEAST), map_size());
    return walk;
}
//]

//[walk
// Cross one texel; returns the part of the ray inside it that is lit (empty: x >= y). A border between texels is a plane through the light: x = e z, met
// at t = -(x0 - e z0) / (x1 - e z1) straight from the border's own number, so no rounding adds up on the way.
vec2 walk_texel(inout Walk walk, Ray ray)
{
    vec2 edge = 2.0 * vec2(walk.texel + (walk.step + 1) / 2) / vec2(map_size()) - 1.0;
    vec2 meets = -(walk.at.xy - edge * walk.at.z) / (walk.along.xy - edge * walk.along.z);
    // Met behind the light (z < 0) or nowhere: never. Met a rounding ago: now.
    for (int k = 0; k < 2; k++)
        meets[k] = walk.at.z + meets[k] * walk.along.z > 0.0 && abs(meets[k]) < AIRLIGHT_FAR ? max(meets[k], walk.t) : AIRLIGHT_FAR;
    float leave = min(min(meets.x, meets.y), walk.last), stored = map_load(walk);
#if MAP_KIND == DIRECTIONAL
    float depth = dot(eye_from_origin, light_direction), slope = dot(ray.direction, light_direction);
    float border = (stored - depth) / slope; // lit where depth + t slope <= stored
    vec2 lit = slope > 0.0 ? vec2(walk.t, min(leave, border)) : slope < 0.0 ? vec2(max(walk.t, border), leave)
                                                              : vec2(walk.t, depth <= stored ? leave : walk.t);
#else
    float half_chord = stored > ray.nearest ? sqrt(stored - ray.nearest) * sqrt(stored + ray.nearest) : -1.0; // lit where r <= stored
    vec2 lit = vec2(max(walk.t, ray.foot - half_chord), min(leave, half_chord < 0.0 ? walk.t : ray.foot + half_chord));
#endif
    walk.texel += walk.step * ivec2(meets.x <= meets.y, meets.y <= meets.x); // both: through the corner
    walk.t = leave;
    return lit;
}
//]

vec3 integral(Ray ray, float from, float to)
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

//[sum
vec3 lit_interval(Ray ray, vec2 lit)
{
#if VARIANT == SIGNED
    return integral(ray, 0.0, lit.y) - integral(ray, 0.0, lit.x);
#else
    return integral(ray, lit.x, lit.y);
#endif
}
//]

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    Ray ray = ray_of(pixel);
    if (!ray_needed(pixel, ray))
        return;
    vec3 sum = vec3(0.0);
    uint fetches = 0u;
#if EXACT
    exact_begin(pixel, imageSize(airlight).x);
    for (; exact_at < exact_end; exact_at++) {
        vec2 lit = clamp(exact_spans[exact_at], ray.from, ray.to);
        sum += lit.x < lit.y ? lit_interval(ray, lit) : vec3(0.0);
    }
#elif SHADOWED || EVERYTHING
    //[segments
    for (int face = 0; face < FACES; face++) {
        Walk walk = walk_start(ray, face);
        bool more = walk.t < walk.last, done = !more;
        bool tail = false;
        vec2 open = vec2(walk.t); // the lit interval that has not ended yet
#if MAP_KIND == DIRECTIONAL
        // beside the map all is lit: before it, and as a tail behind it
        open = vec2(ray.from, more ? walk.t : ray.from);
        walk.t = more ? walk.t : ray.from;
        tail = true;
        done = false;
#endif
        // Walk until an interval has ended; only then integrate: in one loop, this renderer would do both for every texel.
        while (!done) {
            vec2 closed = vec2(0.0);
            bool ended = false;
            while ((more || tail) && !ended) {
                vec2 lit = vec2(walk.t, ray.to);
                tail = tail && more;
                if (more) {
                    lit = walk_texel(walk, ray);
                    fetches++;
                    more = walk.t < walk.last && all(equal(walk.texel, clamp(walk.texel, ivec2(0), map_size() - 1)));
                }
                if (lit.x < lit.y) {
                    ended = open.x < open.y && lit.x > open.y;
                    closed = open;
                    open = vec2(open.x < open.y && !ended ? open.x : lit.x, lit.y);
                }
            }
            done = !ended; // the map's end: what is open is the last one
            sum += lit_interval(ray, ended ? closed : open);
        }
    }
    //]
#else
    sum = lit_interval(ray, vec2(ray.from, ray.to));
#endif
    ray_store(pixel, ray, sum, fetches);
}
