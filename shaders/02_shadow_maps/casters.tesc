// Depth map on a paraboloid: a triangle's straight edges are arcs of circles there. Into how many pieces must an edge be cut, so that
// none of them leaves its arc by more than `tessellation` texels?
layout(vertices = 3) out;
in vec3 vertex_from_origin[];
in int vertex_layer[];
out vec3 patch_from_origin[];
patch out int patch_layer;
uniform float tessellation; // texels; 0: edges stay whole
uniform int map_size;

const float MOST_PIECES = 64.0; // GL_MAX_TESS_GEN_LEVEL of every OpenGL 4.5

//[pieces
float pieces(vec3 a, vec3 b)
{
    // The nearest point of the edge to the light is where a piece looks longest: about (length of a piece) / (distance) radians.
    vec3 edge = b - a;
    float along = clamp(-dot(a, edge) / max(dot(edge, edge), 1e-30), 0.0, 1.0);
    float angle = length(edge) / max(length(a + along * edge), 1e-18);
    // A great circle's arc of angle φ, seen stereographically, is a circle's arc: at most 1.5 φ long in the square (1 φ inside the
    // disc), on a radius of at least 1, so that its chord leaves it by at most (1.5 φ)² / 8 units of place of map_size / 2 texels.
    float texels = 0.5 * float(map_size) * (1.5 * angle) * (1.5 * angle) / 8.0;
    return tessellation > 0.0 ? clamp(ceil(sqrt(texels / tessellation)), 1.0, MOST_PIECES) : 1.0;
}
//]

void main()
{
    patch_from_origin[gl_InvocationID] = vertex_from_origin[gl_InvocationID];
    if (gl_InvocationID == 0) {
        patch_layer = vertex_layer[0];
        // Outer level i belongs to the edge across from corner i. It depends on the edge alone, so that neighbours fit without a crack.
        float a = pieces(vertex_from_origin[1], vertex_from_origin[2]);
        float b = pieces(vertex_from_origin[2], vertex_from_origin[0]);
        float c = pieces(vertex_from_origin[0], vertex_from_origin[1]);
        gl_TessLevelOuter[0] = a;
        gl_TessLevelOuter[1] = b;
        gl_TessLevelOuter[2] = c;
        gl_TessLevelInner[0] = max(a, max(b, c));
    }
}
