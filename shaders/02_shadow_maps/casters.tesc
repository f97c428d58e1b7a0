// Depth map on a paraboloid: how finely to cut a triangle. It is cut as a four-sided patch whose first side has shrunk to the corner across
// from the shortest edge, so that a long thin triangle is cut along its length alone.
#include "02_shadow_maps/tessellation.glsl"

layout(vertices = 3) out;
in vec3 vertex_from_origin[];
in int vertex_layer[];
out vec3 patch_from_origin[]; // the tip, then the two ends of the edge across
patch out int patch_layer;
uniform int map_size;

void main()
{
    vec3 p[3] = vec3[3](vertex_from_origin[0], vertex_from_origin[1], vertex_from_origin[2]);
    vec3 square; // of the edge across from each corner
    for (int k = 0; k < 3; k++) {
        vec3 edge = p[(k + 2) % 3] - p[(k + 1) % 3];
        square[k] = dot(edge, edge);
    }
    int tip = square.x <= min(square.y, square.z) ? 0 : square.y <= square.z ? 1 : 2;
    vec3 a = p[tip], b = p[(tip + 1) % 3], c = p[(tip + 2) % 3];
    patch_from_origin[gl_InvocationID] = p[(tip + gl_InvocationID) % 3];
    if (gl_InvocationID == 0) {
        patch_layer = vertex_layer[0];
        // An edge's number depends on that edge alone, so that neighbours fit without a crack.
        float ab = edge_pieces(a, b, map_size), ac = edge_pieces(a, c, map_size), bc = edge_pieces(b, c, map_size);
        gl_TessLevelOuter[0] = 1.0; // u = 0: the tip
        gl_TessLevelOuter[1] = ab;  // v = 0
        gl_TessLevelOuter[2] = bc;  // u = 1
        gl_TessLevelOuter[3] = ac;  // v = 1
        gl_TessLevelInner[0] = max(ab, ac);
        gl_TessLevelInner[1] = bc;
    }
}
