// compare: what either of two grids holds, and what only the second one does: 32 voxels at once.
layout(local_size_x = 64) in;
uniform uint word_count;
layout(std430, binding = 0) readonly buffer A { uint a_words[]; };
layout(std430, binding = 1) readonly buffer B { uint b_words[]; };
layout(std430, binding = 2) writeonly buffer Either { uint either_words[]; };
layout(std430, binding = 3) writeonly buffer OnlyB { uint only_b_words[]; };

void main()
{
    uint word = (gl_GlobalInvocationID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationID.x;
    if (word >= word_count)
        return;
    either_words[word] = a_words[word] | b_words[word];
    only_b_words[word] = b_words[word] & ~a_words[word];
}
