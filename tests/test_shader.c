// shader: includes, errors at the reader's own file and line, reload that never loses the last good program, uniforms.
// The files are written into a folder of their own and put first; each program is a compute shader that fills one buffer.
#include "shader.h"
#include "failure.h"

#include <criterion/criterion.h>
#include <sys/stat.h>

static char folder[] = "/tmp/test_shader_XXXXXX";

static void write_shader(const char *name, const char *text)
{
    char *path = text_format("%s/%s", folder, name);
    FILE *file = fopen(path, "w");
    cr_assert(file && fputs(text, file) >= 0 && fclose(file) == 0, "%s can be written", path);
    free(path);
}

static void open_folder(void)
{
    cr_assert(mkdtemp(folder), "a folder to test in");
    shader_search_first(folder);
}

static void open_all(void)
{
    open_folder();
    gl_open(gl_headless_platform(), 0, 0, NULL);
}

static void remove_folder(void)
{
    char *command = text_format("rm -r %s", folder);
    cr_assert_eq(system(command), 0, "%s", command);
    free(command);
}

static void close_all(void)
{
    gl_close();
    remove_folder();
}

#define HEAD                                                                                                 \
    "layout(local_size_x = 1) in;\nlayout(std430, binding = 0) buffer Result { double result[16]; };\n"
#define MAIN(statements) HEAD "void main()\n{\n    " statements "\n}\n"

// The first double that the program writes.
static double run(const Shader *shader)
{
    double result[16];
    GLuint buffer = gl_buffer(.label = "result", .bytes = sizeof result);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, buffer);
    shader_use(shader);
    gl.DispatchCompute(1, 1, 1);
    gl.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    gl_buffer_read(buffer, 0, sizeof result, result);
    gl_buffer_delete(&buffer);
    return result[0];
}

Test(shader, include_goes_in_once_at_any_depth, .init = open_all, .fini = close_all)
{
    write_shader("number.glsl", "double number() { return 7.0; }\n");
    write_shader("twice.glsl", "#include \"number.glsl\"\ndouble twice() { return 2.0 * number(); }\n");
    write_shader("a.comp", "#include \"number.glsl\"\n  # include \"common/twice.glsl\"\n"
                           "// #include \"missing.glsl\" in a comment is none\n" MAIN(
                               "result[0] = twice() + number();"));
    Shader *shader =
        shader_open("a", NULL, "a.comp"); // "common/twice.glsl" by its base name, as students keep it
    cr_assert_eq(run(shader), 21.0, "2 · 7 + 7");
    shader_close(shader);
}

Test(shader, include_goes_into_each_stage, .init = open_all, .fini = close_all)
{
    write_shader("half.glsl", "float half_of(float x) { return 0.5 * x; }\n");
    write_shader("a.vert", "#include \"half.glsl\"\nvoid main() { gl_Position = vec4(half_of(0.0)); }\n");
    write_shader("a.frag",
                 "#include \"half.glsl\"\nout float pixel;\nvoid main() { pixel = half_of(2.0); }\n");
    Shader *shader = shader_open("each", NULL, "a.vert", "a.frag"); // ends the program where one lacks it
    cr_assert_neq(shader_program(shader), 0, "linked");
    shader_close(shader);
}

Test(shader, definitions_and_EVERYTHING, .init = open_all, .fini = close_all)
{
    write_shader("a.comp", MAIN("result[0] = 100 * RESOLUTION + 10 * LIGHTS + EVERYTHING;"));
    Shader *bare = shader_open("bare", "RESOLUTION 64\nLIGHTS 2", "a.comp");
    cr_assert_eq(run(bare), 6420.0, "EVERYTHING is 0 unless defined");
    shader_define_all("EVERYTHING", 1);
    Shader *every = shader_open("every", "RESOLUTION 64\nLIGHTS 2\n", "a.comp");
    cr_assert_eq(run(every), 6421.0, "EVERYTHING is 1 in what is opened later");
    shader_close(bare);
    shader_close(every);
}

