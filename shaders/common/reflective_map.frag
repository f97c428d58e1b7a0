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
// W that reach the texel's surface. A surface that is tilted gathers no less: it is larger by what it is dimmer.
vec3 arriving_flux(float light_distance)
{
#if MAP_KIND == 2 // directional
    return light_intensity * texel_area;
#else
    if (!shadow_in_cone(from_origin, light_direction, light_cone))
        return vec3(0.0);
    vec2 corner = (floor(gl_FragCoord.xy) - half_resolution) * texel_size;
    float held = min(light_distance / light_radius, 1.0); // radius 0: infinity or NaN, of which min takes 1
    return light_intensity * (solid_angle_of_square(corner, texel_size) * held * held);
#endif
}
//]

void main()
{
#if MAP_KIND == 2 // directional
    out_distance = dot(from_origin, light_direction);
#else
    out_distance = length(from_origin);
#endif
    // Depth by the stored distance itself: the nearest surface is the one that a depth map keeps, however near the near plane is.
    gl_FragDepth = near_distance / out_distance;
    out_position = vec4(from_origin, 1.0);
    out_normal = vec4(normalize(gl_FrontFacing ? surface_normal : -surface_normal), 0.0);
    vec3 albedo = materials[2u * triangle_material[gl_PrimitiveID]].rgb;
    out_flux = vec4(arriving_flux(out_distance) * albedo, 0.0);
}
