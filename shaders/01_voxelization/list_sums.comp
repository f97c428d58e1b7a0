// list_sums: add the fragments of a list to their voxels' sums, one invocation a fragment.
#include "common/grid.glsl"
#include "common/triangles.glsl"
#include "01_voxelization/sums.glsl"

layout(local_size_x = 64) in;
uniform uint fragment_total;
layout(std430, binding = 9) readonly buffer Fragments { uvec2 fragments[]; };

void main()
{
    uint at = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationID.x;
    if (at >= fragment_total)
        return;
    uint i = fragments[at].x, word = i >> 5, place = i & 31u; // grid_word's own order
    add_fragment(ranks[word] + uint(bitCount(grid_words[word] & ((1u << place) - 1u))), fragments[at].y);
}
