// layer: set the voxels of one peeled layer and count them.
#include "01_voxelization/fragment.glsl"

layout(local_size_x = 64) in;
layout(binding = 0) uniform sampler2D layer; // 1 where nothing was found
layout(std430, binding = 1) buffer Found { uint found; };
uniform float depth_scale;
uniform int look_along;

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (pixel.x >= textureSize(layer, 0).x)
        return;
    float depth = texelFetch(layer, pixel, 0).r;
    if (depth >= 1.0)
        return;
    set_voxel(ivec3(pixel, depth / depth_scale), look_along);
    atomicAdd(found, 1u);
}
