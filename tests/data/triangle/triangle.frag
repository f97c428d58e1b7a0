// Runs once a pixel inside the triangle; GL has blended the three corners' colours.
in vec3 corner_color;
out vec4 pixel;

void main()
{
    pixel = vec4(corner_color, 1.0);
}
