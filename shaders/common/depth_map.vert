// Depth map, first stage, for every kind of light: the vertex relative to the map's origin. Both are near each other wherever the
// scene lies, so the float difference is exact or nearly so, and the matrix after it never meets large numbers.
layout(location = 0) in vec3 position;
uniform vec3 origin;
uniform mat4 to_clip; // spot, directional
out vec3 from_origin;

void main()
{
    from_origin = position - origin;
    gl_Position = to_clip * vec4(from_origin, 1.0);
}
