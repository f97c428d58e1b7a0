// peel.frag: keep the nearest voxel of each pixel that lies behind the last layer's (Everitt 2001; Li et al. 2005). The depth that is compared is
// the voxel's, not the surface's: two sheets in one voxel need no two layers.
#include "01_voxelization/fragment.glsl"

noperspective in float depth;
flat in int axis;
layout(binding = 0) uniform sampler2D last_layer; // 0 before the first layer
uniform float depth_scale; // a power of two: a voxel's depth is exact

//[peel
void main()
{
    ivec3 voxel = fragment_voxel(gl_FragCoord.xy, depth, axis);
    float voxel_depth = (float(voxel.z) + 0.5) * depth_scale;
    if (voxel.z >= TURN(grid_size, axis).z || voxel_depth <= texelFetch(last_layer, ivec2(gl_FragCoord.xy), 0).r)
        discard;
    gl_FragDepth = voxel_depth;
}
//]
