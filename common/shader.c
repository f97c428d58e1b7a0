// shader: see shader.h.
#include "shader.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

// A file that some stage named, whether it was found or not: it may change, appear, or be hidden by a student's own.
typedef struct Source {
    char *name, *path; // as shaders name it; as it was found, or NULL
    uint64_t stamp;    // of path, time and size when it was last read
    const char *stage; // the last one that it went into
} Source;

struct Shader {
    GLuint program; // the last good one
    bool failed;    // and older than its files
    const char *label, **stages;
    char *head;      // what stands before a stage's first line
    Source *sources; // a file's place in this list is its number in GL's errors, see LINES_A_FILE
    size_t source_count;
    Shader *next;
};

// #line can give a file's number too, but Mesa 22.3 forgets it: its errors always say file 0. So the line carries it.
enum { LINES_A_FILE = 100000 };

// Where to look, and all that is open: reload takes no argument, since an included file may be under any of them.
static struct {
    Shader *shaders;
    char *first, *own; // folders
    char *definitions; // of shader_define_all
} state;

// The project's shaders/ is the one that holds common/: in the working folder, else in one above the program.
static const char *own_folder(void)
{
    if (state.own)
        return state.own;
    char program[4096] = "", *slash, *common = text_format("shaders/common");
    ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
    program[length > 0 ? length : 0] = '\0';
    while (access(common, F_OK) && (slash = strrchr(program, '/'))) {
        *slash = '\0';
        free(common);
        common = text_format("%s/shaders/common", program);
    }
    *strrchr(common, '/') = '\0';
    return state.own = common;
}

// Look the file up. A student's folder is flat: there its base name will do.
static void find(Source *source)
{
    const char *slash = strrchr(source->name, '/'), *base = slash ? slash + 1 : source->name;
    const char *folders[] = {own_folder(), state.first, state.first},
               *names[] = {source->name, base, source->name};
    struct stat status;
    free(source->path);
    source->path = NULL;
    source->stamp = HASH_START;
    for (int i = state.first ? 2 : 0; i >= 0 && !source->path; i--) {
        char *path = text_format("%s/%s", folders[i], names[i]);
        if (stat(path, &status)) {
            free(path);
            continue;
        }
        source->path = path;
        source->stamp = hash_bytes(source->stamp, path, strlen(path));
        source->stamp = hash_bytes(source->stamp, &status.st_mtim, sizeof status.st_mtim);
        source->stamp = hash_bytes(source->stamp, &status.st_size, sizeof status.st_size);
    }
}

static bool changed(const Shader *shader)
{
    bool differs = false;
    for (size_t i = 0; i < shader->source_count && !differs; i++) {
        Source now = {.name = shader->sources[i].name};
        find(&now);
        differs = now.stamp != shader->sources[i].stamp;
        free(now.path);
    }
    return differs;
}

// Append the file with what it includes, each file once a stage. NULL, or the error, which begins with `from`.
static char *append(Shader *shader, FILE *out, const char *name, const char *stage, const char *from)
{
    size_t number = 0;
    while (number < shader->source_count && strcmp(shader->sources[number].name, name))
        number++;
    if (number == shader->source_count) {
        shader->sources = memory_grow(shader->sources, ++shader->source_count, sizeof(Source), name);
        shader->sources[number] = (Source){.name = text_format("%s", name)};
        find(&shader->sources[number]); // before reading: what changes in between is seen later
    }
    if (shader->sources[number].stage == stage)
        return NULL;
    shader->sources[number].stage = stage;
    errno = ENOENT;
    char *path = shader->sources[number].path, *text = path ? file_read(path, NULL) : NULL, *error = NULL;
    if (!text)
        return text_format("%s%s: %s (looked in %s%s%s)", from, name, strerror(errno),
                           state.first ? state.first : "", state.first ? ", " : "", own_folder());
    fprintf(out, "#line %zu\n", number * LINES_A_FILE + 1);
    char included[256];
    size_t line = 1;
    for (char *start = text, *end; *start && !error; start = end, line++) {
        end = start + strcspn(start, "\n");
        end += *end == '\n';
        if (sscanf(start, " # include \"%255[^\"\n]\"", included) == 1) {
            char *here = text_format("%s:%zu: ", path, line);
            error = append(shader, out, included, stage, here);
            fprintf(out, "\n#line %zu\n", number * LINES_A_FILE + line + 1);
            free(here);
        } else {
            fwrite(start, 1, (size_t)(end - start), out);
        }
    }
    fputc('\n', out);
    free(text);
    return error;
}

