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
#ifdef SOLUTION
    // Angles near π/2 tell little of where they point. The whole angle between the ends, by the tangent of a difference, is no difference of two such;
    // and we turn from the end that is farther from the foot, again by the tangent of a sum or difference.
    float d = max(nearest, radius), before = from - foot, behind = to - foot;
    float whole = atan(d * (to - from), d * d + before * behind);
    bool first = abs(before) > abs(behind);
    float start = first ? before : behind, turn = first ? d * tan(x * whole) : -d * tan((1.0 - x) * whole);
    float from_foot = d * d * (start + turn) / (d * d - start * turn);
    return vec2(foot + from_foot, (d * d + from_foot * from_foot) / d * whole);
#else
    // Yours: this stays at the stretch's beginning.
    return vec2(from, 0.0);
#endif
}

void main()
{
    uint i = gl_GlobalInvocationID.x, at = 6u * i;
    if (i >= uint(places.length()))
        return;
    places[i] = place_of(numbers[at], numbers[at + 1u], numbers[at + 2u], numbers[at + 3u], numbers[at + 4u], numbers[at + 5u]);
}
