// Exercise 06.3: shadow that begins behind the surface. One invocation a light ray; before_it.c says what goes in and comes out.
layout(local_size_x = 8) in;
const uint WORDS = 4u;
layout(binding = 0, std430) buffer Words { uint words[]; }; // WORDS a light ray: bit k & 31 of word k >> 5 is voxel k

void main()
{
    uint ray = gl_GlobalInvocationID.x, at = WORDS * ray;
    if (at >= uint(words.length()))
        return;
#ifdef SOLUTION
    // word | -word sets the lowest set bit and all above; one place further, all above alone. What a word hands on is whether any bit was set so far.
    bool dark = false;
    for (uint i = 0u; i < WORDS; i++) {
        uint word = words[at + i];
        words[at + i] = dark ? ~0u : (word | (0u - word)) << 1;
        dark = dark || word != 0u;
    }
#else
    // Yours: this leaves the surfaces themselves, and no shadow.
    words[at] = words[at];
#endif
}
