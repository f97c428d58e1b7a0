// expanded.frag: the thesis' listings 4.4 and 4.5 in effect: one voxel a fragment, where the interpolated position says.
#include "01_voxelization/fragment.glsl"

noperspective in vec3 position;
flat in vec4 box; // clip space

//[expanded
void main()
{
    float side = float(max(grid_size.x, max(grid_size.y, grid_size.z)));
    vec2 lower = floor((box.xy * 0.5 + 0.5) * side), upper = ceil((box.zw * 0.5 + 0.5) * side);
    if (any(lessThan(gl_FragCoord.xy, lower)) || any(greaterThan(gl_FragCoord.xy, upper)))
        discard;
    set_voxel(min(ivec3(floor(position)), grid_size - 1), 2);
}
//]
