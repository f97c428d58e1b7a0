// Light from some texels of a reflective shadow map: more of them near the pixel's own place in the map (Dachsbacher and Stamminger 2005,
// section 4), or as many everywhere. Taught in chapter 02.
#include "02_shadow_maps/rsm_texel.glsl"
#if MAP_KIND == 0 // cube
#include "common/cube.glsl"
#else
uniform mat4 to_clip;
#endif

#define AS_PRINTED 1 // RsmSampling of rsm.h
#define EVENLY 2
uniform uint first_sample, last_sample, sample_count;
uniform uint seed;
uniform float radius;   // spot, directional: sides of the map; cube: radians
uniform bool rotated;   // a pattern for each pixel
uniform int sampling;

//[pattern
// The first samples of Roberts' R2 sequence ("The unreasonable effectiveness of quasirandom sequences", 2018) in fixed point, where adding modulo 1 is
// exact: steps of 1/g and 1/g², g³ = g + 1. A shift drawn at random makes each sample uniform, and leaves how they share out the square.
const uvec2 R2_STEP = uvec2(3242174889u, 2447445414u);

// Jarzynski and Olano, "Hash functions for GPU rendering" (2020): pcg3d.
uvec3 random_bits(uvec3 v)
{
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.z, v.y += v.z * v.x, v.z += v.x * v.y;
    v ^= v >> 16;
    v.x += v.y * v.z, v.y += v.z * v.x, v.z += v.x * v.y;
    return v;
}

// In [0, 1)²: a float holds 24 bits.
vec2 pattern(uint i, uvec2 shift)
{
    return vec2((i * R2_STEP + shift) >> 8) * exp2(-24.0);
}
//]

#if MAP_KIND == 0 // cube
//[cube
// The texel in the direction at an angle of radius·ξ1 from the pixel's own, and for how many texels it stands: directions come with density
// 1/(2π·radius·sin θ), and a texel takes side²/(1 + u² + v²)^1.5 of them.
float sampled_texel(vec2 xi, vec3 point, out ivec3 texel)
{
    int side = imageSize(map_fluxes).x;
    if (sampling == EVENLY) {
        float six = 6.0 * xi.x;
        texel = ivec3(clamp(ivec2(vec2(fract(six), xi.y) * float(side)), 0, side - 1), int(six));
        return 6.0 * float(side) * float(side);
    }
    vec3 axis = normalize(point);
    vec3 across = normalize(abs(axis.y) < 0.9 ? vec3(axis.z, 0.0, -axis.x) : vec3(0.0, -axis.z, axis.y));
    float theta = radius * xi.x, phi = 2.0 * PI * xi.y;
    vec3 direction =
        cos(theta) * axis + sin(theta) * (cos(phi) * across + sin(phi) * cross(axis, across));
    int face = cube_face(direction);
    vec3 on_face = cube_on_face(face, direction);
    vec2 place = on_face.xy / on_face.z;
    texel = ivec3(clamp(ivec2((0.5 * place + 0.5) * float(side)), 0, side - 1), face);
    float half_side = 0.5 * float(side), slant = 1.0 + dot(place, place);
    return 2.0 * PI * radius * sin(theta) * slant * sqrt(slant) * half_side * half_side;
}
//]
#else
//[plane
// The texel at radius·ξ1 from the pixel's own, and for how many texels it stands: their density is 1/(2π·radius²·ξ1) a square side of the map.
// 0 beside the map, where there is no light.
float sampled_texel(vec2 xi, vec3 point, out ivec3 texel)
{
    float side = float(imageSize(map_fluxes).x);
    if (sampling == EVENLY) {
        texel = ivec3(xi * side, 0);
        return side * side;
    }
    vec4 clip = to_clip * vec4(point, 1.0);
    // a pixel beside the map or behind the light is nearest to a texel of the border
    vec2 place = clip.w > 0.0 ? clip.xy / clip.w : 1e6 * clip.xy;
    vec2 centre = 0.5 * clamp(place, -1.0, 1.0) + 0.5;
    float phi = 2.0 * PI * xi.y;
    vec2 at = centre + radius * xi.x * vec2(sin(phi), cos(phi));
    texel = ivec3(floor(at * side), 0);
    if (any(lessThan(at, vec2(0.0))) || any(greaterThanEqual(texel.xy, imageSize(map_fluxes))))
        return 0.0;
    // The mean of 3 ξ1² is 1, that of 2 ξ1 too; but only 2 ξ1 undoes the density.
    float weight = sampling == AS_PRINTED ? 3.0 * xi.x * xi.x : 2.0 * xi.x;
    return PI * radius * radius * side * side * weight;
}
//]
#endif

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    vec3 point, normal;
    if (!pixel_surface(pixel, point, normal))
        return;
    uvec2 shift = random_bits(uvec3(rotated ? uvec2(pixel) : uvec2(0u), seed)).xy;
    vec3 irradiance = vec3(0.0);
    for (uint i = first_sample; i < last_sample; i++) {
        ivec3 texel;
        float texels = sampled_texel(pattern(i, shift), point, texel);
        if (texels > 0.0)
            irradiance += texels * texel_irradiance(texel.x, texel.y, texel.z, point, normal);
    }
    add_to_picture(pixel, irradiance / float(sample_count));
}
