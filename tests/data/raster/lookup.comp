// Visibility of a list of points by shaders/common/shadow.glsl, without bias, for tests/test_raster.c.
#include "common/shadow.glsl"

layout(local_size_x = 8) in;
layout(binding = 0, std430) readonly buffer Points { vec4 points[]; }; // relative to the map's origin
layout(binding = 1, std430) writeonly buffer Lit { float lit[]; };
#if MAP_KIND == 0
layout(binding = 0, r32f) readonly uniform image2DArray depth_map;
#else
layout(binding = 0, r32f) readonly uniform image2D depth_map;
#endif
uniform mat4 to_clip;
uniform vec3 direction;

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= uint(points.length()))
        return;
#if MAP_KIND == 0
    lit[i] = shadow_point(depth_map, points[i].xyz, 0.0);
#elif MAP_KIND == 1
    lit[i] = shadow_spot(depth_map, to_clip, points[i].xyz, 0.0);
#else
    lit[i] = shadow_directional(depth_map, to_clip, direction, points[i].xyz, 0.0);
#endif
}
