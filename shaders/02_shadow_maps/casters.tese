// Depth map on a paraboloid: a corner of a piece, in its place. The place is not linear in space, so w is 1 and pieces are straight.
#extension GL_ARB_shader_viewport_layer_array : require
#include "02_shadow_maps/behind.glsl"

layout(quads, equal_spacing, ccw) in;
in vec3 patch_from_origin[];
patch in int patch_layer;
flat out vec3 triangle[3];
flat out int layer;

void main()
{
    // Symmetric in the two ends of an edge, so that both of its triangles round alike.
    float u = gl_TessCoord.x, v = gl_TessCoord.y;
    vec3 across = (1.0 - v) * patch_from_origin[1] + v * patch_from_origin[2];
    vec3 from_origin = (1.0 - u) * patch_from_origin[0] + u * across;
    triangle = vec3[3](patch_from_origin[0], patch_from_origin[1], patch_from_origin[2]);
    layer = patch_layer;
    gl_Layer = patch_layer;
    gl_Position = paraboloid_position(patch_layer, from_origin);
}
