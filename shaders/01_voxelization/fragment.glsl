// fragment: one voxel a fragment, at the depth of the pixel's centre or of a sample. For the methods that let the rasterizer decide.
#include "common/grid.glsl"
#include "01_voxelization/turn.glsl"

layout(std430, binding = 0) buffer Grid { uint grid_words[]; };

// In turned space: pixel, pixel, depth. The grid's outer face belongs to its last voxel.
ivec3 fragment_voxel(vec2 pixel, float depth, int axis)
{
    int layers = TURN(grid_size, axis).z;
    int layer = int(floor(depth));
    return ivec3(pixel, depth <= float(layers) ? min(layer, layers - 1) : layer);
}

void set_voxel(ivec3 turned, int axis)
{
    ivec3 voxel = TURN_BACK(turned, axis);
    if (grid_inside(voxel)) {
        uint place, word = grid_word(voxel, place);
        atomicOr(grid_words[word], 1u << place);
    }
}
