// airlight_from_vectors and airlight_point on a list of rays, for tests/test_04_closed_form.c.
#include "common/airlight.glsl"

layout(local_size_x = 8) in;
struct Case {
    vec4 to_light, direction; // w: radius; sigma
    vec4 range;               // from, to
};
layout(binding = 0, std430) readonly buffer Cases { Case cases[]; };
layout(binding = 1, std430) writeonly buffer Results { float results[]; };

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= uint(cases.length()))
        return;
    Case c = cases[i];
    float nearest, foot;
    airlight_from_vectors(c.to_light.xyz, c.direction.xyz, nearest, foot);
    results[i] = airlight_point(nearest, foot, c.to_light.w, c.range.x, c.range.y, c.direction.w);
}
