// Surfaces lit by one light, in shadow where the voxel is in which they lie (Wyman 2011, figure 7): to show what the volume holds; a depth map knows it better.
#include "common/airlight_ray.glsl"
#include "06_epipolar_vsv/query.glsl"
layout(binding = 5, rgba16f) readonly uniform image2D normals;
layout(binding = 6, rgba16f) readonly uniform image2D albedos;

const float NEARER = 1.5; // voxels along α towards the light: a surface's own voxels are set, too, up to a voxel to either side

//[surface
void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(airlight);
    float seen = imageLoad(distances, pixel).x;
    if (any(greaterThanEqual(pixel, size)) || isinf(seen))
        return;
    vec3 from_eye = seen * camera_ray((vec2(pixel) + 0.5) / vec2(size)), place = epipolar_place(to_epipolar(from_eye));
    int phi = int(clamp(place.z, 0.0, float(epipolar_count.z) - 0.5));
    ivec2 at = clamp(ivec2(floor(place.xy - vec2(NEARER, 0.0))), ivec2(0), epipolar_count.xy - 1);
    uint word = query_texel(Row(at, false, false), phi >> 7)[(phi >> 5) & 3];
    bool shadow = at.x >= int(slices[at.y].any) && ((word >> (phi & 31)) & 1u) != 0u;
    vec3 normal = imageLoad(normals, pixel).xyz;
#if MAP_KIND == DIRECTIONAL
    vec3 irradiance = -dot(normal, light_direction) * light_intensity;
#else
    vec3 point = eye_from_origin + from_eye;
    float away = max(length(point), light_radius);
    vec3 irradiance = -dot(normal, point) / (away * away * away) * light_intensity;
    shadow = shadow || !shadow_in_cone(point, light_direction, light_cone);
#endif
    vec3 radiance = shadow ? vec3(0.0) : imageLoad(albedos, pixel).rgb / EPIPOLAR_PI * max(irradiance, vec3(0.0));
    imageStore(airlight, pixel, imageLoad(airlight, pixel) + vec4(radiance, 0.0));
}
//]
