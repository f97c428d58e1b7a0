// raster.frag: one voxel a fragment, at the depth of the pixel's centre.
#include "01_voxelization/fragment.glsl"

noperspective in float depth;
flat in int axis;

//[fragment
void main()
{
    set_voxel(fragment_voxel(gl_FragCoord.xy, depth, axis), axis);
}
//]
