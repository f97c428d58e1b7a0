// walk: the first voxel along each pixel's ray, as a colour.
#include "common/camera.glsl"
#include "common/grid_walk.glsl"
#include "01_voxelization/stored.glsl"

in vec2 picture_uv;
out vec4 color;
uniform vec3 eye_in_grid;  // voxels from the grid's corner
uniform int show;          // 0 shaded, 1 normals, 2 steps, 3 distance, 4 albedo, 5 mean normals
uniform bool mark, lines;  // redden the voxels of `marked_words`; outline all
uniform float line_width;  // voxels a voxel's distance
layout(std430, binding = 2) readonly buffer MarkedWords { uint marked_words[]; };
layout(std430, binding = 3) buffer Fetches { uint fetches[]; };

const vec3 SKY = vec3(0.02, 0.025, 0.03);
const vec3 STONE = vec3(0.95, 0.90, 0.82);
const vec3 SUN = vec3(0.30, 0.80, 0.52); // unit; six faces, six shades, none below 0.05
const vec3 MISSED = vec3(0.9, 0.05, 0.02);

// Black, red, yellow, white at 0, 1/3, 2/3, 1.
vec3 heat(float value)
{
    return clamp(3.0 * value - vec3(0.0, 1.0, 2.0), 0.0, 1.0);
}

void main()
{
    vec3 direction = camera_ray(picture_uv);
    GridHit hit = grid_walk(eye_in_grid, direction);
    // a slot a row of 64 pixels: fewer fragments wait for one another
    atomicAdd(fetches[uint(gl_FragCoord.y) & 63u], uint(hit.fetches));
    float size = float(grid_size.x + grid_size.y + grid_size.z);
    color = vec4(SKY, 1.0);
    if (show == 2)
        color.rgb = heat(float(hit.crossed) / size);
    if (!hit.found)
        return;
    vec3 normal = -sign(direction) * vec3(hit.face);
    float near = exp2(-1.5 * hit.distance / size); // a stop darker each two thirds of the three sides together
    if (show == 0)
        color.rgb = near * STONE * (0.45 + 0.50 * dot(normal, SUN));
    if (show == 1) // squared: a PNG's sRGB takes about the root again
        color.rgb = near * (0.5 + 0.5 * normal) * (0.5 + 0.5 * normal);
    if (show == 3)
        color.rgb = vec3(near);
    if (show == 4) // the inside of a solid, which no triangle touches, is stone, and has no direction
        color.rgb = near * stored_mean(hit.voxel, false, STONE) * (0.45 + 0.50 * dot(normal, SUN));
    if (show == 5) {
        vec3 half_mean = 0.5 + 0.5 * stored_mean(hit.voxel, true, vec3(0.0));
        color.rgb = near * half_mean * half_mean;
    }
    if (mark) {
        uint place, word = grid_word(hit.voxel, place);
        if ((marked_words[word] >> place & 1u) != 0u)
            color.rgb = near * MISSED * (0.45 + 0.50 * dot(normal, SUN));
    }
    if (lines) {
        vec3 in_voxel = eye_in_grid + hit.distance * direction - vec3(hit.voxel);
        vec3 border = mix(min(in_voxel, 1.0 - in_voxel), vec3(1.0), hit.face);
        if (min(border.x, min(border.y, border.z)) < line_width * hit.distance)
            color.rgb *= 0.7;
    }
}
