// Depth map on a paraboloid: a corner of a piece, in its place. The place is not linear in space, so w is 1 and pieces are straight.
#extension GL_ARB_shader_viewport_layer_array : require
#include "common/paraboloid.glsl"

layout(triangles, equal_spacing, ccw) in;
in vec3 patch_from_origin[];
patch in int patch_layer;
out vec3 from_origin;

void main()
{
    // Symmetric in the two ends of an edge, so that both of its triangles round alike.
    from_origin = gl_TessCoord.x * patch_from_origin[0] + gl_TessCoord.y * patch_from_origin[1] + gl_TessCoord.z * patch_from_origin[2];
    gl_Layer = patch_layer;
    gl_Position = vec4(paraboloid_place(patch_layer, from_origin), 0.0, 1.0);
}
