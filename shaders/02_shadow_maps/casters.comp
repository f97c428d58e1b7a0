// casters: which triangles must be drawn into which layer of the map? A triangle may shadow a pixel only if it meets the hull of the light
// and of what the camera sees; receivers.comp has found the hull's bounds in the map.
#include "02_shadow_maps/bounds.glsl"
#include "02_shadow_maps/map.glsl"
#include "02_shadow_maps/tessellation.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer AskedBounds { Bounds bounds[]; };
layout(std430, binding = 1) readonly buffer Positions { float positions[]; }; // 3 a vertex, metres
layout(std430, binding = 2) readonly buffer Indices { uint indices[]; };      // 3 a triangle
layout(std430, binding = 3) writeonly buffer Casters { uint casters[]; };     // triangle << 3 | layer
layout(std430, binding = 4) coherent buffer CasterCount { uint whole_count, cut_count; }; // from the front; from the list's end
uniform vec3 origin;
uniform uint triangle_count;
uniform int cut_far; // 0: what lies beyond the farthest receiver counts too (moments mix all depths)

vec3 corner(uint triangle, uint k)
{
    uint at = 3u * indices[3u * triangle + k];
    return vec3(positions[at], positions[at + 1u], positions[at + 2u]) - origin;
}

// Homogeneous place in a layer: x / w, y / w, w > 0 in front of the light.
vec3 on_layer(int layer, vec3 p)
{
#if SHAPE == CUBE
    return cube_on_face(layer, p);
#else
    vec4 clip = to_clip * vec4(p, 1.0);
    return clip.xyw;
#endif
}

//[casters
bool may_cast(int layer, vec3 p[3])
{
    Bounds asked = bounds[layer];
    if (asked.end_x == 0u)
        return false;
    vec3 lower = min(p[0], min(p[1], p[2])), upper = max(p[0], max(p[1], p[2]));
#if SHAPE == DIRECTIONAL
    float nearest = min(map_distance(p[0]), min(map_distance(p[1]), map_distance(p[2])));
#else
    float nearest = length(max(lower, -upper) * vec3(greaterThan(max(lower, -upper), vec3(0.0)))); // of the triangle's box
#endif
    if (cut_far != 0 && nearest > uintBitsToFloat(asked.farthest))
        return false;
#if SHAPE == PARABOLOID
    // What a square does not show is a cone about the other axis; a triangle with its corners inside is inside.
    int behind = 0;
    for (int k = 0; k < 3; k++)
        behind += int(paraboloid_turn(layer, p[k]).z < PARABOLOID_LEAST_Z * length(p[k]));
    return behind < 3;
#else
    // Outside one side of the asked rectangle with all three corners. Each side is a plane through the light, x = at · w, so that this
    // holds for corners behind the light as well; nothing is divided.
    vec2 first = 2.0 * vec2(uint(TILES) - asked.from_end_x, uint(TILES) - asked.from_end_y) / float(TILES) - 1.0;
    vec2 end = 2.0 * vec2(asked.end_x, asked.end_y) / float(TILES) - 1.0;
    ivec4 outside = ivec4(0);
    int behind = 0;
    for (int k = 0; k < 3; k++) {
        vec3 c = on_layer(layer, p[k]);
        outside += ivec4(lessThan(c.xy, first * c.z), greaterThan(c.xy, end * c.z));
        behind += int(c.z <= 0.0);
    }
    return behind < 3 && !any(equal(outside, ivec4(3)));
#endif
}
//]

void main()
{
    uint triangle = (gl_GlobalInvocationID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationID.x;
    if (triangle >= triangle_count)
        return;
    vec3 p[3] = vec3[3](corner(triangle, 0u), corner(triangle, 1u), corner(triangle, 2u));
    for (int layer = 0; layer < LAYERS; layer++) {
#if !EVERYTHING
        if (!may_cast(layer, p))
            continue;
#endif
#if SHAPE == PARABOLOID
        if (max(edge_pieces(p[0], p[1], map_size), max(edge_pieces(p[1], p[2], map_size), edge_pieces(p[2], p[0], map_size))) > 1.0) {
            casters[uint(LAYERS) * triangle_count - 1u - atomicAdd(cut_count, 1u)] = triangle << 3 | uint(layer);
            continue;
        }
#endif
        casters[atomicAdd(whole_count, 1u)] = triangle << 3 | uint(layer);
    }
}
