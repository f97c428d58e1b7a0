// gl: contexts, makers and what an error says. Pictures are 32² and compared exactly: clears and integers do not round.
#include "gl.h"
#include "failure.h"

#include <criterion/criterion.h>
#include <GLFW/glfw3.h>

static void open_context(void)
{
    gl_open(gl_headless_platform(), 0, 0, NULL);
}

static void check_label(GLenum kind, GLuint object, const char *expected)
{
    char label[300] = "";
    gl.GetObjectLabel(kind, object, sizeof label, NULL, label);
    cr_assert_str_eq(label, expected, "label is '%s', should be '%s'", label, expected);
}

Test(gl, context_is_core_4_5_with_every_entry_point, .init = open_context, .fini = gl_close)
{
    GLint profile = 0, major = 0, minor = 0;
    gl.GetIntegerv(GL_MAJOR_VERSION, &major);
    gl.GetIntegerv(GL_MINOR_VERSION, &minor);
    gl.GetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
    cr_assert_geq(major * 10 + minor, 45, "OpenGL %d.%d", major, minor);
    cr_assert(profile & GL_CONTEXT_CORE_PROFILE_BIT, "core profile");
    const void *const *members = (const void *const *)&gl;
    for (size_t i = 0; i < sizeof gl / sizeof *members; i++)
        cr_assert_not_null(members[i], "entry point %zu of gl_functions.h", i);
    cr_assert_null(gl_window(), "off-screen there is no window");
}

Test(gl, context_can_be_closed_and_opened_again)
{
    for (int i = 0; i < 3; i++) {
        open_context();
        GLuint buffer = gl_buffer(.label = "again", .bytes = 16);
        cr_assert_neq(buffer, 0, "round %d", i);
        gl_close();
    }
}

Test(gl, buffer_holds_its_data_or_zeros, .init = open_context, .fini = gl_close)
{
    unsigned char data[1001], read[1001];
    for (size_t i = 0; i < sizeof data; i++)
        data[i] = (unsigned char)(i * 37);
    GLuint filled = gl_buffer(.label = "filled", .bytes = sizeof data, .data = data);
    gl_buffer_read(filled, 0, sizeof read, read);
    cr_assert_eq(memcmp(data, read, sizeof data), 0, "what went in comes out");
    gl_buffer_read(filled, 500, 10, read);
    cr_assert_eq(memcmp(data + 500, read, 10), 0, "from an offset, too");
    GLuint zeroed = gl_buffer(.label = "zeroed", .bytes = sizeof data);
    gl_buffer_read(zeroed, 0, sizeof read, read);
    for (size_t i = 0; i < sizeof read; i++)
        cr_assert_eq(read[i], 0, "byte %zu", i);
    GLuint empty = gl_buffer(.label = "empty", .bytes = 0, .data = data);
    check_label(GL_BUFFER, filled, "filled");
    cr_assert_neq(empty, 0, "an empty scene needs no special case");
    gl_buffer_delete(&filled);
    cr_assert_eq(filled, 0, "deleted and set to 0");
    gl_buffer_delete(&filled); // 0 is allowed
    gl_check("deleting 0");
}

