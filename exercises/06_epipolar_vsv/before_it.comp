// Exercise 06.3: shadow that begins behind the surface. One invocation a light ray; before_it.c says what goes in and comes out.
layout(local_size_x = 8) in;
const uint WORDS = 4u;
layout(binding = 0, std430) buffer Words { uint words[]; }; // WORDS a light ray: bit k & 31 of word k >> 5 is voxel k

void main()
{
    uint ray = gl_GlobalInvocationID.x, at = WORDS * ray;
    if (at >= uint(words.length()))
        return;
    // Yours: this leaves the surfaces themselves, and no shadow.
    words[at] = words[at];
}
