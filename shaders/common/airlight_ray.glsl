// ray: what the methods that integrate along each ray share: a pixel's ray against one light, where on it light can be, and its picture. Taught in chapter 04.
#ifndef RAY_GLSL
#define RAY_GLSL
#include "common/camera.glsl"
#include "common/airlight.glsl"
#include "common/shadow.glsl"

#define CUBE 0
#define SPOT 1
#define DIRECTIONAL 2
// Where the picture goes: a fragment shader's is added by blending, three times as fast on this renderer as what a compute shader loads and stores.
#if RAY_FRAGMENT
layout(location = 0) out vec4 airlight; // W/(sr·m²)
#define RAY_PIXEL ivec2(gl_FragCoord.xy)
#else
layout(local_size_x = 8, local_size_y = 8) in;
#define RAY_PIXEL ivec2(gl_GlobalInvocationID.xy)
layout(binding = 0, rgba32f) uniform image2D airlight; // W/(sr·m²), added to
#endif
layout(binding = 1, r32f) readonly uniform image2D distances;
#if MAP_KIND == CUBE
layout(binding = 2, r32f) readonly uniform image2DArray depth_map;
#else
layout(binding = 2, r32f) readonly uniform image2D depth_map;
#endif
layout(binding = 0, std430) buffer Counters { uint missed_rays, lookups; };
uniform mat4 to_clip;
uniform vec3 eye_from_origin; // eye - DepthMap.origin: the light (point, spot)
uniform vec3 light_direction; // unit; spot, directional
uniform vec3 light_intensity; // W/sr; directional: W/m²
uniform float light_radius;   // metres; the inverse square is held inside
uniform vec2 light_cone;      // sin, cos of the half angle; (0, -1): all directions
uniform vec3 scattering, extinction; // 1/m

#ifndef RAY_CONE // 0: no light has a cone; this renderer computes both sides of an if
#define RAY_CONE 1
#endif

struct Ray {
    vec3 direction;
    float nearest, foot; // the light's distance from the ray's line, and where on it (not for a directional light)
    float from, to;      // where light can be: inside the cone, before the first surface and before all is absorbed
    float inside;        // 0: nowhere
};

//[cone
// The cone's border is where (|axis × p| cos)² = (axis·p sin)²: a quadratic in t whose inside, where it is at most 0, is the cone or its mirror image behind the
// light. The cone is convex, so what is left of the ray is one stretch. For a ray that grazes the border b² - ac cancels; it is the same quadratic form, of the other
// eigenvalues, of the ray's moment m = p × direction, whose factors can be told before they are multiplied.
void ray_clip_cone(inout Ray ray)
{
    vec3 across = cross(light_direction, ray.direction) * light_cone.y, beside = cross(light_direction, eye_from_origin) * light_cone.y;
    float along = dot(light_direction, ray.direction) * light_cone.x, ahead = dot(light_direction, eye_from_origin) * light_cone.x;
    float a = dot(across, across) - along * along, b = dot(across, beside) - along * ahead, c = dot(beside, beside) - ahead * ahead;
    vec3 moment = cross(eye_from_origin, ray.direction);
    float round_axis = length(cross(light_direction, moment)) * light_cone.x, on_axis = abs(dot(light_direction, moment)) * light_cone.y;
    float discriminant = light_cone.y * light_cone.y * (round_axis - on_axis) * (round_axis + on_axis); // b² - ac
    float apex = -ahead / along; // where the ray passes beside the light
    float q = -(b + (b >= 0.0 ? 1.0 : -1.0) * sqrt(max(discriminant, 0.0)));
    float first = min(q / a, c / q), last = max(q / a, c / q);
    if (a > 0.0) { // the ray enters and leaves; discriminant < 0: it misses
        bool missed = discriminant <= 0.0 || ahead + along * 0.5 * (first + last) <= 0.0;
        ray.from = max(ray.from, first);
        ray.to = missed ? -1.0 : min(ray.to, last);
    } else if (along > 0.0) { // it stays inside from the border on, which lies beyond the apex
        ray.from = max(ray.from, last >= apex ? last : apex);
    } else {
        ray.to = min(ray.to, first <= apex ? first : apex);
    }
}
//]

