// Depth map: the corners of the listed triangles, each in the layer that the list names: all layers in one draw.
#extension GL_ARB_shader_viewport_layer_array : require
#include "02_shadow_maps/map.glsl"
#if SHAPE == PARABOLOID && !PATCHES
#include "02_shadow_maps/behind.glsl"
#endif

layout(std430, binding = 1) readonly buffer Positions { float positions[]; }; // 3 a vertex, metres
layout(std430, binding = 2) readonly buffer Indices { uint indices[]; };      // 3 a triangle
layout(std430, binding = 3) readonly buffer Casters { uint casters[]; };      // triangle << 3 | layer
uniform vec3 origin;
uniform float near_distance;
#if PATCHES
out vec3 vertex_from_origin;
out int vertex_layer;
#else
out vec3 from_origin;
#endif

void main()
{
    uint entry = casters[gl_VertexID / 3];
    int layer = int(entry & 7u);
    uint at = 3u * indices[3u * (entry >> 3) + uint(gl_VertexID % 3)];
    // Both are near each other wherever the scene lies, so the float difference is exact or nearly so.
    vec3 point = vec3(positions[at], positions[at + 1u], positions[at + 2u]) - origin;
#if PATCHES
    vertex_from_origin = point;
    vertex_layer = layer;
#else
    from_origin = point;
    gl_Layer = layer;
#if SHAPE == CUBE
    vec3 on_face = cube_on_face(layer, point);
    gl_Position = vec4(on_face.xy, on_face.z - 2.0 * near_distance, on_face.z); // no nearer than near_distance, as far as you like
#elif SHAPE == PARABOLOID
    gl_Position = paraboloid_position(layer, point);
#else
    gl_Position = to_clip * vec4(point, 1.0);
#endif
#endif
}
