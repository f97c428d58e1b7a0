// Three corners without any buffer: gl_VertexID counts 0, 1, 2. Position is in clip space, x and y from -1 to 1.
out vec3 corner_color;

void main()
{
    const vec2 positions[3] = vec2[](vec2(-0.8, -0.8), vec2(0.8, -0.8), vec2(0.0, 0.8));
    const vec3 colors[3] = vec3[](vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1));
    gl_Position = vec4(positions[gl_VertexID], 0.0, 1.0);
    corner_color = colors[gl_VertexID];
}
