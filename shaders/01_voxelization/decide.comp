// decide: the voxels that single precision could not decide, one invocation each, in double.
#include "01_voxelization/columns.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 5) readonly buffer Undecided { uint undecided_count; uvec4 undecided[]; }; // voxel, triangle

//[decide
void main()
{
    uint item = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationID.x;
    if (item >= undecided_count)
        return;
    uvec4 asked = undecided[item];
    if (touches_exactly(asked.w, ivec3(asked.xyz), 2)) // along z nothing is turned
        voxel_found(ivec3(asked.xyz), asked.w);
}
//]
