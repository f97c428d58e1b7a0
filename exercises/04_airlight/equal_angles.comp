// Exercise 04.1: equal angles at their limit. One invocation a sample; equal_angles.c says what the numbers mean.
//
// With t = foot + D tan(angle), and the angle going evenly from the stretch's one end to its other as x goes from 0 to 1, a lamp sees equal
// angles between samples. D is the lamp's distance from the ray, but never less than the lamp's radius.
layout(local_size_x = 8) in;
layout(binding = 0, std430) readonly buffer Samples { float numbers[]; }; // 6 a sample
layout(binding = 1, std430) writeonly buffer Places { vec2 places[]; };

// (t, dt/dx)
vec2 place_of(float nearest, float foot, float radius, float from, float to, float x)
{
    // Yours: this stays at the stretch's beginning.
    return vec2(from, 0.0);
}

void main()
{
    uint i = gl_GlobalInvocationID.x, at = 6u * i;
    if (i >= uint(places.length()))
        return;
    places[i] = place_of(numbers[at], numbers[at + 1u], numbers[at + 2u], numbers[at + 3u], numbers[at + 4u], numbers[at + 5u]);
}
