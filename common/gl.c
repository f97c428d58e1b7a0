// gl: see gl.h.
#include "gl.h"

#include <stdlib.h>
#include <string.h>
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GLFW/glfw3.h>
#if __has_include(<GL/osmesa.h>)
#include <GL/osmesa.h>
#define HEADLESS_DEFAULT "osmesa"
#else // Mesa 25.1 and later
#define HEADLESS_DEFAULT "egl"
#endif

typedef void (*EntryPoint)(void);
typedef EntryPoint (*Loader)(const char *name);

struct GlApi gl;

// A thread has one current GL context, and debug messages come without an argument of ours: this is its state.
static struct {
    void *osmesa;
    unsigned char osmesa_pixel[4]; // OSMesa insists on a default framebuffer; nothing draws to it
    EGLDisplay egl;
    GLFWwindow *window;
    char *making;        // what object is being made, for errors; NULL between
    const char *program; // label of the program in use
} context;

static Loader open_osmesa(void)
{
#ifdef OSMESA_RGBA
    const int attributes[][2] = {{OSMESA_PROFILE, OSMESA_CORE_PROFILE},
                                 {OSMESA_CONTEXT_MAJOR_VERSION, 4},
                                 {OSMESA_CONTEXT_MINOR_VERSION, 5},
                                 {0, 0}};
    context.osmesa = OSMesaCreateContextAttribs(*attributes, NULL);
    if (context.osmesa && OSMesaMakeCurrent(context.osmesa, context.osmesa_pixel, GL_UNSIGNED_BYTE, 1, 1))
        return OSMesaGetProcAddress;
#endif
    return NULL;
}

static Loader open_egl(void)
{
    const EGLint attributes[][2] = {{EGL_CONTEXT_MAJOR_VERSION, 4},
                                    {EGL_CONTEXT_MINOR_VERSION, 5},
                                    {EGL_CONTEXT_OPENGL_DEBUG, EGL_TRUE}, // the profile is core unless asked
                                    {EGL_NONE, EGL_NONE}};
    setenv("EGL_LOG_LEVEL", "fatal", 0); // its warnings would come before our one line
    context.egl = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
    if (!eglInitialize(context.egl, NULL, NULL) || !eglBindAPI(EGL_OPENGL_API))
        return NULL;
    EGLContext made = eglCreateContext(context.egl, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, *attributes);
    return made && eglMakeCurrent(context.egl, NULL, NULL, made) ? eglGetProcAddress : NULL;
}

static Loader open_window(int width, int height, const char *title)
{
    const int hints[][2] = {{GLFW_CONTEXT_VERSION_MAJOR, 4},
                            {GLFW_CONTEXT_VERSION_MINOR, 5},
                            {GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE},
                            {GLFW_OPENGL_DEBUG_CONTEXT, GLFW_TRUE}};
    if (!glfwInit())
        return NULL;
    for (size_t i = 0; i < sizeof hints / sizeof *hints; i++)
        glfwWindowHint(hints[i][0], hints[i][1]);
    context.window = glfwCreateWindow(width, height, title, NULL, NULL);
    glfwMakeContextCurrent(context.window);
    return context.window ? glfwGetProcAddress : NULL;
}

static void APIENTRY on_message(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei length,
                                const GLchar *message, const void *user)
{
    (void)id, (void)length, (void)user;
    // A compiler's errors are shader.c's to tell, with the reader's own file and line.
    if (source == GL_DEBUG_SOURCE_SHADER_COMPILER ||
        (type != GL_DEBUG_TYPE_ERROR && severity != GL_DEBUG_SEVERITY_HIGH))
        return;
    const char *program = context.program ? context.program : "none";
    fail_work("OpenGL: %s (%s%s)", message, context.making ? "making " : "program in use: ",
              context.making ? context.making : program); // GL itself may not be asked from in here
}

GlPlatform gl_headless_platform(void)
{
    const char *asked = getenv("HEADLESS"), *headless = asked && *asked ? asked : HEADLESS_DEFAULT;
    bool egl = strcmp(headless, "egl") == 0;
    if (!egl && strcmp(headless, "osmesa"))
        fail_request("HEADLESS=%s: must be osmesa or egl", headless);
    return egl ? GL_PLATFORM_EGL : GL_PLATFORM_OSMESA;
}

