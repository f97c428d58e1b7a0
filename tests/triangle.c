// The smallest picture: one triangle, drawn off-screen and written as a PPM file. Start here.
// You should see a red, a green and a blue corner that blend into each other, on dark grey.
#include "shader.h"

enum { SIZE = 256 }; // pixels a side

int main(int argc, char **argv)
{
    if (argc != 2)
        fail_request("one argument is needed: the PPM file to write");
    gl_open(gl_headless_platform(), SIZE, SIZE, "triangle");

    // Where to draw: a texture, and a framebuffer whose colour goes into it.
    GLuint picture = gl_texture(.label = "picture", .format = GL_RGBA8, .width = SIZE, .height = SIZE);
    GLuint framebuffer = gl_framebuffer(.label = "picture", .color = {picture});
    gl.ClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, (const float[]){0.1f, 0.1f, 0.1f, 1.0f});

    // How to draw: a program for the corners, then one for the pixels between them.
    shader_search_first("tests/data/triangle");
    Shader *shader = shader_open("triangle", NULL, "triangle.vert", "triangle.frag");

    // What to draw: three vertices. The shader knows their positions, so the vertex array stays empty.
    GLuint no_attributes;
    gl.CreateVertexArrays(1, &no_attributes);
    gl.BindVertexArray(no_attributes);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl.Viewport(0, 0, SIZE, SIZE);
    shader_use(shader);
    gl.DrawArrays(GL_TRIANGLES, 0, 3);

    // Read it back. GL's first row is the bottom one, a file's the top one.
    static unsigned char pixels[SIZE][SIZE][3];
    gl_texture_read(picture, 0, GL_RGB, GL_UNSIGNED_BYTE, sizeof pixels, pixels);
    const char *temporary = file_begin(argv[1]);
    FILE *file = fopen(temporary, "wb");
    bool written = file && fprintf(file, "P6 %d %d 255\n", SIZE, SIZE) > 0;
    for (int y = SIZE - 1; y >= 0 && written; y--)
        written = fwrite(pixels[y], sizeof pixels[y], 1, file) == 1;
    if (!file || fclose(file) || !written)
        fail_work("%s: cannot be written", argv[1]);
    file_commit(temporary);

    shader_close(shader);
    gl.DeleteVertexArrays(1, &no_attributes);
    gl_framebuffer_delete(&framebuffer);
    gl_texture_delete(&picture);
    gl_close();
}