// NULL, or the first error in the log of a shader or program as "FILE:LINE: what the compiler said".
static char *explain(const Shader *shader, const char *what, GLuint object, GLenum status,
                     PFNGLGETSHADERIVPROC get, PFNGLGETSHADERINFOLOGPROC get_log)
{
    GLint good = 0;
    char log[4096] = "";
    get(object, status, &good);
    if (good)
        return NULL;
    get_log(object, sizeof log, NULL, log);
    const char *line = strstr(log, "error");
    while (line > log && line[-1] != '\n')
        line--;
    line = line ? line : log;
    size_t at = 0;
    int text = 0, length = (int)strcspn(line, "\n");
    if (sscanf(line, "%*d:%zu(%*d): %n", &at, &text) != 1 || !text) // Mesa: 0:12(5): error: …
        sscanf(line, "%*d(%zu) : %n", &at, &text);                  // NVIDIA: 0(12) : error …
    if (text && at / LINES_A_FILE < shader->source_count)
        return text_format("%s:%zu: %.*s", shader->sources[at / LINES_A_FILE].path, at % LINES_A_FILE,
                           length - text, line + text);
    return text_format("%s: %.*s", what, length, line);
}

// Compile one stage and attach it. NULL, or the error.
static char *attach(Shader *shader, GLuint program, const char *file)
{
    static const char endings[] = ".vert.tesc.tese.geom.frag.comp";
    static const GLenum kinds[] = {GL_VERTEX_SHADER,   GL_TESS_CONTROL_SHADER, GL_TESS_EVALUATION_SHADER,
                                   GL_GEOMETRY_SHADER, GL_FRAGMENT_SHADER,     GL_COMPUTE_SHADER};
    const char *dot = strrchr(file, '.'), *ending = dot && strlen(dot) == 5 ? strstr(endings, dot) : NULL;
    if (!ending)
        fail_work("%s: a stage's file ends in .vert .tesc .tese .geom .frag or .comp", file);
    char *text = NULL;
    size_t bytes = 0;
    FILE *out = open_memstream(&text, &bytes);
    fputs(shader->head, out);
    char *error = append(shader, out, file, file, "");
    fclose(out);
    if (!error) {
        GLuint object = gl.CreateShader(kinds[(ending - endings) / 5]);
        gl.ShaderSource(object, 1, &(const GLchar *){text}, NULL);
        gl.CompileShader(object);
        error = explain(shader, file, object, GL_COMPILE_STATUS, gl.GetShaderiv, gl.GetShaderInfoLog);
        gl.AttachShader(program, object);
        gl.DeleteShader(object); // lives on while attached
    }
    free(text);
    return error;
}

// Make a new program from the files as they are now. NULL, or the error: then the old one stays.
static char *build(Shader *shader)
{
    for (size_t i = 0; i < shader->source_count; i++) {
        shader->sources[i].stage = NULL;
        find(&shader->sources[i]);
    }
    GLuint program = gl.CreateProgram();
    char *error = NULL;
    for (const char **stage = shader->stages; *stage && !error; stage++)
        error = attach(shader, program, *stage);
    if (!error) {
        gl.LinkProgram(program);
        error =
            explain(shader, shader->label, program, GL_LINK_STATUS, gl.GetProgramiv, gl.GetProgramInfoLog);
    }
    shader->failed = error;
    gl.DeleteProgram(error ? program : shader->program);
    if (!error) {
        shader->program = program;
        gl.ObjectLabel(GL_PROGRAM, program, (GLsizei)strnlen(shader->label, 255), shader->label);
    }
    return error;
}

