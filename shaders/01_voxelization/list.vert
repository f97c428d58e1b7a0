// list: one point a triangle of a list; the geometry stage reads the triangle's corners itself.
layout(std430, binding = 3) readonly buffer Lists { uint lists[]; };
out uint listed;

void main()
{
    listed = lists[gl_VertexID];
}
