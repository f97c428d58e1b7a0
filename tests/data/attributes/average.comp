// A row of values averaged one after another by listing 4.9, for tests/test_01_attributes.c: one invocation, so that their order is known.
#include "01_voxelization/average.glsl"

layout(local_size_x = 1) in;
layout(binding = 0, std430) readonly buffer Values { float values[]; }; // grey, 0 to 1

void main()
{
    for (int i = 0; i < values.length(); i++)
        average_add(0u, vec3(values[i]));
}
