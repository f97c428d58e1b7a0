// all: one point a triangle of the mesh; the geometry stage reads the triangle's corners itself.
out uint listed;

void main()
{
    listed = uint(gl_VertexID);
}
