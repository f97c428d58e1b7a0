// map: the first surface along a light ray, from the light's depth map (Wyman 2011, section 4.1.3).
#ifndef MAP_GLSL
#define MAP_GLSL
#include "common/shadow.glsl"
#include "common/paraboloid.glsl"

#define CUBE 0
#define SPOT 1
#define DIRECTIONAL 2
#if MAP_KIND == CUBE
layout(binding = 2, r32f) readonly uniform image2DArray depth_map;
#else
layout(binding = 2, r32f) readonly uniform image2D depth_map;
#endif
uniform mat4 to_clip;
uniform vec3 eye_from_origin; // eye - DepthMap.origin
uniform vec3 light_direction;

//[first_hit
// Metres from the light; for a directional light from the plane at right angles to its axis through the eye, towards the light. Infinite: nothing is hit,
// or the map does not know.
float map_first_hit(float theta, float phi)
{
#if MAP_KIND == DIRECTIONAL
    vec3 beside = eye_from_origin + phi * epipolar_beside(theta);
    vec2 place = (to_clip * vec4(beside, 1.0)).xy;
    float stored = imageLoad(depth_map, shadow_texel(place, imageSize(depth_map))).x;
    return any(greaterThan(abs(place), vec2(1.0))) || isinf(stored) ? -1.0 / 0.0 : dot(eye_from_origin, light_direction) - stored;
#else
    vec3 direction = sin(phi) * epipolar_beside(theta) - cos(phi) * epipolar_axis;
#if MAP_KIND == SPOT
    vec4 clip = to_clip * vec4(direction, 1.0);
    vec2 place = clip.xy / max(clip.w, 1e-30);
    float stored = imageLoad(depth_map, shadow_texel(place, imageSize(depth_map))).x;
    return clip.w <= 0.0 || any(greaterThan(abs(place), vec2(1.0))) ? 1.0 / 0.0 : stored;
#elif PARABOLOID
    int side = paraboloid_half(direction);
    return imageLoad(depth_map, ivec3(shadow_texel(paraboloid_place(side, direction), imageSize(depth_map).xy), side)).x;
#else
    int face = cube_face(direction);
    vec3 on_face = cube_on_face(face, direction);
    return imageLoad(depth_map, ivec3(shadow_texel(on_face.xy / on_face.z, imageSize(depth_map).xy), face)).x;
#endif
#endif
}
//]

#endif
