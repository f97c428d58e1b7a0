// raster.geom: choose the axis along which the triangle's projection is largest and look along it (thesis 2.1.2, listing 4.1).
// One draw serves the three axes, so the viewport is a square of the grid's longest side.
#include "common/grid.glsl"
#include "01_voxelization/turn.glsl"

layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;
in vec3 voxel_position[];
noperspective out float depth;
flat out int axis;

//[dominant
void main()
{
    vec3 normal = abs(cross(voxel_position[1] - voxel_position[0], voxel_position[2] - voxel_position[0]));
    int along = normal.z >= max(normal.x, normal.y) ? 2 : normal.y >= normal.x ? 1 : 0;
    float side = float(max(grid_size.x, max(grid_size.y, grid_size.z)));
    for (int i = 0; i < 3; i++) {
        vec3 p = voxel_position[i];
        vec3 turned = TURN(p, along);
        axis = along;
        depth = turned.z;
        gl_Position = vec4(2.0 * turned.xy / side - 1.0, 0.0, 1.0);
        EmitVertex();
    }
}
//]
