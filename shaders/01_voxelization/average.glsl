// average: a running average in 32 bits a voxel by compare-and-swap: red, green, blue, count (Gomes 2015, listing 4.9, after Crassin and Green 2012). As
// printed, but that a buffer's name stands in the place of the image parameter, which GLSL does not take for atomics. It has two
// faults, and the lesson shows them: the count has 8 bits, and each step rounds down.
layout(std430, binding = 5) coherent volatile buffer Averages { uint averages[]; };

//[average
vec4 unpack_average(uint value)
{
    return vec4(value & 0xffu, value >> 8 & 0xffu, value >> 16 & 0xffu, value >> 24);
}

uint pack_average(vec4 value)
{
    uvec4 v = uvec4(value) & 0xffu; // rounds down; the count 256 becomes 0
    return v.w << 24 | v.z << 16 | v.y << 8 | v.x;
}

void average_add(uint slot, vec3 colour)
{
    vec4 value = vec4(255.0 * colour, 1.0);
    uint wanted = pack_average(value), expected = 0u, found;
    while ((found = atomicCompSwap(averages[slot], expected, wanted)) != expected) {
        expected = found; // somebody else was here: average with what they left, and try again
        vec4 old = unpack_average(found);
        vec4 sum = vec4(old.rgb * old.a, old.a) + value;
        wanted = pack_average(vec4(sum.rgb / sum.a, sum.a));
    }
}
//]
