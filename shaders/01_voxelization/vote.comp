// vote: inside is what at least two of three axes say; for a closed mesh, where one would do, what the last says.
layout(local_size_x = 64) in;
uniform uint word_count;
uniform int closed;
layout(std430, binding = 0) readonly buffer X { uint x_words[]; };
layout(std430, binding = 1) readonly buffer Y { uint y_words[]; };
layout(std430, binding = 2) readonly buffer Z { uint z_words[]; };
layout(std430, binding = 3) writeonly buffer Result { uint result[]; };

void main()
{
    uint word = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationID.x;
    if (word >= word_count)
        return;
    uint x = x_words[word], y = y_words[word], z = z_words[word];
    result[word] = closed != 0 ? z : (x & y) | (y & z) | (z & x);
}
