// What a wrong command says: exactly one line that names what is wrong and what would be right, the right exit status, and nothing
// lost or left behind. Every chapter's program runs as a user runs it: by a shell, from the build folder that the environment names.
#include "image.h"
#include "model.h"

#include <criterion/criterion.h>
#include <glob.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

static char folder[] = "/tmp/commands-XXXXXX"; // $T in the commands

typedef struct Outcome {
    int status; // of the shell: exit status, or 128 + signal
    char *output, *errors;
} Outcome;

// Run "before BUILD/program arguments". What it writes goes to files, so that no pipe can fill up; a redirection in `arguments` comes later and wins.
static Outcome run_command(const char *before, const char *program, const char *arguments)
{
    const char *build = getenv("BUILD");
    char *out = text_format("%s.out", folder), *err = text_format("%s.err", folder);
    char *command = text_format("%s %s/%s >%s 2>%s </dev/null %s", before, build ? build : "build", program,
                                out, err, arguments);
    int status = system(command);
    Outcome outcome = {.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
                       .output = file_read(out, NULL),
                       .errors = file_read(err, NULL)};
    unlink(out);
    unlink(err);
    free(out);
    free(err);
    free(command);
    return outcome;
}

static void outcome_free(Outcome *outcome)
{
    free(outcome->output);
    free(outcome->errors);
}

// The names, sizes and times of all that is in the test's folder.
static char *folder_listing(void)
{
    char *command = text_format("ls -lA --time-style=full-iso %s", folder), *text = NULL;
    size_t bytes = 0;
    FILE *from = popen(command, "r"), *to = open_memstream(&text, &bytes);
    for (int c; (c = fgetc(from)) != EOF;)
        fputc(c, to);
    fclose(to);
    pclose(from);
    free(command);
    return text;
}

static void file_write(const char *name, const char *text)
{
    char *path = text_format("%s/%s", folder, name);
    FILE *file = fopen(path, "w");
    fputs(text, file);
    fclose(file);
    free(path);
}

static void begin(void)
{
    cr_assert(mkdtemp(folder), "no folder in /tmp");
    setenv("T", folder, 1);
    unsetenv("DISPLAY"); // so that no window opens where a wrong command is not refused
    unsetenv("WAYLAND_DISPLAY");
}

static void end(void)
{
    cr_expect_eq(system("rm -rf \"$T\" \"$T.out\" \"$T.err\""), 0, "the temporary folder stays");
}

TestSuite(commands, .init = begin, .fini = end, .timeout = 120);

// The only line on stderr but for notes is the error: it begins with the program's name and holds the words.
static void one_line(const char *program, const char *arguments, const Outcome *got, const char *const *words)
{
    size_t lines = 0;
    const char *error = "";
    for (const char *line = got->errors; *line; line = strchr(line, '\n') + 1) {
        cr_assert(strchr(line, '\n'), "%s %s: an unfinished line: %s", program, arguments, line);
        if (strncmp(line + strcspn(line, ":"), ": note: ", 8) == 0)
            continue;
        error = line;
        lines++;
    }
    cr_assert_eq(lines, 1, "%s %s: %zu lines, not one: %s", program, arguments, lines, got->errors);
    size_t length = strlen(program);
    cr_assert(strncmp(error, program, length) == 0 && error[length] == ':', "does not name the program: %s",
              error);
    for (; *words; ++words)
        cr_assert(strstr(error, *words), "%s %s: '%s' is not in: %s", program, arguments, *words, error);
}

static void one_fails(const char *program, const char *before, const char *arguments, int status,
                      const char *const *words)
{
    char *there = folder_listing();
    Outcome got = run_command(before, program, arguments);
    cr_assert_eq(got.status, status, "%s %s: status %d, not %d: %s", program, arguments, got.status, status,
                 got.errors);
    one_line(program, arguments, &got, words);
    if (status == 2)
        cr_assert_str_eq(got.output, "", "%s %s: a refused request prints: %s", program, arguments,
                         got.output);
    char *left = folder_listing();
    cr_assert_str_eq(left, there, "%s %s: left a file or changed one:\n%s", program, arguments, left);
    free(there);
    free(left);
    outcome_free(&got);
}

