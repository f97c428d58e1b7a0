// phase on a list of angles, for tests/test_04_phase.c: the light's way and the view ray as vectors, as a technique has them.
#include "common/phase.glsl"

layout(local_size_x = 8) in;
layout(binding = 0, std430) readonly buffer Angles { vec2 angles[]; }; // (sin, cos) of the half angle
layout(binding = 1, std430) writeonly buffer Results { vec2 results[]; }; // from the half angle; from vectors

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= uint(angles.length()))
        return;
    vec2 a = angles[i];
    vec3 travel = vec3(2.0 * a.x * a.y, 0.0, a.y * a.y - a.x * a.x);
    results[i] = vec2(phase(a * a), phase(phase_half_angle(travel, vec3(0.0, 0.0, -1.0))));
}