Test(shader, uniforms_of_every_kind_by_name, .init = open_all, .fini = close_all)
{
    write_shader("a.comp",
                 "uniform int i; uniform uint u; uniform ivec3 i3; uniform float f; uniform vec2 v2; uniform "
                 "vec3 v3;\n"
                 "uniform vec4 v4; uniform double d; uniform dvec3 d3; uniform mat4 m;\n" MAIN(
                     "result[0] = double(i) + u + i3.z + f + v2.y + v3.z + v4.w + d + d3.z + m[3][1];"));
    Shader *shader = shader_open("a", NULL, "a.comp");
    const float matrix[16] = {[13] = 512.0f}; // column 3, row 1
    shader_set_int(shader, "i", -1);
    shader_set_uint(shader, "u", 4000000000u);
    shader_set_ivec3(shader, "i3", (const int[]){0, 0, 4});
    shader_set_float(shader, "f", 8.0f);
    shader_set_vec2(shader, "v2", 0.0f, 16.0f);
    shader_set_vec3(shader, "v3", (const float[]){0, 0, 32});
    shader_set_vec4(shader, "v4", (const float[]){0, 0, 0, 64});
    shader_set_double(shader, "d", 0x1p-20); // lost if it went through a float beside 4 · 10⁹
    shader_set_dvec3(shader, "d3", (const double[]){0, 0, 256});
    shader_set_mat4(shader, "m", matrix);
    shader_set_float(shader, "no such name", 1.0f); // ignored
    cr_assert_eq(run(shader), 4000000000.0 - 1 + 4 + 8 + 16 + 32 + 64 + 0x1p-20 + 256 + 512, "each arrives");
    char label[64];
    gl.GetObjectLabel(GL_PROGRAM, shader_program(shader), sizeof label, NULL, label);
    cr_assert_str_eq(label, "a", "%s", label);
    shader_close(shader);
}

Test(shader, draws_the_same_triangle_by_osmesa_and_egl)
{
    static unsigned char pixels[2][64][64][4];
    for (int i = 0; i < 2; i++) {
        gl_open(i ? GL_PLATFORM_EGL : GL_PLATFORM_OSMESA, 0, 0, NULL);
        shader_search_first("tests/data/triangle");
        Shader *shader = shader_open("triangle", NULL, "triangle.vert", "triangle.frag");
        GLuint color = gl_texture(.label = "color", .format = GL_RGBA8, .width = 64, .height = 64);
        GLuint framebuffer = gl_framebuffer(.label = "color", .color = {color}), empty = 0;
        gl.ClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, (const float[4]){0});
        gl.CreateVertexArrays(1, &empty);
        gl.BindVertexArray(empty);
        gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        gl.Viewport(0, 0, 64, 64);
        shader_use(shader);
        gl.DrawArrays(GL_TRIANGLES, 0, 3);
        gl_texture_read(color, 0, GL_RGBA, GL_UNSIGNED_BYTE, sizeof pixels[i], pixels[i]);
        shader_close(shader);
        gl_close();
    }
    // Corners (−0.8, −0.8), (0.8, −0.8), (0, 0.8): area 1.28 of 4, so 0.32 · 64² = 1310.7 pixels; the border, 3 sides of
    // about 57 pixels, may fall either way by half a pixel.
    int covered = 0;
    for (int y = 0; y < 64; y++)
        for (int x = 0; x < 64; x++)
            covered += pixels[0][y][x][3] == 255;
    cr_assert(abs(covered - 1311) < 86, "%d pixels covered", covered);
    // Mean of the three corners' colours at the centroid (0, −0.267), pixel (32, 23): 85 each; a pixel's offset is worth
    // 255 / 51 = 5 a step.
    for (int c = 0; c < 3; c++)
        cr_assert(abs(pixels[0][23][32][c] - 85) <= 5, "channel %d is %d", c, pixels[0][23][32][c]);
    // Both are llvmpipe: the same code on the same numbers.
    cr_assert_eq(memcmp(pixels[0], pixels[1], sizeof pixels[0]), 0,
                 "OSMesa and EGL draw bit for bit the same");
}

