// grid_lines: the voxels' faces drawn where they cut the surfaces of a picture.
#include "common/camera.glsl"

layout(local_size_x = 64) in;
layout(binding = 0, rgba32f) uniform image2D picture;
layout(binding = 1, r32f) readonly uniform image2D distance_map;
layout(binding = 2, rgba16f) readonly uniform image2D normal_map;
uniform vec3 eye_in_grid;  // voxels from the grid's corner
uniform float voxel_metres;
uniform ivec3 grid_size;
uniform float pixel_angle; // radians

const vec3 LINE = vec3(0.05, 0.35, 0.9);
const float HALF_WIDTH = 0.3; // pixels
const float STRENGTH = 0.7;   // some of the surface shows through

void main()
{
    ivec2 size = imageSize(picture), pixel = ivec2(gl_GlobalInvocationID.xy);
    if (pixel.x >= size.x)
        return;
    vec3 direction = camera_ray((vec2(pixel) + 0.5) / vec2(size));
    float distance = imageLoad(distance_map, pixel).r / voxel_metres;
    if (isinf(distance))
        return;
    vec3 p = eye_in_grid + distance * direction, n = imageLoad(normal_map, pixel).xyz;
    if (any(lessThan(p, vec3(-0.01))) || any(greaterThan(p, vec3(grid_size) + 0.01)))
        return;
    // how far p.k moves from pixel to pixel on a surface with this normal; a surface along a face has no line of that axis
    vec3 move = distance * pixel_angle * sqrt(max(vec3(0.0), 1.0 - n * n)) / max(abs(dot(n, direction)), 0.2);
    vec3 off = abs(fract(p + 0.5) - 0.5) / max(move, vec3(1e-6));
    off = mix(off, vec3(1e6), greaterThan(abs(n), vec3(0.98)));
    float cover = clamp(HALF_WIDTH + 0.5 - min(off.x, min(off.y, off.z)), 0.0, 1.0);
    // lines closer than two pixels would cover the picture
    float dense = max(move.x, max(move.y, move.z));
    cover *= STRENGTH * clamp(2.0 - 4.0 * dense, 0.0, 1.0);
    vec4 color = imageLoad(picture, pixel);
    imageStore(picture, pixel, vec4(mix(color.rgb, LINE, cover), 1.0));
}
