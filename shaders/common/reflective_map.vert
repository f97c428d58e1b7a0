// Reflective shadow map, first stage: as depth_map.vert and depth_cube.vert, so that both kinds of map see the same, and the normal.
#if MAP_KIND == 0 // cube: instance i of the mesh goes to face i
#extension GL_ARB_shader_viewport_layer_array : require
#endif
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
uniform vec3 origin;
out vec3 from_origin;
out vec3 surface_normal;

#if MAP_KIND == 0
#include "common/cube.glsl"
uniform float near_distance;

vec4 clip_position()
{
    vec3 on_face = cube_on_face(gl_InstanceID, from_origin);
    gl_Layer = gl_InstanceID;
    return vec4(on_face.xy, on_face.z - 2.0 * near_distance, on_face.z);
}
#else
uniform mat4 to_clip;

vec4 clip_position()
{
    return to_clip * vec4(from_origin, 1.0);
}
#endif

void main()
{
    from_origin = position - origin;
    surface_normal = normal;
    gl_Position = clip_position();
}