void shader_search_first(const char *folder)
{
    struct stat status;
    if (folder && (stat(folder, &status) || !S_ISDIR(status.st_mode)))
        fail_request("%s: no such folder of shaders", folder);
    free(state.first);
    state.first = folder ? text_format("%s", folder) : NULL;
}

void shader_define_all(const char *name, int value)
{
    char *old = state.definitions;
    state.definitions = text_format("%s#define %s %d\n", old ? old : "", name, value);
    free(old);
}

Shader *shader_open_stages(const char *label, const char *definitions, const char *const *stage_files)
{
    const char *all = state.definitions ? state.definitions : "", *own = definitions ? definitions : "";
    size_t count = 1, bytes = 0;
    while (stage_files[count - 1])
        count++;
    Shader *shader = memory_new(1, sizeof *shader, label);
    shader->label = label;
    shader->stages = memory_new(count, sizeof *stage_files, label);
    memcpy(shader->stages, stage_files, count * sizeof *stage_files);
    FILE *head = open_memstream(&shader->head, &bytes);
    fprintf(head, "#version 450 core\n%s%s", strstr(all, " EVERYTHING ") ? "" : "#define EVERYTHING 0\n",
            all);
    for (size_t length; *own; own += length + (own[length] == '\n')) {
        length = strcspn(own, "\n");
        fputs("#define ", head);
        fwrite(own, 1, length, head);
        fputc('\n', head);
    }
    fclose(head);
    char *error = build(shader);
    if (error)
        fail_work("%s", error);
    shader->next = state.shaders;
    return state.shaders = shader;
}

void shader_close(Shader *shader)
{
    if (!shader)
        return;
    Shader **link = &state.shaders;
    while (*link != shader)
        link = &(*link)->next;
    *link = shader->next;
    gl_name_program(NULL);
    gl.DeleteProgram(shader->program);
    for (size_t i = 0; i < shader->source_count; i++) {
        free(shader->sources[i].name);
        free(shader->sources[i].path);
    }
    free(shader->sources);
    free(shader->stages);
    free(shader->head);
    free(shader);
}

int shader_reload_changed(char **error)
{
    int replaced = 0;
    bool any = false;
    *error = NULL;
    for (Shader *shader = state.shaders; shader && !any; shader = shader->next)
        any = changed(shader);
    for (Shader *shader = state.shaders; shader && any; shader = shader->next) {
        // One that failed is tried again with any other, so that its error is told while it stands.
        if (!shader->failed && !changed(shader))
            continue;
        char *message = build(shader);
        replaced += !message;
        if (*error)
            free(message);
        else
            *error = message;
    }
    return replaced;
}

int shader_reload_all(char **error)
{
    for (Shader *shader = state.shaders; shader; shader = shader->next)
        shader->sources->stamp = 0; // as if its first stage had changed
    return shader_reload_changed(error);
}

void shader_use(const Shader *shader)
{
    gl_name_program(shader->label);
    gl.UseProgram(shader->program);
}

GLuint shader_program(const Shader *shader)
{
    return shader->program;
}

// GL ignores location -1, which stands for a name that the program does not use.
#define SET(type, call, value, ...)                                                                          \
    void shader_set_##type(const Shader *shader, const char *name, value)                                    \
    {                                                                                                        \
        gl.ProgramUniform##call(shader->program, gl.GetUniformLocation(shader->program, name), __VA_ARGS__); \
    }
SET(int, 1i, int value, value)
SET(uint, 1ui, unsigned value, value)
SET(ivec3, 3iv, const int value[3], 1, value)
SET(float, 1f, float value, value)
SET(vec3, 3fv, const float value[3], 1, value)
SET(vec4, 4fv, const float value[4], 1, value)
SET(double, 1d, double value, value)
SET(dvec3, 3dv, const double value[3], 1, value)
SET(mat4, Matrix4fv, const float value[16], 1, GL_FALSE, value)
#define XY float x, float y
SET(vec2, 2f, XY, x, y)
