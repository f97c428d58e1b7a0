// slice_sort: which triangles reach into which slice of an axis. First run: count; second run: fill, where `places` says.
#include "common/grid.glsl"
#include "common/triangles.glsl"
#include "01_voxelization/turn.glsl"

layout(local_size_x = 64) in;
uniform uint triangle_count;
uniform int look_along;
uniform bool fill;
layout(std430, binding = 3) writeonly buffer Lists { uint lists[]; };
layout(std430, binding = 4) buffer Places { uint places[]; }; // a slice: how many triangles, or where its next one goes

const float SLACK = 1.0 / 64.0; // voxels: a fragment's depth, interpolated in single precision, may lie beside its corners' by less

void main()
{
    uint triangle = (gl_GlobalInvocationID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationID.x;
    if (triangle >= triangle_count)
        return;
    vec3 depth;
    for (uint i = 0u; i < 3u; i++)
        depth[i] = TURN(vec3(triangle_corner(triangle, i) / voxel_size), look_along).z;
    float last = float(TURN(grid_size, look_along).z - 1);
    float near = min(depth.x, min(depth.y, depth.z)) - SLACK, far = max(depth.x, max(depth.y, depth.z)) + SLACK;
    if (near > last + 1.0 || far < 0.0)
        return;
    int to = int(min(floor(far), last));
    for (int slice = int(clamp(floor(near), 0.0, last)); slice <= to; slice++) {
        uint place = atomicAdd(places[slice], 1u);
        if (fill)
            lists[place] = triangle;
    }
}
