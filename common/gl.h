// gl: an OpenGL 4.5 core context, off-screen (OSMesa; EGL surfaceless where asked) or in a GLFW window;
// the entry points; debug output that ends the program on an error; tiny makers for GPU objects.
//
// Entry points are members of `gl`: gl.DispatchCompute(8, 8, 1). They come from the X-macro list in gl_functions.h over
// Khronos' glcorearb.h; the list holds direct-state-access calls only, so no maker disturbs a binding.
// Every object has a label, which debug messages name.
#ifndef GL_H
#define GL_H

#include "base.h"
#include <GL/glcorearb.h>
#include "gl_functions.h"

struct GLFWwindow;

struct GlApi {
#define GL_MEMBER(name, NAME) PFNGL##NAME##PROC name;
    GL_FUNCTIONS(GL_MEMBER)
#undef GL_MEMBER
};
extern struct GlApi gl;

typedef enum GlPlatform { GL_PLATFORM_OSMESA, GL_PLATFORM_EGL, GL_PLATFORM_WINDOW } GlPlatform;

// Make a context current and load every entry point. Off-screen: HEADLESS=egl in the environment turns OSMesa into EGL
// (gl_headless_platform reads it; any other value than osmesa or egl is a wrong request). Ends the program with status 1 and one line
// where no GL 4.5 is to be had. Size in pixels and title matter to a window only.
GlPlatform gl_headless_platform(void);
void gl_open(GlPlatform platform, int width, int height, const char *title);
void gl_close(void);
struct GLFWwindow *gl_window(void); // NULL off-screen
bool gl_display_present(void);      // whether a window could be opened at all (DISPLAY or WAYLAND_DISPLAY)

// Ends the program if GL holds an error; `where` says after what. Debug messages of high severity and GL errors end it by themselves.
void gl_check(const char *where);

// The label of the program in use (shader_use calls this), which errors name; NULL: none. The label must outlive its use.
void gl_name_program(const char *label);

typedef struct GlBuffer {
    const char *label;
    size_t bytes;
    const void *data; // NULL: zeroed
} GlBuffer;
#define gl_buffer(...) gl_buffer_make(&(GlBuffer){__VA_ARGS__})
GLuint gl_buffer_make(const GlBuffer *descriptor);
void gl_buffer_read(GLuint buffer, size_t offset, size_t bytes, void *data);

typedef struct GlTexture {
    const char *label;
    GLenum target; // 0: GL_TEXTURE_2D
    GLenum format; // sized internal format, e.g. GL_RGBA32F
    int width, height, depth;
    int levels;    // 0: 1
    GLenum filter; // 0: GL_NEAREST (magnification; minification takes mipmaps where levels > 1)
    GLenum wrap;   // 0: GL_CLAMP_TO_EDGE
} GlTexture;       // its texels are undefined until written
#define gl_texture(...) gl_texture_make(&(GlTexture){__VA_ARGS__})
GLuint gl_texture_make(const GlTexture *descriptor);
// One level as the given client format, tightly packed, bottom row first.
void gl_texture_read(GLuint texture, int level, GLenum format, GLenum type, size_t bytes, void *data);

typedef struct GlFramebuffer {
    const char *label;
    GLuint color[8]; // textures, 0 ends the list; all layers are attached
    GLuint depth;
    int width, height, layers; // only for a framebuffer without attachments
} GlFramebuffer;
#define gl_framebuffer(...) gl_framebuffer_make(&(GlFramebuffer){__VA_ARGS__})
GLuint gl_framebuffer_make(const GlFramebuffer *descriptor);

// Delete and set to 0; 0 is allowed.
void gl_buffer_delete(GLuint *buffer);
void gl_texture_delete(GLuint *texture);
void gl_framebuffer_delete(GLuint *framebuffer);

#endif
