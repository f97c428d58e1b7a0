// The picture: surfaces behind the medium, and the light in it; or that light alone.
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, rgba32f) writeonly uniform image2D picture;
layout(binding = 1, rgba32f) readonly uniform image2D surfaces;
layout(binding = 2, rgba32f) readonly uniform image2D airlight;
uniform float surface_share; // 0: the airlight alone

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    imageStore(picture, pixel, vec4(surface_share * imageLoad(surfaces, pixel).rgb + imageLoad(airlight, pixel).rgb, 1.0));
}
