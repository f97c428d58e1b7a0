// One point an invocation: to_epipolar, back again, the way of the grid there and back; and the angles as Wyman 2011 prints them.
layout(local_size_x = 8) in;
#include "common/epipolar.glsl"
layout(std430, binding = 0) readonly buffer Inputs { vec4 points[]; };
layout(std430, binding = 1) writeonly buffer Results { vec4 results[]; }; // four a point

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= uint(points.length()))
        return;
    vec3 point = points[i].xyz, epipolar = to_epipolar(point);
    float along = epipolar_along(vec2(sin(epipolar.x), cos(epipolar.x)), epipolar.z);
    vec3 place = epipolar_place(epipolar);
    vec3 again = vec3(epipolar_alpha_at(place.x), epipolar_theta_at(place.y), epipolar_phi_at(place.z));
#if EPIPOLE_AT_INFINITY
    vec2 printed = vec2(0.0);
#else
    vec3 to_light = epipolar_axis;
    vec2 printed = vec2(acos(clamp(dot(to_light, normalize(point)), -1.0, 1.0)),
                        acos(clamp(dot(-to_light, normalize(point - epipolar_distance * epipolar_axis)), -1.0, 1.0)));
#endif
    results[4 * i] = vec4(epipolar, along);
    results[4 * i + 1] = vec4(from_epipolar(epipolar), 0.0);
    results[4 * i + 2] = vec4(printed, 0.0, 0.0);
    results[4 * i + 3] = vec4(again, 0.0);
}