static void for_each_program(void (*check)(const char *program))
{
    glob_t mains;
    cr_assert(glob("chapters/*/main.c", 0, NULL, &mains) == 0 && mains.gl_pathc > 0, "no chapter was found");
    for (size_t i = 0; i < mains.gl_pathc; i++) {
        char *program = text_format("%.*s", (int)strcspn(mains.gl_pathv[i] + 9, "/"), mains.gl_pathv[i] + 9);
        check(program);
        free(program);
    }
    globfree(&mains);
}

static struct {
    const char *before, *arguments, *const *words;
    int status;
} expected;
static void fails_as_expected(const char *program)
{
    one_fails(program, expected.before, expected.arguments, expected.status, expected.words);
}

static void expect_error(const char *before, const char *arguments, int status, const char *const *words)
{
    expected.before = before;
    expected.arguments = arguments;
    expected.words = words;
    expected.status = status;
    for_each_program(fails_as_expected);
}
#define WORDS(...) ((const char *const[]){__VA_ARGS__, NULL})

// Every case is a test of its own, so that the report names it.
#define WRONG(name, arguments, status, ...)                                                                  \
    Test(commands, name)                                                                                     \
    {                                                                                                        \
        expect_error("", arguments, status, WORDS(__VA_ARGS__));                                             \
    }
#define WRONG_FILE(name, file, text, ...)                                                                    \
    Test(commands, name)                                                                                     \
    {                                                                                                        \
        file_write(file, text);                                                                              \
        expect_error("", "--scene $T/" file " --out $T/never.png", 1, WORDS("/" file ": ", __VA_ARGS__));    \
    }

// --- models
#define SQUARE "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
WRONG(no_such_file, "--scene $T/nowhere.obj --out $T/never.png", 1, "/nowhere.obj: no such file")
WRONG(a_folder_for_a_model, "--scene ./tests --out $T/never.png", 1, "./tests: a directory")
WRONG_FILE(obj_cut_in_a_face, "face.obj", SQUARE "f 1 2 3\nf 1 3", "2 corners", "cut short")
WRONG_FILE(obj_cut_before_its_faces, "vertices.obj", SQUARE, "refused", "triangle")
WRONG_FILE(obj_that_names_a_vertex_it_has_not, "index.obj", SQUARE "f 1 2 7\n", "broken")
WRONG_FILE(gltf_of_no_bytes, "empty.gltf", "", "empty")
WRONG_FILE(gltf_cut_short, "cut.gltf", "{\"asset\": {\"version\": \"2.0\"}, \"meshes\": [{", "broken")
WRONG_FILE(a_file_of_another_kind, "notes.txt", "what is this?\n", ".obj, .gltf")
// NOLINTNEXTLINE(bugprone-suspicious-missing-comma): SQUARE and its faces are one text
WRONG_FILE(obj_with_a_nan_vertex, "nan.obj", "v nan 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n", "1", "vert", "NaN")

Test(commands, gltf_with_a_nan_or_infinite_vertex)
{
    model_write(folder, "nan", NAN);
    model_write(folder, "infinite", INFINITY);
    expect_error("", "--scene $T/nan.gltf --out $T/never.png", 1, WORDS("/nan.gltf: ", "1 ", "vert"));
    expect_error("", "--scene $T/infinite.gltf --out $T/never.png", 1, WORDS("/infinite.gltf: ", "vert"));
}

