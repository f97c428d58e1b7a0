// unpack: the bits of one slab's pixels into the grid's words, ordered as grid_word says.
#include "common/grid.glsl"

layout(local_size_x = 64) in;
layout(binding = 0) uniform usampler2DArray slabs;
layout(std430, binding = 0) writeonly buffer Grid { uint grid_words[]; };
uniform uint word_count;

// One word of the result an invocation: no two write the same, so nothing is atomic.
void main()
{
    uint word = (gl_GlobalInvocationID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationID.x;
    if (word >= word_count)
        return;
    uint result = 0u, row_length = uint(grid_size.x);
    // 32 · word in rows of row_length without more than 32 bits
    uint row = word / row_length * 32u + word % row_length * 32u / row_length;
    uint x = word % row_length * 32u % row_length;
    for (uint place = 0u; place < 32u; place++) {
        uint z = row / uint(grid_size.y);
        if (z >= uint(grid_size.z))
            break;
        uvec4 bits = texelFetch(slabs, ivec3(x, row % uint(grid_size.y), z >> 7), 0);
        result |= (bits[z >> 5 & 3u] >> (z & 31u) & 1u) << place;
        if (++x == row_length) {
            x = 0u;
            row++;
        }
    }
    grid_words[word] = result;
}
