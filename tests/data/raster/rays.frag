// The camera's ray through every pixel, for tests/test_raster.c.
#include "common/camera.glsl"

in vec2 picture_uv;
layout(location = 0) out vec4 ray;

void main()
{
    ray = vec4(camera_ray(picture_uv), 1.0);
}