// Each opens its context in the child that it ends: Mesa's threads do not survive a fork.
static void open_a_comp(void)
{
    gl_open(gl_headless_platform(), 0, 0, NULL);
    shader_open("label of a", NULL, "a.comp");
}
static void open_a_pair(void)
{
    gl_open(gl_headless_platform(), 0, 0, NULL);
    shader_open("label of the pair", NULL, "a.vert", "a.frag");
}
static void open_nothing(void)
{
    gl_open(gl_headless_platform(), 0, 0, NULL);
    shader_open("nothing", NULL, "01_none/missing.comp");
}
static void open_wrong_ending(void)
{
    gl_open(gl_headless_platform(), 0, 0, NULL);
    shader_open("wrong", NULL, "a.glsl");
}
static void search_nowhere(void)
{
    shader_search_first("/no/such/folder");
}

static void check_failure(void (*function)(void), int status, const char *text)
{
    Failure failure = failure_of(function);
    cr_assert_eq(failure.status, status, "status %d: %s", failure.status, failure.message);
    cr_assert(failure_says(&failure, text), "should say \"%s\": %s", text, failure.message);
}

Test(shader, error_names_the_readers_file_and_line, .init = open_folder, .fini = remove_folder)
{
    write_shader("a.comp", MAIN("result[0] = undeclared;"));
    char *at = text_format("%s/a.comp:5: error: `undeclared' undeclared", folder);
    check_failure(open_a_comp, 1, at);
    free(at);
}

Test(shader, error_in_an_included_file_and_after_it, .init = open_folder, .fini = remove_folder)
{
    write_shader("good.glsl", "// one\n// two\n// three\nconst int three = 3;\n");
    write_shader("bad.glsl", "// one\n#include \"good.glsl\"\nconst int four = nothing;\n");
    write_shader("a.comp", "// one\n#include \"bad.glsl\"\n" MAIN("result[0] = three;"));
    char *at = text_format("%s/bad.glsl:3: error: `nothing'", folder);
    check_failure(open_a_comp, 1, at);
    free(at);
    write_shader("a.comp", "// one\n#include \"good.glsl\"\n" MAIN("result[0] = nothing;"));
    at = text_format("%s/a.comp:7: error: `nothing'", folder);
    check_failure(open_a_comp, 1, at);
    free(at);
    write_shader("good.glsl", "const int three = 3;"); // no newline at its end
    check_failure(open_a_comp, 1, "a.comp:7: error: `nothing'");
    write_shader("a.comp", "#include \"good.glsl\"\n#error stop here\n" MAIN("result[0] = 1;"));
    check_failure(open_a_comp, 1, "a.comp:2: ");
}

Test(shader, error_of_files_that_are_not_there, .init = open_folder, .fini = remove_folder)
{
    write_shader("a.comp", "// one\n// two\n#include \"common/missing.glsl\"\n" MAIN("result[0] = 1;"));
    char *at = text_format("%s/a.comp:3: common/missing.glsl: No such file or directory (looked in %s, ",
                           folder, folder);
    check_failure(open_a_comp, 1, at);
    free(at);
    check_failure(open_nothing, 1, "01_none/missing.comp: No such file or directory");
    check_failure(open_wrong_ending, 1, "a.glsl: a stage's file ends in .vert");
    check_failure(search_nowhere, 2, "/no/such/folder: no such folder");
}

Test(shader, error_of_linking_names_the_program, .init = open_folder, .fini = remove_folder)
{
    write_shader("a.vert", "out vec3 color;\nvoid main() { gl_Position = vec4(0); color = vec3(1); }\n");
    write_shader("a.frag", "in vec2 color;\nout vec4 pixel;\nvoid main() { pixel = vec4(color, 0, 1); }\n");
    check_failure(open_a_pair, 1, "label of the pair: error: ");
}

