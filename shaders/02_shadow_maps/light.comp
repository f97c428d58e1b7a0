// light: one light's direct radiance on a diffuse surface, added to the picture: albedo/π · irradiance · visibility.
#include "02_shadow_maps/receiver.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, rgba32f) uniform image2D picture;
layout(binding = 3, rgba16f) readonly uniform image2D albedos;
layout(binding = 4, r32f) readonly uniform image2D visibility;
uniform vec3 light_intensity; // W/sr; directional: W/m²
uniform float light_radius;   // metres; the inverse square is held inside

const float PI = 3.14159265;

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    Receiver receiver;
    if (!receiver_find(pixel, receiver))
        return;
#if SHAPE == DIRECTIONAL
    vec3 irradiance = light_intensity * receiver.cosine;
#else
    float held = max(length(receiver.point), light_radius);
    vec3 irradiance = light_intensity * (receiver.cosine / (held * held));
#endif
    vec3 light = imageLoad(albedos, pixel).rgb / PI * irradiance * imageLoad(visibility, pixel).x;
    imageStore(picture, pixel, imageLoad(picture, pixel) + vec4(light, 0.0));
}