// --- words
WRONG(unknown_scene, "--scene sponza", 2, "--scene", "sponza", "cornell")
WRONG(unknown_option, "--sceen cornell", 2, "--sceen", "--scene")
WRONG(unknown_word, "cornell", 2, "cornell", "--help")
WRONG(unknown_parameter, "--set exposuer=3", 2, "--set", "exposuer", " exposure")
WRONG(unknown_step, "--step 99", 2, "--step 99", "1 to ")
WRONG(unknown_path, "--path zigzag", 2, "--path zigzag", "orbit")
WRONG(no_value, "--set exposure", 2, "--set exposure", "KEY=VALUE")
WRONG(no_argument, "--scene", 2, "--scene", "value")
WRONG(an_argument_too_many, "--plan=yes", 2, "--plan=yes", "no value")
WRONG(json_alone, "--json", 2, "--json", "--plan")
WRONG(wrong_ending, "--out $T/never.jpg", 2, "--out", "never.jpg", ".png")
WRONG(one_file_for_two_outputs, "--out $T/a.png --truth $T/a.png", 2, "--truth", "same file")
WRONG(shader_folder_missing, "--shaders $T/nowhere --out $T/never.png", 2, "--shaders", "/nowhere")

// --- numbers
WRONG(value_out_of_range, "--set exposure=1e9", 2, "exposure=1e9", "out of range", "-30 to 30")
WRONG(word_for_a_number, "--set exposure=bright", 2, "exposure=bright", "a number", "'bright'")
WRONG(number_with_a_tail, "--set exposure=1.5x", 2, "exposure=1.5x", "a number")
WRONG(not_a_number, "--set exposure=nan", 2, "exposure=nan", "a number")
WRONG(size_nothing, "--size 0x0", 2, "--size 0x0", "from 1", "512x512")
WRONG(size_too_large, "--size 100000x100000", 2, "--size 100000x100000", "to 16384")
WRONG(size_without_x, "--size 512", 2, "--size 512:", "512x512")
WRONG(size_negative, "--size -1x5", 2, "--size -1x5", "512x512")
WRONG(frames_none, "--frames 0", 2, "--frames 0", "from 1")
WRONG(frames_a_word, "--frames many", 2, "--frames many", "whole number")
WRONG(seed_negative, "--seed -1", 2, "--seed -1", "whole number")
WRONG(seed_too_large, "--seed 18446744073709551616", 2, "--seed 18446744073709551616", "18446744073709551615")
WRONG(eye_on_target, "--set eye=1,2,3 --set target=1,2,3 --out $T/never.png", 2, "eye", "target", "1,2,3")

// --- more than there is. Sides in range whose picture OpenGL cannot hold; a grid of 65536³ bits, 2^48 / 8 bytes.
// One program, since each would first ask for some 10 GB.
Test(commands, picture_too_large)
{
    one_fails("01_voxelization", "", "--size 16384x16384 --out $T/never.png", 1, WORDS("4294967296 bytes"));
}
Test(commands, grid_too_large)
{
    one_fails("01_voxelization", "", "--scene cornell --set resolution=65536 --out $T/never.png", 1,
              WORDS("65536 x 65536 x 65536", "35184372088832 bytes", "resolution"));
    one_fails("01_voxelization", "", "--scene cornell --set resolution=65537 --out $T/never.png", 2,
              WORDS("resolution=65537", "1 to 65536"));
    one_fails("01_voxelization", "", "--scene cornell --set resolution=64.5 --out $T/never.png", 2,
              WORDS("resolution=64.5", "whole number"));
}

// --- outputs that cannot be written
#define SMALL "--scene cornell --size 32x32 "
WRONG(output_in_no_folder, "--out $T/nowhere/never.png", 1, "/nowhere/never.png", "No such file or directory")
WRONG(output_to_a_folder, "--sweep $T", 1, "/commands-", "a folder")
WRONG(output_where_nobody_may_write, "--out /proc/never.png", 1, "/proc/never.png: cannot be written")
WRONG(full_standard_output_for_the_plan, SMALL "--plan >/dev/full", 1, "standard output")
WRONG(full_standard_output_for_json, SMALL "--plan --json >/dev/full", 1, "standard output")
WRONG(full_standard_output_for_help, "--help >/dev/full", 1, "standard output")
WRONG(full_standard_output_for_the_list, "--list >/dev/full", 1, "standard output")
WRONG(full_device_for_a_table, "--scene cornell --sweep /dev/full", 1, "/dev/full: cannot", "No space left")

