// axis.geom: the triangle seen along a given axis, whatever its normal. `dominant_only` leaves triangles to the pass of their dominant axis.
// The viewport, the positions and the dominant axis are raster.geom's to the last bit, so that methods can be compared voxel by voxel.
#include "common/grid.glsl"
#include "common/triangles.glsl"
#include "01_voxelization/turn.glsl"

layout(points) in;
layout(triangle_strip, max_vertices = 3) out;
in uint listed[];
noperspective out float depth;
flat out int axis;
uniform int look_along; // 0, 1, 2
uniform bool dominant_only;

//[axis
void main()
{
    vec3 p[3];
    for (uint i = 0u; i < 3u; i++)
        p[i] = vec3(triangle_corner(listed[0], i) / voxel_size);
    vec3 normal = abs(cross(p[1] - p[0], p[2] - p[0]));
    int dominant = normal.z >= max(normal.x, normal.y) ? 2 : normal.y >= normal.x ? 1 : 0;
    if (dominant_only && dominant != look_along)
        return;
    float side = float(max(grid_size.x, max(grid_size.y, grid_size.z)));
    for (int i = 0; i < 3; i++) {
        vec3 turned = TURN(p[i], look_along);
        axis = look_along;
        depth = turned.z;
        gl_Position = vec4(2.0 * turned.xy / side - 1.0, 0.0, 1.0);
        EmitVertex();
    }
}
//]
