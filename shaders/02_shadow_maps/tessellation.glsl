// tessellation: on a paraboloid a triangle's straight edges are arcs of circles. Into how many pieces must an edge be cut, so that none of
// them leaves its arc by more than `tessellation` texels?
uniform float tessellation; // texels; 0: edges stay whole

const float MOST_PIECES = 64.0; // GL_MAX_TESS_GEN_LEVEL of every OpenGL 4.5

//[pieces
float edge_pieces(vec3 a, vec3 b, int map_side)
{
    // The nearest point of the edge to the light is where a piece looks longest: about (length of a piece) / (distance) radians.
    vec3 edge = b - a;
    float along = clamp(-dot(a, edge) / max(dot(edge, edge), 1e-30), 0.0, 1.0);
    float angle = length(edge) / max(length(a + along * edge), 1e-18);
    // A great circle's arc of angle φ, seen stereographically, is a circle's arc: at most 1.5 φ long in the square (1 φ inside the
    // disc), on a radius of at least 1, so that its chord leaves it by at most (1.5 φ)² / 8 units of place of map_side / 2 texels.
    float texels = 0.5 * float(map_side) * (1.5 * angle) * (1.5 * angle) / 8.0;
    return tessellation > 0.0 ? clamp(ceil(sqrt(texels / tessellation)), 1.0, MOST_PIECES) : 1.0;
}
//]
