// rsm_texel: what one texel of a reflective shadow map sheds on the pixel, for rsm_all.comp and rsm_importance.comp. rsm.h has the sum.
#include "common/camera.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, rgba32f) uniform image2D picture;
layout(binding = 1, r32f) readonly uniform image2D distances;
layout(binding = 2, rgba16f) readonly uniform image2D normals;
layout(binding = 3, rgba16f) readonly uniform image2D albedos;
#if MAP_KIND == 0 // cube
#define MAP image2DArray
#define TEXEL(x, y, face) ivec3(x, y, face)
#else
#define MAP image2D
#define TEXEL(x, y, face) ivec2(x, y)
#endif
layout(binding = 4, rgba32f) readonly uniform MAP map_positions;
layout(binding = 5, rgba16f) readonly uniform MAP map_normals;
layout(binding = 6, rgba32f) readonly uniform MAP map_fluxes;
uniform vec3 eye_from_origin; // eye - DepthMap.origin: no world coordinate is ever formed
uniform float clamp_distance; // metres
uniform bool texel_discs;

const float PI = 3.14159265;

// The surface that the pixel sees, relative to the map's origin; false for the sky.
bool pixel_surface(ivec2 pixel, out vec3 point, out vec3 normal)
{
    ivec2 size = imageSize(picture);
    float seen = imageLoad(distances, pixel).x; // outside the picture 0
    point = eye_from_origin + seen * camera_ray((vec2(pixel) + 0.5) / vec2(size));
    normal = imageLoad(normals, pixel).xyz;
    return all(lessThan(pixel, size)) && !isinf(seen);
}

//[texel
// Irradiance in W/m² at the point from the texel at (x, y), of a cube on `face`.
vec3 texel_irradiance(int x, int y, int face, vec3 point, vec3 normal)
{
    vec3 flux = imageLoad(map_fluxes, TEXEL(x, y, face)).rgb;
    if (flux == vec3(0.0))
        return flux;
    vec4 position = imageLoad(map_positions, TEXEL(x, y, face)); // w: area
    vec3 way = position.xyz - point;
    float distance = length(way);
    if (distance == 0.0) // the texel's own point lies in the plane of its light
        return vec3(0.0);
    vec3 to_texel = way / distance;
    float leaves = max(-dot(imageLoad(map_normals, TEXEL(x, y, face)).xyz, to_texel), 0.0);
    float arrives = max(dot(normal, to_texel), 0.0);
    float held = texel_discs ? length(vec2(distance, sqrt(position.w / PI))) : max(distance, clamp_distance);
    // One after the other: the square of a micrometre or of 10⁶ m times a flux would leave the range of floats sooner.
    return flux / PI * (leaves / held) * (arrives / held);
}
//]

// What a Lambertian pixel shows of that irradiance.
void add_to_picture(ivec2 pixel, vec3 irradiance)
{
    vec4 before = imageLoad(picture, pixel);
    imageStore(picture, pixel, before + vec4(imageLoad(albedos, pixel).rgb / PI * irradiance, 0.0));
}