Test(shader, a_file_that_includes_itself_ends, .init = open_all, .fini = close_all)
{
    write_shader("a.glsl", "#include \"b.glsl\"\nconst int a = 1;\n");
    write_shader("b.glsl", "#include \"a.glsl\"\nconst int b = 2;\n");
    write_shader("a.comp", "#include \"a.glsl\"\n" MAIN("result[0] = a + b;"));
    Shader *shader = shader_open("circle", NULL, "a.comp");
    cr_assert_eq(run(shader), 3.0, "each once");
    shader_close(shader);
}

// One reload: how many were replaced, and whether the error holds the text (NULL: there is none).
static void check_reload(int replaced, const char *text)
{
    char *error = NULL;
    int count = shader_reload_changed(&error);
    cr_assert_eq(count, replaced, "%d replaced, should be %d: %s", count, replaced, error);
    cr_assert(text ? error && strstr(error, text) : !error, "error '%s', should hold '%s'", error, text);
    free(error);
}

Test(shader, reload_keeps_the_last_good_program_and_recovers, .init = open_all, .fini = close_all)
{
    write_shader("value.glsl", "const double value = 1;\n");
    write_shader("a.comp", "#include \"value.glsl\"\n" MAIN("result[0] = value;"));
    write_shader("b.comp", MAIN("result[0] = 50;"));
    Shader *a = shader_open("a", NULL, "a.comp"), *b = shader_open("b", NULL, "b.comp");
    check_reload(0, NULL); // nothing has changed
    write_shader("value.glsl", "const double value = 22;\n");
    check_reload(1, NULL);
    cr_assert_eq(run(a), 22.0, "an included file was saved");
    write_shader("value.glsl", "const double value = oops;\n");
    check_reload(0, "value.glsl:1: error: `oops'");
    cr_assert_eq(run(a), 22.0, "the last good program stays");
    check_reload(0, NULL); // told once, not every frame
    write_shader("b.comp", MAIN("result[0] = 5000;"));
    check_reload(1, "value.glsl:1: error: `oops'"); // told again, for it still stands
    cr_assert_eq(run(b), 5000.0, "the other goes on");
    write_shader("value.glsl", "const double value = 333;\n");
    check_reload(1, NULL);
    cr_assert_eq(run(a), 333.0, "recovers");
    char *path = text_format("%s/value.glsl", folder);
    cr_assert_eq(unlink(path), 0, "as an editor does between");
    free(path);
    check_reload(0, "value.glsl: No such file");
    write_shader("value.glsl", "const double value = 4444;\n");
    check_reload(1, NULL);
    cr_assert_eq(run(a), 4444.0, "recovers when the file is back");
    char *error = NULL;
    cr_assert_eq(shader_reload_all(&error), 2, "all, changed or not");
    cr_assert_null(error, "%s", error);
    shader_close(a);
    shader_close(b);
}

Test(shader, students_file_hides_the_projects_own, .init = open_all, .fini = close_all)
{
    char *own = text_format("%s/own", folder);
    char *student = text_format("%s/student", folder);
    char *common = text_format("%s/own/shaders/common", folder);
    folder_make(common);
    folder_make(student);
    write_shader("own/shaders/common/value.glsl", "const int value = 1;\n");
    write_shader("own/shaders/common/a.comp", "#include \"common/value.glsl\"\n" MAIN("result[0] = value;"));
    cr_assert_eq(chdir(own), 0, "%s", own);
    shader_search_first(NULL);
    Shader *shader = shader_open("a", NULL, "common/a.comp");
    cr_assert_eq(run(shader), 1.0, "shaders/ of the working folder");
    shader_search_first(student);
    check_reload(0, NULL);
    write_shader("student/value.glsl",
                 "const int value = 2;\n"); // of the size and, by touch -r, the time of what it hides
    cr_assert_eq(system("touch -r shaders/common/value.glsl ../student/value.glsl"), 0, "touch");
    check_reload(1, NULL);
    cr_assert_eq(run(shader), 2.0, "the student's");
    shader_close(shader);
    cr_assert_eq(chdir("/"), 0, "out of the folder");
    free(own);
    free(student);
    free(common);
}
