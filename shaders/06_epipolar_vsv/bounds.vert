// A vertex of the shadow volumes relative to the eye.
#include "common/camera.glsl"

layout(location = 0) in vec3 position;
uniform float near_distance; // the camera's
out vec3 from_eye;

void main()
{
    from_eye = position - eye;
    gl_Position = camera_clip(from_eye, near_distance);
}
