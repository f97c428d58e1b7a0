// Depth map of a point light: instance i of the mesh goes to face i. Position relative to the light, as in depth_map.vert.
#extension GL_ARB_shader_viewport_layer_array : require
#include "common/cube.glsl"

layout(location = 0) in vec3 position;
uniform vec3 origin;
uniform float near_distance;
out vec3 from_origin;

void main()
{
    from_origin = position - origin;
    vec3 on_face = cube_on_face(gl_InstanceID, from_origin);
    gl_Layer = gl_InstanceID;
    // -w <= z <= w: no nearer than near_distance, as far as you like
    gl_Position = vec4(on_face.xy, on_face.z - 2.0 * near_distance, on_face.z);
}
