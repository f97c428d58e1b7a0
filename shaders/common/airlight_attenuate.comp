// Surfaces behind a medium: what one light gives a surface is dimmed from the light to it and from it to the eye (Billeter et al. 2010, section 5, step 2).
#include "common/camera.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, rgba32f) uniform image2D picture;           // added to
layout(binding = 1, rgba32f) readonly uniform image2D surfaces; // lit by one light, or the surfaces' own and ambient light
layout(binding = 2, r32f) readonly uniform image2D distances;
uniform vec3 eye_from_light;
uniform float light_leg; // 1: point, spot; 0: a directional light, or none
uniform vec3 extinction; // 1/m

//[attenuate
void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(picture);
    float seen = imageLoad(distances, pixel).x;
    if (any(greaterThanEqual(pixel, size)))
        return;
    vec3 radiance = imageLoad(surfaces, pixel).rgb;
    if (!isinf(seen)) { // the sky is black
        vec3 from_light = eye_from_light + seen * camera_ray((vec2(pixel) + 0.5) / vec2(size));
        radiance *= exp(-extinction * (seen + light_leg * length(from_light)));
    }
    imageStore(picture, pixel, vec4(imageLoad(picture, pixel).rgb + radiance, 1.0));
}
//]
