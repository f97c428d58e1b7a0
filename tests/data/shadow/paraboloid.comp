// Each direction: its half, its place there, and the direction found again from the place.
#include "common/paraboloid.glsl"
#include "common/cube.glsl"
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Directions { vec4 directions[]; };
layout(std430, binding = 1) writeonly buffer Found { vec4 found[]; }; // place, half, angle; direction again; cube direction again

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= uint(directions.length()))
        return;
    vec3 d = directions[i].xyz;
    int side = paraboloid_half(d), face = cube_face(d);
    vec2 place = paraboloid_place(side, d);
    vec3 on_face = cube_on_face(face, d);
    found[3u * i] = vec4(place, float(side), paraboloid_angle(place));
    found[3u * i + 1u] = vec4(paraboloid_direction(side, place), 0.0);
    found[3u * i + 2u] = vec4(on_face.z * cube_direction(face, on_face.xy / on_face.z), 0.0);
}
