// One triangle that covers the whole picture: (0, 0), (2, 0), (0, 2) in picture coordinates, without any buffer.
out vec2 picture_uv; // [0, 1]² inside the picture, v up

void main()
{
    picture_uv = vec2((gl_VertexID & 1) * 2, (gl_VertexID >> 1) * 2);
    gl_Position = vec4(2.0 * picture_uv - 1.0, 0.0, 1.0);
}
