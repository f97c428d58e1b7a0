// shadow: is a point lit? Lookups in the depth maps that raster_depth_map_draw (common/raster.h) makes, by imageLoad of the
// nearest texel. Chapter 02 teaches them line by line.
//
// Every `point` is relative to the map's origin: DepthMap.origin. Build it from differences (surface - eye, eye - origin), not from
// world coordinates, where a scene may lie far from the world's origin. Results are 1 lit, 0 in shadow. `bias` is in metres; a point in
// a medium needs none, a point on a surface takes shadow_bias.
#include "common/cube.glsl"

// On a plane a texel's ray meets the surface up to half a texel's diagonal (0.71 texels) beside the point that is looked up, at slope
// tan θ; the rest of 1 is for smooth normals, which lean away from the triangle's own.
const float SHADOW_BIAS_TEXELS = 1.0;
// Added to tan θ: in a crease the triangle beside is steeper than the normal says. Without it creases of the bunny show dark specks; with
// 1 the sun shines in along the cornell box's upper edges. Much less than a texel of contact shadow is lost to it.
const float SHADOW_BIAS_SLOPE = 0.5;

// How much nearer to the light a map of this texel size (metres, at the point) may see the surface that the point itself lies on;
// cosine of the angle between the normal and the way to the light.
float shadow_bias(float texel, float cosine)
{
    float c = clamp(cosine, 1e-3, 1.0); // below, Lambert's cosine has put out the light anyway
    return SHADOW_BIAS_TEXELS * texel * (SHADOW_BIAS_SLOPE + sqrt(1.0 - c * c) / c);
}

// Place in [-1, 1]² to texel; the clamp is for rounding on the border.
ivec2 shadow_texel(vec2 place, ivec2 size)
{
    return ivec2(clamp((0.5 * place + 0.5) * vec2(size), vec2(0.0), vec2(size - 1)));
}

// A point inside the cone; which points are, shadow_in_cone says.
float shadow_spot(readonly image2D map, mat4 to_clip, vec3 point, float bias)
{
    vec4 clip = to_clip * vec4(point, 1.0);
    float stored = imageLoad(map, shadow_texel(clip.xy / clip.w, imageSize(map))).x;
    return float(length(point) <= stored + bias);
}

// Points beside the map are lit: it covers all that can cast (fitted to a camera: all surfaces that it sees).
float shadow_directional(readonly image2D map, mat4 to_clip, vec3 direction, vec3 point, float bias)
{
    vec2 place = (to_clip * vec4(point, 1.0)).xy;
    float stored = imageLoad(map, shadow_texel(place, imageSize(map))).x;
    bool beside = any(greaterThan(abs(place), vec2(1.0)));
    return float(beside || dot(point, direction) <= stored + bias);
}

float shadow_point(readonly image2DArray map, vec3 point, float bias)
{
    int face = cube_face(point);
    vec3 on_face = cube_on_face(face, point);
    float stored = imageLoad(map, ivec3(shadow_texel(on_face.xy / on_face.z, imageSize(map).xy), face)).x;
    return float(length(point) <= stored + bias);
}

// Whether a point relative to the light is inside its cone; `cone` is (sin, cos) of the half angle; (0, -1): all directions.
// sin(θ - half angle) <= 0 keeps its precision for narrow cones, where cosines do not.
bool shadow_in_cone(vec3 point, vec3 axis, vec2 cone)
{
    return length(cross(axis, point)) * cone.y <= dot(axis, point) * cone.x;
}