Test(commands, full_device_for_a_picture)
{
    cr_assert_eq(system("ln -s /dev/full $T/full.exr"), 0, "no link");
    expect_error("", SMALL "--out $T/full.exr", 1, WORDS("cannot be written", "No space left"));
    expect_error("", SMALL "--truth $T/full.exr", 1, WORDS("cannot be written", "No space left"));
}

// A disk that fills up on the way: a file may grow to 512 bytes and no further. The way is long so that a table with its command in it, even one
// of a single row, is longer than that.
#define DOTS      "/./././././././././././././././."
#define LONG_WAY  DOTS DOTS DOTS DOTS DOTS DOTS DOTS DOTS "/"
#define FULL_DISK "trap '' XFSZ; ulimit -f 1; MESA_SHADER_CACHE_DISABLE=1"
Test(commands, full_disk_leaves_the_old_file_and_no_other)
{
    // so that the truth is kept, and its own file is not the one that cannot be written
    Outcome kept = run_command("", "01_voxelization", SMALL "--truth $T/truth.exr");
    cr_assert_eq(kept.status, 0, "%s", kept.errors);
    outcome_free(&kept);
    file_write("old.exr", "what was there before");
    file_write("old.csv", "what was there before");
    one_fails("01_voxelization", FULL_DISK, SMALL "--out $T/old.exr", 1,
              WORDS("/old.exr: cannot be written"));
    one_fails("01_voxelization", FULL_DISK, SMALL "--truth $T/old.exr", 1,
              WORDS("/old.exr: cannot be written"));
    one_fails("01_voxelization", FULL_DISK, "--size 8x8 --sweep $T" LONG_WAY "old.csv --row 1", 1,
              WORDS("/old.csv: cannot be written"));
    one_fails("01_voxelization", FULL_DISK, "--size 8x8 --stability $T" LONG_WAY "old.csv --row 1", 1,
              WORDS("/old.csv: cannot be written"));
    one_fails("01_voxelization", FULL_DISK, "--size 8x8 --sweep $T" LONG_WAY "new.csv --row 1", 1,
              WORDS("/new.csv: cannot be written"));
}

Test(commands, failed_and_interrupted_work_keep_the_old_file)
{
    file_write("old.csv", "what was there before");
    model_write(folder, "nan", NAN);
    expect_error("", "--scene $T/nan.gltf --sweep $T/old.csv", 1, WORDS("nan.gltf"));
    char *there = folder_listing();
    // a whole sweep takes far longer than two seconds
    Outcome got = run_command("timeout -s INT 2", "01_voxelization", "--sweep $T/old.csv");
    char *left = folder_listing();
    cr_assert_eq(got.status, 124, "the sweep ended before it was interrupted: status %d, %s", got.status,
                 got.errors);
    cr_assert_str_eq(left, there, "interrupted, it left a file or changed one:\n%s", left);
    free(there);
    free(left);
    outcome_free(&got);
}

// --- OpenGL
Test(commands, shader_that_does_not_compile)
{
    file_write("gbuffer.vert", "out vec2 unused;\n\nvoid main()\n{\n    float broken = ;\n}\n");
    expect_error("", SMALL "--shaders $T --out $T/never.png", 1, WORDS("/gbuffer.vert:5: ", "syntax"));
    file_write("gbuffer.vert", "void main()\n{\n    missing();\n}\n");
    expect_error("", SMALL "--shaders $T --out $T/never.png", 1, WORDS("/gbuffer.vert:3: ", "missing"));
}

