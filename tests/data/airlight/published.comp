// The published closed forms on the list of scalars of point.comp, for tests/test_04_published.c.
#include "common/airlight.glsl"
#include "04_airlight/sun.glsl"
#include "04_airlight/pegoraro.glsl"

layout(local_size_x = 8) in;
struct Case {
    float nearest, foot, radius, from, to, sigma;
};
layout(binding = 0, std430) readonly buffer Cases { Case cases[]; };
layout(binding = 1, std430) writeonly buffer Results { vec2 results[]; }; // sun, pegoraro

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= uint(cases.length()))
        return;
    Case c = cases[i];
    results[i] = vec2(sun_point(c.nearest, c.foot, c.from, c.to, c.sigma), pegoraro_point(c.nearest, c.foot, c.from, c.to, c.sigma));
}
