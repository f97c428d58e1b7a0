// solid.frag: one column a fragment, under the polygon of large.geom, which covers the centre of every pixel that the triangle touches. It covers
// each once: two flips of one crossing would be none.
#include "01_voxelization/solid.glsl"

flat in ivec4 base; // w: the triangle

void main()
{
    uint triangle = uint(base.w);
    flip_column(TURN(triangle_corner(triangle, 0u), axis), TURN(triangle_corner(triangle, 1u), axis),
                TURN(triangle_corner(triangle, 2u), axis), ivec2(gl_FragCoord.xy));
}