Test(commands, no_gl_to_be_had)
{
    const char *arguments = SMALL "--out $T/never.png";
    expect_error("MESA_GL_VERSION_OVERRIDE=3.3", arguments, 1, WORDS("OpenGL 4.5", "OSMesa", "HEADLESS=egl"));
    expect_error("HEADLESS=egl __EGL_VENDOR_LIBRARY_FILENAMES=/nowhere", arguments, 1,
                 WORDS("OpenGL 4.5", "EGL"));
    expect_error("HEADLESS=vulkan", arguments, 2, WORDS("HEADLESS=vulkan", "osmesa or egl"));
    expect_error("DISPLAY=:987654", "--window", 1, WORDS("OpenGL 4.5", "display", ":987654"));
    expect_error("", "--window", 1, WORDS("OpenGL 4.5", "DISPLAY"));
}

// --- and what is right: one smoke test a program

static Image picture_of(const char *before, const char *program, const char *arguments)
{
    char *path = text_format("%s/picture.exr", folder),
         *all = text_format("%s --size 64x64 --out %s", arguments, path);
    Outcome got = run_command(before, program, all);
    cr_assert_eq(got.status, 0, "%s %s: status %d: %s", program, all, got.status, got.errors);
    Image image = image_read(path);
    outcome_free(&got);
    free(all);
    free(path);
    return image;
}

// EGL's surfaceless platform and OSMesa have the same rasterizer behind them: the same picture, to the last bit.
static void egl_picture_is_the_same(const char *program)
{
    Outcome pictures[] = {
        run_command("HEADLESS=osmesa", program, "--scene cornell --size 64x64 --out $T/osmesa.exr"),
        run_command("HEADLESS=egl", program, "--scene cornell --size 64x64 --out $T/egl.exr"),
        run_command("", "compare", "$T/egl.exr $T/osmesa.exr")};
    for (int i = 0; i < 3; i++)
        cr_assert(pictures[i].status == 0 && !*pictures[i].errors, "%s: %s", program, pictures[i].errors);
    cr_assert_str_eq(strchr(pictures[2].output, '\n'), "\n64,64,0,0,0,0,1,0\n", "%s", pictures[2].output);
    for (int i = 0; i < 3; i++)
        outcome_free(&pictures[i]);
}
Test(commands, egl_makes_the_same_picture)
{
    for_each_program(egl_picture_is_the_same);
}

Test(commands, a_gltf_brings_its_camera_and_lights)
{
    model_write(folder, "model", -0.25f);
    Image image = picture_of(
        "", "01_voxelization",
        "--scene $T/model.gltf --step mesh --set resolution=1"); // one voxel: lines at the edge only
    const int column = 10, row = 32, outside = 4;
    const double pixel = 2 * MODEL_HALF_VIEW / 64, x = (column + 0.5) * pixel - MODEL_HALF_VIEW,
                 y = MODEL_HALF_VIEW - (row + 0.5) * pixel, squared = 1 + x * x + y * y;
    const float *got = image.pixels + 3 * (row * 64 + column), *sky = got + 3 * (outside - column);
    cr_assert(x > -MODEL_HALF_WALL && x < -0.1, "the test looks beside the wall");
    // What the chapter calls ambient is in every channel, and in blue alone.
    const double brdf = MODEL_ALBEDO / M_PI, ambient = (double)got[2];
    // 1e-3: normal and albedo are half floats (2^-11), sums of three terms
    cr_expect_float_eq(ambient, 0.3 * MODEL_ALBEDO, 1e-3 * ambient, "blue is %g", ambient);
    const double red = brdf * MODEL_SUN_RED, green = brdf * MODEL_POINT_GREEN / squared / sqrt(squared);
    cr_expect_float_eq(got[0] - ambient, red, 1e-3 * red, "the sun gives %g, not %g", got[0] - ambient, red);
    cr_expect_float_eq(got[1] - ambient, green, 1e-3 * green, "the point gives %g, not %g", got[1] - ambient,
                       green);
    cr_expect(sky[0] + sky[1] + sky[2] == 0, "beside the wall is no sky: the camera is not the file's");
    image_free(&image);
}
