// samples.frag: one voxel for each of a pixel's samples that the triangle covers, at that sample's own depth.
#include "01_voxelization/fragment.glsl"

noperspective in float depth;
flat in int axis;

const int SAMPLES = 4; // as many as every GL 4.5 has

//[samples
void main()
{
    for (int i = 0; i < SAMPLES; i++)
        if ((gl_SampleMaskIn[0] >> i & 1) != 0)
            set_voxel(fragment_voxel(gl_FragCoord.xy, interpolateAtSample(depth, i), axis), axis);
}
//]
