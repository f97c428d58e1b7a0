// map: where a point relative to the light stands in its depth map, and which texel that is, for every shape of map.
#include "common/shadow.glsl"
#include "common/paraboloid.glsl"

#define CUBE 0
#define SPOT 1
#define DIRECTIONAL 2
#define PARABOLOID 3
#if SHAPE == CUBE
#define LAYERS 6
#elif SHAPE == PARABOLOID
#define LAYERS 2
#else
#define LAYERS 1
#endif

uniform mat4 to_clip;         // spot, directional
uniform vec3 light_direction; // spot, directional; unit
uniform float texel_size;     // metres a texel covers: 1 m along the axis, or anywhere (directional)

struct Place {
    int layer;
    vec2 at;     // [-1, 1]²
    float texel; // metres that a texel covers there
};

//[place
Place map_place(vec3 point)
{
#if SHAPE == CUBE
    int face = cube_face(point);
    vec3 on_face = cube_on_face(face, point);
    return Place(face, on_face.xy / on_face.z, texel_size * on_face.z);
#elif SHAPE == PARABOLOID
    int side = paraboloid_half(point);
    vec2 at = paraboloid_place(side, point);
    return Place(side, at, texel_size * paraboloid_angle(at) * length(point));
#elif SHAPE == SPOT
    vec4 clip = to_clip * vec4(point, 1.0);
    return Place(0, clip.xy / clip.w, texel_size * clip.w); // w is the distance along the axis
#else
    return Place(0, (to_clip * vec4(point, 1.0)).xy, texel_size);
#endif
}
//]

// What the map stores of a surface at this point.
float map_distance(vec3 point)
{
#if SHAPE == DIRECTIONAL
    return dot(point, light_direction);
#else
    return length(point);
#endif
}

//[wrap
// The texel beside a face's border lies on the next face: found by its direction. Elsewhere there is nothing beyond the border (a spot's cone
// lies inside it, a directional map has a texel of margin, a paraboloid goes on behind its half), so the clamp is only for rounding.
ivec3 map_texel(int layer, ivec2 texel, ivec2 size)
{
#if SHAPE == CUBE
    if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, size))) {
        vec2 place = (2.0 * vec2(texel) + 1.0) / vec2(size) - 1.0;
        vec3 direction = cube_direction(layer, place);
        layer = cube_face(direction);
        vec3 on_face = cube_on_face(layer, direction);
        return ivec3(shadow_texel(on_face.xy / on_face.z, size), layer);
    }
#endif
    return ivec3(clamp(texel, ivec2(0), size - 1), layer);
}
//]
