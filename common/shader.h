// shader: load GLSL, resolve `#include "common/file.glsl"` (relative to a shader folder), compile, link; an error gives the reader's
// own file and line; a changed file is compiled again. One stage a file, named by its ending: .vert .tesc .tese .geom .frag .comp;
// included files end in .glsl. `#version 450 core` and the definitions are put before the first line.
#ifndef SHADER_H
#define SHADER_H

#include "gl.h"

// A linked program and the files that it came from.
typedef struct Shader Shader;

// Look for files in `folder` first, then in the project's own shaders/ (found beside the working folder or the program). NULL: own only.
void shader_search_first(const char *folder);
// `#define NAME VALUE` in every shader opened from now on (EVERYTHING is 0 unless defined here).
void shader_define_all(const char *name, int value);

// Compile and link the stages named after `definitions` ("RESOLUTION 64\nLIGHTS 2", or NULL). Ends the program (status 1) with one line
// "FILE:LINE: what the compiler said". Label and file names are kept, not copied.
#define shader_open(label, definitions, ...)                                                                 \
    shader_open_stages(label, definitions, (const char *[]){__VA_ARGS__, NULL})
Shader *shader_open_stages(const char *label, const char *definitions, const char *const *stage_files);
void shader_close(Shader *shader); // NULL is allowed

// Compile anew every open shader one of whose files has changed. A shader that fails keeps its last good program; *error (free it)
// then holds the one-line message, else NULL. Returns how many were replaced: their uniforms are 0 until set again.
int shader_reload_changed(char **error);
// As above for every open shader, changed or not.
int shader_reload_all(char **error);

// Make it the current program; then dispatch or draw.
void shader_use(const Shader *shader);
GLuint shader_program(const Shader *shader);

// Uniforms by name, without binding. A name that the linked program does not use is ignored: a student's shader may not need it.
void shader_set_int(const Shader *shader, const char *name, int value);
void shader_set_uint(const Shader *shader, const char *name, unsigned value);
void shader_set_ivec3(const Shader *shader, const char *name, const int value[3]);
void shader_set_float(const Shader *shader, const char *name, float value);
void shader_set_vec2(const Shader *shader, const char *name, float x, float y);
void shader_set_vec3(const Shader *shader, const char *name, const float value[3]);
void shader_set_vec4(const Shader *shader, const char *name, const float value[4]);
void shader_set_double(const Shader *shader, const char *name, double value);
void shader_set_dvec3(const Shader *shader, const char *name, const double value[3]);
void shader_set_mat4(const Shader *shader, const char *name, const float value[16]);

#endif