Test(gl, texture_of_every_target_has_its_size, .init = open_context, .fini = gl_close)
{
    static const struct {
        GLenum target;
        int width, height, depth; // asked for
        int sizes[3];             // as GL counts them, arrays by layers
    } cases[] = {
        {0, 8, 4, 0, {8, 4, 1}},
        {GL_TEXTURE_1D, 8, 0, 0, {8, 1, 1}},
        {GL_TEXTURE_1D_ARRAY, 8, 3, 0, {8, 3, 1}},
        {GL_TEXTURE_2D, 5, 7, 0, {5, 7, 1}},
        {GL_TEXTURE_RECTANGLE, 5, 7, 0, {5, 7, 1}},
        {GL_TEXTURE_2D_ARRAY, 8, 4, 3, {8, 4, 3}},
        {GL_TEXTURE_3D, 8, 4, 2, {8, 4, 2}},
        {GL_TEXTURE_CUBE_MAP, 8, 8, 0, {8, 8, 1}},
        {GL_TEXTURE_CUBE_MAP_ARRAY, 8, 8, 12, {8, 8, 12}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        GLuint texture =
            gl_texture(.label = "of a target", .target = cases[i].target, .format = GL_RGBA16F,
                       .width = cases[i].width, .height = cases[i].height, .depth = cases[i].depth);
        const GLenum names[] = {GL_TEXTURE_WIDTH, GL_TEXTURE_HEIGHT, GL_TEXTURE_DEPTH};
        for (int k = 0; k < 3; k++) {
            GLint size = 0;
            gl.GetTextureLevelParameteriv(texture, 0, names[k], &size);
            cr_assert_eq(size, cases[i].sizes[k], "case %zu: side %d is %d", i, k, size);
        }
        check_label(GL_TEXTURE, texture, "of a target");
        gl_texture_delete(&texture);
        cr_assert_eq(texture, 0, "deleted and set to 0");
    }
}

Test(gl, texture_levels_are_averaged_and_read_tightly, .init = open_context, .fini = gl_close)
{
    // 6x2 texels of one byte: rows of 6 bytes would be padded to 8 by GL's own alignment
    const unsigned char texels[2][6] = {{0, 4, 8, 12, 16, 20}, {4, 8, 12, 16, 20, 24}};
    GLuint texture = gl_texture(.label = "levels", .format = GL_R8, .width = 6, .height = 2, .levels = 2,
                                .filter = GL_LINEAR);
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl.TextureSubImage2D(texture, 0, 0, 0, 6, 2, GL_RED, GL_UNSIGNED_BYTE, texels);
    gl.GenerateTextureMipmap(texture);
    unsigned char read[2][6], small[3];
    gl_texture_read(texture, 0, GL_RED, GL_UNSIGNED_BYTE, sizeof read, read);
    cr_assert_eq(memcmp(texels, read, sizeof read), 0, "level 0 as it went in");
    gl_texture_read(texture, 1, GL_RED, GL_UNSIGNED_BYTE, sizeof small, small);
    for (int x = 0; x < 3; x++) // means of 2x2: 4, 12, 20; one step for the rounding of 8 bits
        cr_assert(abs(small[x] - (4 + 8 * x)) <= 1, "texel %d of level 1 is %d", x, small[x]);
}

Test(gl, framebuffer_draws_into_all_its_attachments, .init = open_context, .fini = gl_close)
{
    GLuint color = gl_texture(.label = "color", .format = GL_RGBA32F, .width = 32, .height = 32);
    GLuint index = gl_texture(.label = "index", .format = GL_R32UI, .width = 32, .height = 32);
    GLuint depth = gl_texture(.label = "depth", .format = GL_DEPTH_COMPONENT32F, .width = 32, .height = 32);
    GLuint framebuffer = gl_framebuffer(.label = "two", .color = {color, index}, .depth = depth);
    check_label(GL_FRAMEBUFFER, framebuffer, "two");
    gl.ClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, (const float[]){0.5f, -2.0f, 1e6f, 1.0f});
    gl.ClearNamedFramebufferuiv(framebuffer, GL_COLOR, 1, (const unsigned[]){4000000000u, 0, 0, 0});
    gl.ClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, (const float[]){0.25f});
    static float colors[32 * 32][4], depths[32 * 32];
    static unsigned indices[32 * 32];
    gl_texture_read(color, 0, GL_RGBA, GL_FLOAT, sizeof colors, colors);
    gl_texture_read(index, 0, GL_RED_INTEGER, GL_UNSIGNED_INT, sizeof indices, indices);
    gl_texture_read(depth, 0, GL_DEPTH_COMPONENT, GL_FLOAT, sizeof depths, depths);
    for (int i = 0; i < 32 * 32; i++) {
        cr_assert(colors[i][0] == 0.5f && colors[i][1] == -2.0f && colors[i][2] == 1e6f, "pixel %d", i);
        cr_assert_eq(indices[i], 4000000000u, "pixel %d", i);
        cr_assert_eq(depths[i], 0.25f, "pixel %d", i);
    }
    gl_framebuffer_delete(&framebuffer);
    cr_assert_eq(framebuffer, 0, "deleted and set to 0");
}

