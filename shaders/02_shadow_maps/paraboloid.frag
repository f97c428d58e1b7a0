// Depth map on a paraboloid, last stage: the distance at which the texel's own ray meets the triangle's plane. Interpolated distances (Brabec,
// Annen and Seidel 2002) are those of a neighbouring point wherever an edge leaves its arc; this one is right however the triangle was cut.
#include "common/paraboloid.glsl"
flat in vec3 triangle[3]; // corners, relative to the light
flat in int layer;
layout(location = 0) out float light_distance;
uniform int map_size;

//[plane
void main()
{
    vec3 direction = paraboloid_direction(layer, 2.0 * gl_FragCoord.xy / float(map_size) - 1.0);
    vec3 normal = cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
    float farthest = max(length(triangle[0]), max(length(triangle[1]), length(triangle[2])));
    float to_plane = dot(normal, triangle[0]), along = dot(normal, direction);
    // No point of the triangle is farther than its corners, nor nearer than its plane: so a texel beside it, or a plane seen edge-on, stays sane.
    float nearest = abs(to_plane) / max(length(normal), 1e-30);
    light_distance = along * to_plane > 0.0 ? clamp(to_plane / along, nearest, farthest) : farthest;
}
//]
