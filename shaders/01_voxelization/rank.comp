// rank: how many bits are set before each word's first. A chunk of words an invocation: first all chunks are counted; the host adds the counts up, which it
// needs to know how many voxels to make room for; then each chunk hands its words their ranks.
layout(local_size_x = 64) in;
const uint CHUNK = 128u; // words: 512³ voxels make 32 768 chunks, enough for any machine, few for the host
uniform uint word_count;
uniform bool hand_out;
layout(std430, binding = 0) readonly buffer Grid { uint grid_words[]; };
layout(std430, binding = 4) writeonly buffer Ranks { uint ranks[]; };
layout(std430, binding = 5) buffer Chunks { uint chunks[]; }; // set bits in a chunk; then, before it

//[rank
void main()
{
    uint chunk = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationID.x;
    uint first = CHUNK * chunk, end = min(first + CHUNK, word_count);
    if (first >= word_count)
        return;
    uint rank = hand_out ? chunks[chunk] : 0u;
    for (uint word = first; word < end; word++) {
        if (hand_out)
            ranks[word] = rank;
        rank += uint(bitCount(grid_words[word]));
    }
    if (!hand_out)
        chunks[chunk] = rank;
}
//]
