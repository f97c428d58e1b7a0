// sums: a voxel's albedo and normal as sums of integers and a count. Integers can be added in any order; floats cannot.
// Voxels that are set have numbers, their ranks: how many set bits there are before theirs. Only they have sums.
layout(std430, binding = 0) readonly buffer Grid { uint grid_words[]; };
layout(std430, binding = 4) readonly buffer Ranks { uint ranks[]; }; // of each word's first bit
layout(std430, binding = 6) readonly buffer TriangleMaterials { uint triangle_materials[]; };
layout(std430, binding = 7) readonly buffer Materials { vec4 materials[]; }; // albedo, emission

//[rank
uint voxel_slot(ivec3 voxel)
{
    uint place, word = grid_word(voxel, place);
    return ranks[word] + uint(bitCount(grid_words[word] & ((1u << place) - 1u)));
}
//]

vec3 fragment_albedo(uint triangle)
{
    return materials[2u * triangle_materials[triangle]].rgb;
}

#ifdef SUMS
#include "01_voxelization/attribute_steps.glsl"
layout(std430, binding = 5) buffer Sums { uint sums[]; }; // 7 a voxel: fragments; red, green, blue; x, y, z of the normal

//[sums
void add_fragment(uint slot, uint triangle)
{
    dvec3 p0 = triangle_corner(triangle, 0u);
    dvec3 normal = cross(triangle_corner(triangle, 1u) - p0, triangle_corner(triangle, 2u) - p0);
    dvec3 size = abs(normal);
    vec3 direction = normalize(vec3(normal / max(size.x, max(size.y, size.z)))); // its square could underflow
    ivec3 steps = ivec3(round(NORMAL_STEPS * direction));
    uvec3 albedo = uvec3(ALBEDO_STEPS * fragment_albedo(triangle) + 0.5);
    atomicAdd(sums[7u * slot], 1u);
    for (uint k = 0u; k < 3u; k++) {
        atomicAdd(sums[7u * slot + 1u + k], albedo[k]);
        atomicAdd(sums[7u * slot + 4u + k], uint(steps[k])); // of a negative number too: two's complement
    }
}
//]
#endif