void gl_open(GlPlatform platform, int width, int height, const char *title)
{
    static const char *const names[] = {"OSMesa (try HEADLESS=egl)", "EGL without a display", "GLFW"};
    Loader load = platform == GL_PLATFORM_OSMESA ? open_osmesa()
                  : platform == GL_PLATFORM_EGL  ? open_egl()
                                                 : open_window(width, height, title);
    const char *reason = "no driver gives one";
    if (!load && platform == GL_PLATFORM_WINDOW)
        glfwGetError(&reason);
    if (!load)
        fail_work("no OpenGL 4.5 core context from %s: %s", names[platform], reason);
#define LOAD_ENTRY(name, NAME)                                                                               \
    if (!(gl.name = (PFNGL##NAME##PROC)load("gl" #name)))                                                    \
        fail_work("this OpenGL has no gl" #name);
    GL_FUNCTIONS(LOAD_ENTRY)
    gl.Enable(GL_DEBUG_OUTPUT);
    gl.Enable(GL_DEBUG_OUTPUT_SYNCHRONOUS); // a debugger's stack at the message then holds the call to blame
    gl.DebugMessageCallback(on_message, NULL);
}

void gl_close(void)
{
#ifdef OSMESA_RGBA
    if (context.osmesa)
        OSMesaDestroyContext(context.osmesa);
#endif
    if (context.egl)
        eglTerminate(context.egl);
    if (context.window)
        glfwTerminate();
    memset(&context, 0, sizeof context);
    memset(&gl, 0, sizeof gl);
}

GLFWwindow *gl_window(void)
{
    return context.window;
}

bool gl_display_present(void)
{
    const char *x11 = getenv("DISPLAY"), *wayland = getenv("WAYLAND_DISPLAY");
    return (x11 && *x11) || (wayland && *wayland);
}

void gl_name_program(const char *label)
{
    context.program = label;
}

void gl_check(const char *where)
{
    GLenum error = gl.GetError();
    if (error)
        fail_work("OpenGL: error 0x%x after %s", error, where);
}

// The making of an object lies between these two: what errors say, and whether the machine can hold it at all.
static void making(const char *kind, const char *label, size_t count, size_t bytes)
{
    context.making = text_format("%s '%s', %.0f bytes", kind, label, (double)count * (double)bytes);
    memory_bytes(count, bytes, context.making);
}

static GLuint made(GLenum kind, GLuint object, const char *label)
{
    gl.ObjectLabel(kind, object, (GLsizei)strnlen(label, 255),
                   label); // every GL takes 256 with the final NUL
    free(context.making);
    context.making = NULL;
    return object;
}

GLuint gl_buffer_make(const GlBuffer *descriptor)
{
    GLuint buffer = 0;
    // GL refuses an empty buffer; a word nobody reads saves every caller a case for the empty scene.
    size_t bytes = descriptor->bytes ? descriptor->bytes : 4;
    const void *data = descriptor->bytes ? descriptor->data : NULL;
    making("buffer", descriptor->label, bytes, 1);
    gl.CreateBuffers(1, &buffer);
    gl.NamedBufferStorage(buffer, (GLsizeiptr)bytes, data, GL_DYNAMIC_STORAGE_BIT);
    if (!data)
        gl.ClearNamedBufferData(buffer, GL_R8UI, GL_RED_INTEGER, GL_UNSIGNED_BYTE, NULL);
    return made(GL_BUFFER, buffer, descriptor->label);
}

void gl_buffer_read(GLuint buffer, size_t offset, size_t bytes, void *data)
{
    gl.GetNamedBufferSubData(buffer, (GLintptr)offset, (GLsizeiptr)bytes, data);
}

GLuint gl_texture_make(const GlTexture *descriptor)
{
    GlTexture t = *descriptor;
    t.target = t.target ? t.target : GL_TEXTURE_2D;
    t.levels = t.levels ? t.levels : 1;
    t.filter = t.filter ? t.filter : GL_NEAREST;
    t.wrap = t.wrap ? t.wrap : GL_CLAMP_TO_EDGE;
    bool line = t.target == GL_TEXTURE_1D, cube = t.target == GL_TEXTURE_CUBE_MAP;
    bool deep =
        t.target == GL_TEXTURE_3D || t.target == GL_TEXTURE_2D_ARRAY || t.target == GL_TEXTURE_CUBE_MAP_ARRAY;
    GLint texel_bits = 0, bits = 0;
    for (GLenum part = GL_INTERNALFORMAT_RED_SIZE; part <= GL_INTERNALFORMAT_STENCIL_SIZE;
         part++, texel_bits += bits)
        gl.GetInternalformativ(t.target, t.format, part, 1, &bits);
    // Of the largest level, which alone decides whether it fits; 2³¹ · 2³¹ texels still fit in size_t.
    size_t texels = (size_t)t.width * (size_t)(line ? 1 : t.height);
    making("texture", t.label, texels, (size_t)(deep ? t.depth : cube ? 6 : 1) * (size_t)texel_bits / 8);
    GLuint texture = 0;
    gl.CreateTextures(t.target, 1, &texture);
    if (line)
        gl.TextureStorage1D(texture, t.levels, t.format, t.width);
    else if (deep)
        gl.TextureStorage3D(texture, t.levels, t.format, t.width, t.height, t.depth);
    else
        gl.TextureStorage2D(texture, t.levels, t.format, t.width, t.height);
    GLenum mipmapped = t.filter == GL_NEAREST ? GL_NEAREST_MIPMAP_NEAREST : GL_LINEAR_MIPMAP_LINEAR;
    gl.TextureParameteri(texture, GL_TEXTURE_MAG_FILTER, (GLint)t.filter);
    gl.TextureParameteri(texture, GL_TEXTURE_MIN_FILTER, (GLint)(t.levels > 1 ? mipmapped : t.filter));
    gl.TextureParameteri(texture, GL_TEXTURE_WRAP_S, (GLint)t.wrap);
    gl.TextureParameteri(texture, GL_TEXTURE_WRAP_T, (GLint)t.wrap);
    gl.TextureParameteri(texture, GL_TEXTURE_WRAP_R, (GLint)t.wrap);
    return made(GL_TEXTURE, texture, t.label);
}

void gl_texture_read(GLuint texture, int level, GLenum format, GLenum type, size_t bytes, void *data)
{
    if (bytes > INT32_MAX)
        fail_work("texture %u: %zu bytes to read at once, OpenGL counts to %d", texture, bytes, INT32_MAX);
    gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl.GetTextureImage(texture, level, format, type, (GLsizei)bytes, data);
}

GLuint gl_framebuffer_make(const GlFramebuffer *descriptor)
{
    GLenum buffers[8];
    GLuint framebuffer = 0;
    int count = 0;
    making("framebuffer", descriptor->label, 0, 0);
    gl.CreateFramebuffers(1, &framebuffer);
    for (; count < 8 && descriptor->color[count]; count++) {
        buffers[count] = GL_COLOR_ATTACHMENT0 + (GLenum)count;
        gl.NamedFramebufferTexture(framebuffer, buffers[count], descriptor->color[count], 0);
    }
    gl.NamedFramebufferDrawBuffers(framebuffer, count, buffers);
    gl.NamedFramebufferTexture(framebuffer, GL_DEPTH_ATTACHMENT, descriptor->depth, 0); // 0: none
    gl.NamedFramebufferParameteri(framebuffer, GL_FRAMEBUFFER_DEFAULT_WIDTH, descriptor->width);
    gl.NamedFramebufferParameteri(framebuffer, GL_FRAMEBUFFER_DEFAULT_HEIGHT, descriptor->height);
    gl.NamedFramebufferParameteri(framebuffer, GL_FRAMEBUFFER_DEFAULT_LAYERS, descriptor->layers);
    GLenum status = gl.CheckNamedFramebufferStatus(framebuffer, GL_DRAW_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE)
        fail_work("framebuffer '%s' is not complete (status 0x%x)", descriptor->label, status);
    return made(GL_FRAMEBUFFER, framebuffer, descriptor->label);
}

#define DELETE(function, kind)                                                                               \
    void function(GLuint *object)                                                                            \
    {                                                                                                        \
        gl.kind(1, object);                                                                                  \
        *object = 0;                                                                                         \
    }
DELETE(gl_buffer_delete, DeleteBuffers)
DELETE(gl_texture_delete, DeleteTextures)
DELETE(gl_framebuffer_delete, DeleteFramebuffers)
