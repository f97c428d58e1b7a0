// G-buffer: the vertex relative to the eye. Both are near each other wherever the scene lies, so the float difference is exact
// or nearly so, and what comes after it never meets large numbers.
#include "common/camera.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
uniform float near_distance; // the camera's
out vec3 from_eye;
out vec3 surface_normal;

void main()
{
    from_eye = position - eye;
    surface_normal = normal;
    gl_Position = camera_clip(from_eye, near_distance);
}
