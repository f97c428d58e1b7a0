// expanded.geom: the thesis' triangle expansion, its listings 4.1 to 4.3 in effect, flaws included. Departures: only what the compiler
// asks for, and the dominant axis by components' sizes (the listing compares signed ones, after its text has taken the largest).
#include "common/grid.glsl"

layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;
in vec3 voxel_position[];
noperspective out vec3 position;
flat out vec4 box; // clip space

//[expand
// Listing 4.2 moves each corner away along its bisector by a fixed length: at a right angle that is too little to move both edges by
// half a pixel only if the length is short; at a sharp corner it is always too little, at a blunt one too much.
void expand(inout vec2 p[3], float pixel_diagonal)
{
    vec2 side0 = normalize(p[1] - p[0]), side1 = normalize(p[2] - p[1]), side2 = normalize(p[0] - p[2]);
    p[0] += normalize(-side0 + side2) * pixel_diagonal;
    p[1] += normalize(side0 - side1) * pixel_diagonal;
    p[2] += normalize(side1 - side2) * pixel_diagonal;
}
//]

void main()
{
    vec3 normal = abs(cross(voxel_position[1] - voxel_position[0], voxel_position[2] - voxel_position[0]));
    float side = float(max(grid_size.x, max(grid_size.y, grid_size.z)));
    vec2 p[3];
    for (int i = 0; i < 3; i++) {
        vec3 v = voxel_position[i];
        p[i] = 2.0 * (normal.z >= max(normal.x, normal.y) ? v.xy : normal.y >= normal.x ? v.xz : v.zy) / side - 1.0;
    }
    float pixel_diagonal = 2.0 * sqrt(2.0) / side;
    vec4 around = vec4(min(p[0], min(p[1], p[2])) - pixel_diagonal, max(p[0], max(p[1], p[2])) + pixel_diagonal);
    expand(p, pixel_diagonal);
    for (int i = 0; i < 3; i++) {
        position = voxel_position[i]; // the flaw that costs most: the corner moves, what is interpolated from it does not
        box = around;
        gl_Position = vec4(p[i], 0.0, 1.0);
        EmitVertex();
    }
}
