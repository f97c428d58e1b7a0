// Exercise 02.1: a bias from the texel's size. One invocation a receiver; slope_bias.c says what the numbers mean.
layout(local_size_x = 8) in;
layout(binding = 0, std430) readonly buffer Receivers { float numbers[]; }; // 7 a receiver
layout(binding = 1, std430) writeonly buffer Biases { float biases[]; };

// How much nearer to the light the map may see a surface that it lies on, in metres. `normal` and `to_light` have any length.
float bias_of(float texel, vec3 normal, vec3 to_light)
{
    // Yours: this is no bias at all, and every surface has acne.
    return 0.0;
}

void main()
{
    uint i = gl_GlobalInvocationID.x, at = 7u * i;
    if (i >= uint(biases.length()))
        return;
    vec3 normal = vec3(numbers[at + 1u], numbers[at + 2u], numbers[at + 3u]);
    vec3 to_light = vec3(numbers[at + 4u], numbers[at + 5u], numbers[at + 6u]);
    biases[i] = bias_of(numbers[at], normal, to_light);
}
