// store: what a fragment (a triangle and a voxel that touch) leaves in its voxel besides a bit. For small.comp and large.frag compiled
// with STORE: 0 counts fragments, 1 adds their attributes to sums, 2 lists them, 3 averages them as listing 4.9 does.
#ifdef STORE
#include "01_voxelization/sums.glsl"
#if STORE == 3
#include "01_voxelization/average.glsl"
#endif
layout(std430, binding = 8) buffer FragmentCount { uint fragment_count[2]; }; // low and high word
layout(std430, binding = 9) writeonly buffer Fragments { uvec2 fragments[]; }; // number of the voxel, triangle
uniform uint capacity; // fragments that the list has room for

void voxel_found(ivec3 voxel, uint triangle)
{
#if STORE == 0
    if (atomicAdd(fragment_count[0], 1u) == 0xffffffffu)
        atomicAdd(fragment_count[1], 1u);
#elif STORE == 1
    add_fragment(voxel_slot(voxel), triangle);
#elif STORE == 2
    uint at = atomicAdd(fragment_count[0], 1u);
    if (at < capacity)
        fragments[at] = uvec2((uint(voxel.z) * uint(grid_size.y) + uint(voxel.y)) * uint(grid_size.x) + uint(voxel.x), triangle);
#else
    average_add(voxel_slot(voxel), fragment_albedo(triangle));
#endif
}
#endif
