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
#elif SHAPE == PARABOLOID
flat out vec3 triangle[3];
flat out int layer;
#else
out vec3 from_origin;
#endif

// Both are near each other wherever the scene lies, so the float difference is exact or nearly so.
vec3 corner(uint triangle_number, int k)
{
    uint at = 3u * indices[3u * triangle_number + uint(k)];
    return vec3(positions[at], positions[at + 1u], positions[at + 2u]) - origin;
}

void main()
{
    uint entry = casters[gl_VertexID / 3];
    int to_layer = int(entry & 7u);
    vec3 point = corner(entry >> 3, gl_VertexID % 3);
#if PATCHES
    vertex_from_origin = point;
    vertex_layer = to_layer;
#else
    gl_Layer = to_layer;
#if SHAPE == PARABOLOID
    layer = to_layer;
    for (int k = 0; k < 3; k++)
        triangle[k] = corner(entry >> 3, k);
#else
    from_origin = point;
#endif
#if SHAPE == CUBE
    vec3 on_face = cube_on_face(to_layer, point);
    gl_Position = vec4(on_face.xy, on_face.z - 2.0 * near_distance, on_face.z); // no nearer than near_distance, as far as you like
#elif SHAPE == PARABOLOID
    gl_Position = paraboloid_position(to_layer, point);
#else
    gl_Position = to_clip * vec4(point, 1.0);
#endif
#endif
}
