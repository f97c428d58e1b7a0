// slice.frag: of a triangle's fragments, those between a slice's near and far plane (Fang and Chen 2000). Each fragment is clipped, not the
// triangle: a cut triangle gets new corners, which the rasterizer snaps to its own raster, and neighbouring slices would not agree about their border.
#include "01_voxelization/fragment.glsl"

noperspective in float depth;
flat in int axis;
uniform int slice;

//[slice
void main()
{
    ivec3 voxel = fragment_voxel(gl_FragCoord.xy, depth, axis);
    if (voxel.z == slice)
        set_voxel(voxel, axis);
}
//]
