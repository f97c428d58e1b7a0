// raster.frag: one voxel a fragment, at the depth of the pixel's centre.
#include "common/grid.glsl"

noperspective in float depth;
flat in int axis;
layout(std430, binding = 0) buffer Grid { uint grid_words[]; };

//[fragment
void main()
{
    ivec3 turned = ivec3(gl_FragCoord.xy, floor(depth));
    ivec3 size = axis == 0 ? grid_size.yzx : axis == 1 ? grid_size.zxy : grid_size;
    turned.z = min(turned.z, depth <= float(size.z) ? size.z - 1 : turned.z); // the last voxel's outer face is its own
    ivec3 voxel = axis == 0 ? turned.zxy : axis == 1 ? turned.yzx : turned;
    if (grid_inside(voxel)) {
        uint place, word = grid_word(voxel, place);
        atomicOr(grid_words[word], 1u << place);
    }
}
//]
