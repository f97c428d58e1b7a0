// Direct light of one light on a Lambertian surface, added to the picture: albedo/π · irradiance · visibility.
#include "common/camera.glsl"
#include "common/shadow.glsl"

#define CUBE 0
#define SPOT 1
#define DIRECTIONAL 2
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, rgba32f) uniform image2D picture;
layout(binding = 1, r32f) readonly uniform image2D distances;
layout(binding = 2, rgba16f) readonly uniform image2D normals;
layout(binding = 3, rgba16f) readonly uniform image2D albedos;
#if MAP_KIND == CUBE
layout(binding = 4, r32f) readonly uniform image2DArray depth_map;
#else
layout(binding = 4, r32f) readonly uniform image2D depth_map;
uniform mat4 to_clip;
#endif
uniform float texel_size;       // DepthMap.texel_size
uniform vec3 eye_from_origin;   // eye - DepthMap.origin: no world coordinate is ever formed
uniform vec3 light_direction;   // unit; spot, directional
uniform vec3 light_intensity;   // W/sr; directional: W/m²
uniform float light_radius;     // metres; the inverse square is held inside
uniform vec2 light_cone;        // sin, cos of the half angle; (0, -1): all directions

const float PI = 3.14159265;
const float LEAST_DISTANCE = 1e-18; // metres; its square is still a normal float

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 size = imageSize(picture);
    if (any(greaterThanEqual(pixel, size)))
        return;
    float seen = imageLoad(distances, pixel).x;
    if (isinf(seen))
        return;
    vec3 point = eye_from_origin + seen * camera_ray((vec2(pixel) + 0.5) / vec2(size));
    vec3 normal = imageLoad(normals, pixel).xyz;

#if MAP_KIND == DIRECTIONAL
    float cosine = -dot(normal, light_direction);
    vec3 irradiance = light_intensity * cosine;
    float lit = shadow_directional(depth_map, to_clip, light_direction, point, shadow_bias(texel_size, cosine));
#else
    float light_distance = max(length(point), LEAST_DISTANCE);
    float cosine = -dot(normal, point) / light_distance;
    float held = max(light_distance, light_radius);
    vec3 irradiance = light_intensity * (cosine / (held * held));
    if (!shadow_in_cone(point, light_direction, light_cone))
        return;
#if MAP_KIND == CUBE
    float along_axis = max(abs(point.x), max(abs(point.y), abs(point.z)));
    float lit = shadow_point(depth_map, point, shadow_bias(texel_size * along_axis, cosine));
#else
    float along_axis = dot(light_direction, point);
    float lit = shadow_spot(depth_map, to_clip, point, shadow_bias(texel_size * along_axis, cosine));
#endif
#endif
    if (cosine <= 0.0 || lit == 0.0)
        return;
    vec4 before = imageLoad(picture, pixel);
    imageStore(picture, pixel, before + vec4(imageLoad(albedos, pixel).rgb / PI * irradiance, 0.0));
}
