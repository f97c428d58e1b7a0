// stored: what a voxel holds besides its bit, read back: the mean of its sums, divided here and not before, or listing 4.9's average.
#include "01_voxelization/attribute_steps.glsl"
layout(std430, binding = 4) readonly buffer StoredRanks { uint stored_ranks[]; };
layout(std430, binding = 5) readonly buffer Stored { uint stored[]; }; // 7 sums a voxel as in sums.glsl, or one average
layout(std430, binding = 6) readonly buffer StoredWords { uint stored_words[]; }; // of the grid that was ranked
uniform bool averaged; // `stored` are averages

//[stored
// The mean albedo, or of the normals; `none` where no triangle touches the voxel.
vec3 stored_mean(ivec3 voxel, bool normals, vec3 none)
{
    uint place, word = grid_word(voxel, place);
    if ((stored_words[word] >> place & 1u) == 0u)
        return none;
    uint slot = stored_ranks[word] + uint(bitCount(stored_words[word] & ((1u << place) - 1u)));
    if (averaged)
        return vec3(stored[slot] & 0xffu, stored[slot] >> 8 & 0xffu, stored[slot] >> 16 & 0xffu) / 255.0;
    uint first = 7u * slot + (normals ? 4u : 1u);
    uvec3 sum = uvec3(stored[first], stored[first + 1u], stored[first + 2u]);
    float fragments = float(stored[7u * slot]);
    return normals ? vec3(ivec3(sum)) / (NORMAL_STEPS * fragments) : vec3(sum) / (ALBEDO_STEPS * fragments);
}
//]