Test(gl, framebuffer_without_attachments_has_its_size, .init = open_context, .fini = gl_close)
{
    GLuint framebuffer = gl_framebuffer(.label = "none", .width = 64, .height = 32, .layers = 3);
    gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    cr_assert_eq(gl.CheckNamedFramebufferStatus(framebuffer, GL_DRAW_FRAMEBUFFER), GL_FRAMEBUFFER_COMPLETE,
                 "complete without a single texture");
}

Test(gl, a_long_label_is_cut_not_refused, .init = open_context, .fini = gl_close)
{
    char label[400];
    memset(label, 'x', sizeof label - 1);
    label[sizeof label - 1] = '\0';
    GLuint buffer = gl_buffer(.label = label, .bytes = 4);
    label[255] = '\0';
    check_label(GL_BUFFER, buffer, label);
}

static void wrong_call(void)
{
    open_context();
    gl_name_program("cone tracing");
    gl.DrawArrays(0x1234, 0, 3);
}
static void wrong_format(void)
{
    open_context();
    gl_texture(.label = "radiance", .format = GL_RGBA, .width = 8, .height = 8); // unsized
}
static void texture_beyond_memory(void)
{
    open_context();
    gl_texture(.label = "grid", .target = GL_TEXTURE_3D, .format = GL_RGBA32F, .width = 1 << 16,
               .height = 1 << 16, .depth = 1 << 16);
}
static void cube_beyond_memory(void)
{
    open_context();
    gl_texture(.label = "sky", .target = GL_TEXTURE_CUBE_MAP, .format = GL_RGBA32F, .width = 1 << 20,
               .height = 1 << 20);
}
static void texture_beyond_gl(void)
{
    open_context();
    gl_texture(.label = "grid", .target = GL_TEXTURE_3D, .format = GL_RGBA8, .width = 1024, .height = 1024,
               .depth = 1024);
}
static void buffer_beyond_memory(void)
{
    open_context();
    gl_buffer(.label = "nodes", .bytes = (size_t)1 << 46);
}
static void no_attachment_no_size(void)
{
    open_context();
    gl_framebuffer(.label = "nowhere");
}
static void error_found_by_check(void)
{
    open_context();
    gl.DebugMessageCallback(NULL, NULL);
    gl.Enable(0x1234);
    gl_check("the light pass");
}
static void wrong_headless(void)
{
    setenv("HEADLESS", "glx", 1);
    open_context();
}
static void osmesa_too_old(void)
{
    setenv("MESA_GL_VERSION_OVERRIDE", "3.3", 1);
    gl_open(GL_PLATFORM_OSMESA, 0, 0, NULL);
}
static void egl_too_old(void)
{
    setenv("MESA_GL_VERSION_OVERRIDE", "3.3", 1);
    gl_open(GL_PLATFORM_EGL, 0, 0, NULL);
}
static void egl_without_driver(void)
{
    setenv("LIBGL_DRIVERS_PATH", "/no/such/folder", 1);
    gl_open(GL_PLATFORM_EGL, 0, 0, NULL);
}
static void window_without_display(void)
{
    unsetenv("DISPLAY");
    unsetenv("WAYLAND_DISPLAY");
    cr_assert_not(gl_display_present(), "no display");
    gl_open(GL_PLATFORM_WINDOW, 32, 32, "none");
}

