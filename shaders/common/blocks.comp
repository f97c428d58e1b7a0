// blocks: which blocks of 8³ voxels hold a bit; one invocation a block. For grid_walk.glsl; taught in chapter 01.
#include "common/grid.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Words { uint words[]; };
layout(std430, binding = 1) writeonly buffer Blocks { uint blocks[]; };

const int SIDE = 8; // 1 << BLOCK_SHIFT of grid_walk.glsl

//[blocks
void main()
{
    ivec3 count = (grid_size + SIDE - 1) / SIDE;
    ivec3 block = ivec3(gl_GlobalInvocationID);
    if (block.x >= count.x)
        return;
    ivec3 first = block * SIDE, last = min(first + SIDE, grid_size) - 1;
    uint length = uint(last.x - first.x + 1), set = 0u;
    for (int z = first.z; z <= last.z && set == 0u; z++)
        for (int y = first.y; y <= last.y && set == 0u; y++) {
            uint place, word = grid_word(ivec3(first.x, y, z), place);
            uint bits = words[word] >> place;
            if (place + length > 32u)
                bits |= words[word + 1u] << (32u - place);
            set = bits & ((1u << length) - 1u);
        }
    blocks[(block.z * count.y + block.y) * count.x + block.x] = set != 0u ? 1u : 0u;
}
//]
