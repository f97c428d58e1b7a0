// receiver: what a pixel of the G-buffer asks of a light. A surface that faces away, or a point outside a spot's cone, is dark whatever
// casts; it asks nothing.
#include "common/camera.glsl"
#include "02_shadow_maps/map.glsl"

layout(binding = 1, r32f) readonly uniform image2D distances;
layout(binding = 2, rgba16f) readonly uniform image2D normals;
uniform vec3 eye_from_origin; // eye - origin of the map: no world coordinate is ever formed
uniform vec2 light_cone;      // sin, cos of the half angle; (0, -1): all directions

const float LEAST_DISTANCE = 1e-18; // metres; its square is still a normal float

struct Receiver {
    vec3 point, normal; // relative to the map's origin
    float cosine;       // between the normal and the way to the light
};

bool receiver_find(ivec2 pixel, out Receiver receiver)
{
    ivec2 size = imageSize(distances);
    if (any(greaterThanEqual(pixel, size)))
        return false;
    float seen = imageLoad(distances, pixel).x; // +Inf: the sky
    if (isinf(seen))
        return false;
    receiver.point = eye_from_origin + seen * camera_ray((vec2(pixel) + 0.5) / vec2(size));
    receiver.normal = imageLoad(normals, pixel).xyz;
#if SHAPE == DIRECTIONAL
    receiver.cosine = -dot(receiver.normal, light_direction);
    return receiver.cosine > 0.0;
#else
    receiver.cosine = -dot(receiver.normal, receiver.point) / max(length(receiver.point), LEAST_DISTANCE);
    return receiver.cosine > 0.0 && shadow_in_cone(receiver.point, light_direction, light_cone);
#endif
}