// Each a Test of its own: name, what ends the program, its status, two pieces of its one line.
#define FAILS(name, function, expected, text, more)                                                          \
    Test(gl_fails, name)                                                                                     \
    {                                                                                                        \
        Failure failure = failure_of(function);                                                              \
        cr_assert_eq(failure.status, expected, "status %d: %s", failure.status, failure.message);            \
        cr_assert(failure_says(&failure, text), "%s", failure.message);                                      \
        cr_assert(failure_says(&failure, more), "%s", failure.message);                                      \
    }
FAILS(a_wrong_call_names_the_program_in_use, wrong_call, 1, "glDrawArrays", "cone tracing")
FAILS(a_wrong_format_names_the_texture, wrong_format, 1, "glTextureStorage2D", "texture 'radiance'")
FAILS(a_texture_beyond_memory_names_its_bytes, texture_beyond_memory, 1, "texture 'grid'",
      "4503599627370496 bytes")
FAILS(a_cube_beyond_memory_names_its_bytes, cube_beyond_memory, 1, "texture 'sky'", "105553116266496 bytes")
FAILS(a_texture_beyond_gl_names_its_bytes, texture_beyond_gl, 1, "texture 'grid'", "4294967296 bytes")
FAILS(a_buffer_beyond_memory_names_its_bytes, buffer_beyond_memory, 1, "buffer 'nodes'",
      "70368744177664 bytes")
FAILS(an_incomplete_framebuffer_names_itself, no_attachment_no_size, 1, "framebuffer 'nowhere'",
      "not complete")
FAILS(gl_check_says_after_what, error_found_by_check, 1, "0x500", "the light pass")
FAILS(a_wrong_HEADLESS_is_a_wrong_request, wrong_headless, 2, "HEADLESS=glx", "osmesa or egl")
FAILS(osmesa_below_4_5, osmesa_too_old, 1, "no OpenGL 4.5", "OSMesa")
FAILS(egl_below_4_5, egl_too_old, 1, "no OpenGL 4.5", "EGL")
FAILS(egl_without_a_driver, egl_without_driver, 1, "no OpenGL 4.5", "EGL")
FAILS(a_window_without_a_display, window_without_display, 1, "no OpenGL 4.5", "DISPLAY")

// The same without a child process between, so that Criterion itself sees the status.
Test(gl_fails, a_debug_error_ends_the_program, .exit_code = 1)
{
    wrong_call();
    _exit(77); // went on: not 1
}

Test(gl, egl_clears_as_osmesa_does)
{
    static float pixels[2][32 * 32][4];
    for (int i = 0; i < 2; i++) {
        gl_open(i ? GL_PLATFORM_EGL : GL_PLATFORM_OSMESA, 0, 0, NULL);
        GLuint color = gl_texture(.label = "color", .format = GL_RGBA32F, .width = 32, .height = 32);
        GLuint framebuffer = gl_framebuffer(.label = "color", .color = {color});
        gl.ClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, (const float[]){0.1f, 0.2f, 0.3f, 0.4f});
        gl_texture_read(color, 0, GL_RGBA, GL_FLOAT, sizeof pixels[i], pixels[i]);
        gl_close();
    }
    cr_assert_eq(pixels[0][0][0], 0.1f, "cleared");
    cr_assert_eq(memcmp(pixels[0], pixels[1], sizeof pixels[0]), 0, "bit for bit");
}

// Where there is a display, a window's context loads the same entry points.
Test(gl, window_where_there_is_a_display)
{
    if (!gl_display_present())
        cr_skip_test("no display here; the window's own tests bring one");
    gl_open(GL_PLATFORM_WINDOW, 64, 32, "test");
    int width = 0, height = 0;
    glfwGetWindowSize(gl_window(), &width, &height);
    cr_assert(width == 64 && height == 32, "%dx%d", width, height);
    gl_close();
    cr_assert_null(gl_window(), "closed");
}
