// airlight_point and airlight_directional on a list of scalars, for tests/test_04_closed_form.c.
#include "common/airlight.glsl"

layout(local_size_x = 8) in;
struct Case {
    float nearest, foot, radius, from, to, sigma;
};
layout(binding = 0, std430) readonly buffer Cases { Case cases[]; };
layout(binding = 1, std430) writeonly buffer Results { vec2 results[]; }; // point, directional

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= uint(cases.length()))
        return;
    Case c = cases[i];
    results[i] = vec2(airlight_point(c.nearest, c.foot, c.radius, c.from, c.to, c.sigma), airlight_directional(c.from, c.to, c.sigma));
}
