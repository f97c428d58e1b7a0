// Reflective shadow map, last stage: the lit surface of a texel as a light of its own (raster.h says what is stored). Taught in chapter 02.
#include "common/reflective_solid_angle.glsl"
#include "common/shadow.glsl"

in vec3 from_origin;
in vec3 surface_normal;
layout(binding = 0, std430) readonly buffer TriangleMaterials { uint triangle_material[]; };
layout(binding = 1, std430) readonly buffer Materials { vec4 materials[]; }; // albedo, emission, albedo, ...
layout(location = 0) out float out_distance;
layout(location = 1) out vec4 out_position;
layout(location = 2) out vec4 out_normal;
layout(location = 3) out vec4 out_flux;
uniform float near_distance;
const float LEAST_COSINE = 1e-3; // a surface seen along its plane has an area all the same
uniform vec3 light_direction; // unit; spot, directional
uniform vec3 light_intensity; // W/sr; directional: W/m²
#if MAP_KIND == 2             // directional
uniform float texel_area;     // m²
#else
uniform float light_radius; // metres; the inverse square is held inside
uniform vec2 light_cone;    // sin, cos of the half angle; (0, -1): all directions
uniform float texel_size;   // of a texel 1 m along the axis, in metres
uniform float half_resolution;
#endif

//[flux
// What of the light's own cross-section the texel holds at the surface, in m².
float area_across(float light_distance)
{
#if MAP_KIND == 2 // directional
    return texel_area;
#else
    vec2 corner = (floor(gl_FragCoord.xy) - half_resolution) * texel_size;
    return solid_angle_of_square(corner, texel_size) * light_distance * light_distance;
#endif
}

// W/m² across the light.
vec3 arriving(float light_distance)
{
#if MAP_KIND == 2 // directional
    return light_intensity;
#else
    if (!shadow_in_cone(from_origin, light_direction, light_cone))
        return vec3(0.0);
    float held = max(light_distance, light_radius);
    return light_intensity / held / held;
#endif
}
//]

void main()
{
#if MAP_KIND == 2 // directional
    out_distance = dot(from_origin, light_direction);
    vec3 way = light_direction;
#else
    out_distance = length(from_origin);
    vec3 way = from_origin / out_distance;
#endif
    // Depth by the stored distance itself: the nearest surface is the one that a depth map keeps, however near the near plane is.
    gl_FragDepth = near_distance / out_distance;
    vec3 normal = normalize(gl_FrontFacing ? surface_normal : -surface_normal);
    vec3 albedo = materials[2u * triangle_material[gl_PrimitiveID]].rgb;
    float across = area_across(out_distance);
    // A tilted surface gathers no less than one that faces the light: it is larger by what it is dimmer.
    out_position = vec4(from_origin, across / max(-dot(normal, way), LEAST_COSINE));
    out_normal = vec4(normal, 0.0);
    out_flux = vec4(across * arriving(out_distance) * albedo, 0.0);
}
