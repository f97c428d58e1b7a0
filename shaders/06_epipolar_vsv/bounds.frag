// How far away this face is. Blended by GL_MIN: what stays is the nearest face, and minus the farthest.
in vec3 from_eye;
layout(location = 0) out vec2 bounds;

void main()
{
    bounds = vec2(1.0, -1.0) * length(from_eye);
}
