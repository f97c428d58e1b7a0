// The picture before any light: emission + ambient · albedo; black where the G-buffer has no surface.
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, rgba32f) writeonly uniform image2D picture;
layout(binding = 1, rgba16f) readonly uniform image2D albedos;
layout(binding = 2, rgba16f) readonly uniform image2D emissions;
uniform float ambient;

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    vec3 radiance = imageLoad(emissions, pixel).rgb + ambient * imageLoad(albedos, pixel).rgb;
    imageStore(picture, pixel, vec4(radiance, 1.0)); // stores outside the image do nothing
}