// The ray in this direction up to the surface at `end`, as far as light can be on it.
Ray ray_to_surface(vec3 direction, float end)
{
    Ray ray;
    ray.direction = direction;
    ray.from = 0.0;
    ray.to = end;
    ray.nearest = ray.foot = 0.0;
#if MAP_KIND != DIRECTIONAL
    airlight_from_vectors(-eye_from_origin, ray.direction, ray.nearest, ray.foot);
    ray.nearest = max(ray.nearest, AIRLIGHT_LEAST);
#if RAY_CONE
    if (light_cone.y > 0.0)
        ray_clip_cone(ray);
#endif
#endif
    ray.inside = float(ray.from < ray.to);
    if (ray.inside == 0.0) // with --everything it is computed all the same, for nothing
        ray.from = ray.to = 0.0;
    return ray;
}

// And before all light is absorbed.
Ray ray_along(vec3 direction, float end)
{
    Ray ray = ray_to_surface(direction, end);
    float least = AIRLIGHT_FAR; // the least extinction of a channel that scatters at all
    for (int k = 0; k < 3; k++)
        least = scattering[k] > 0.0 ? min(least, extinction[k]) : least;
#if MAP_KIND == DIRECTIONAL
    float last = AIRLIGHT_CUT / least;
#else
    // The way eye-point-light grows along the ray: beyond `cut` of s = r + (t - foot) less than e^-14 of the airlight is left.
    float start = ray.from - ray.foot, sum = airlight_hypotenuse(ray.nearest, start) + abs(start);
    float cut = (start >= 0.0 ? sum : ray.nearest * (ray.nearest / sum)) + AIRLIGHT_CUT / least;
    float last = ray.foot + 0.5 * (cut - ray.nearest * (ray.nearest / cut));
#endif
    ray.to = min(ray.to, last);
    ray.inside = float(ray.from < ray.to);
    if (ray.inside == 0.0) {
        ray.from = 0.0;
        ray.to = max(last, 0.0);
    }
    return ray;
}

vec3 ray_direction(ivec2 pixel)
{
    return camera_ray((vec2(pixel) + 0.5) / vec2(imageSize(distances)));
}

Ray ray_of(ivec2 pixel)
{
    return ray_along(ray_direction(pixel), imageLoad(distances, pixel).x);
}

// Whether to go on: the pixel is in the picture, and (nothing needless) light can be on its ray.
bool ray_needed(ivec2 pixel, Ray ray)
{
    bool in_picture = all(lessThan(pixel, imageSize(distances)));
#if !EVERYTHING
#if COUNT
    if (in_picture && ray.inside == 0.0)
        atomicAdd(missed_rays, 1u);
#endif
    return in_picture && ray.inside > 0.0;
#else
    return in_picture;
#endif
}

// e^(-σt path) a channel; a grey medium needs it once.
vec3 ray_transmittance(float path)
{
#if GREY && !EVERYTHING
    return vec3(exp(-extinction.x * path));
#else
    return exp(-extinction * path);
#endif
}

// 1 lit, 0 in shadow, at t along the ray.
float ray_lit(Ray ray, float t)
{
#if SHADOWED || EVERYTHING
    vec3 point = eye_from_origin + t * ray.direction;
#if MAP_KIND == DIRECTIONAL
    return shadow_directional(depth_map, to_clip, light_direction, point, 0.0);
#elif MAP_KIND == SPOT
    return shadow_spot(depth_map, to_clip, point, 0.0);
#else
    return shadow_point(depth_map, point, 0.0);
#endif
#else
    return 1.0;
#endif
}

// `integral` a channel is for σs = I = 1.
void ray_store(ivec2 pixel, Ray ray, vec3 integral, uint fetches)
{
    vec4 radiance = vec4(scattering * light_intensity * integral * ray.inside, 0.0);
#if RAY_FRAGMENT
    airlight = radiance;
#else
    imageStore(airlight, pixel, imageLoad(airlight, pixel) + radiance);
#endif
#if COUNT
    atomicAdd(lookups, fetches);
#endif
}

#endif
