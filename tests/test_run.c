// run: the command line, settings, frames, passes, plan and tables, on a chapter made up for it. Each command is a process of its own
// in an empty folder, as a user's would be; what the chapter met on its way is in `trace`.
#include "run.h"
#include <criterion/criterion.h>
#include <dirent.h>
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

// --- The chapter ------------------------------------------------------------------------------------------------------------
static void make_lit(Scene *scene, uint64_t seed)
{
    uint32_t grey = scene_add_material(scene, "grey", vec3_make(0.5f, 0.5f, 0.5f), vec3_make(0, 0, 0));
    mesh_add_quad(&scene->mesh, vec3_make(-1, 0, 1), vec3_make(2, 0, 0), vec3_make(0, 0, -2), grey);
    scene_add_light(scene, (Light){.kind = LIGHT_SPOT,
                                   .position = vec3_make(0, (float)seed, 2),
                                   .direction = vec3_make(0, -1, 0),
                                   .intensity = vec3_make(1, 1, 1),
                                   .half_angle_rad = 0.5f,
                                   .radius = 0.01f});
    scene_add_light(scene, (Light){.kind = LIGHT_DIRECTIONAL,
                                   .direction = vec3_make(0, -1, 0),
                                   .intensity = vec3_make(1, 1, 1)});
    scene->camera = (Camera){vec3_make(0, 1, 4), vec3_make(0, 0, 0), vec3_make(0, 1, 0), 0.5f, 0.1f, 100};
}

static void make_dark(Scene *scene, uint64_t seed)
{
    make_lit(scene, seed);
    scene->light_count = 0;
}

static const SceneKind own_scenes[] = {
    {"lit", "a quad, a spot and a sun", make_lit}, {"dark", "no light", make_dark}, {0}};
static const char *const scenes[] = {"lit", "dark", NULL};
static const RunParameter parameters[] = {
    {"method", "how", NULL, RUN_CHOICE, 0, 0, {0}, "raster exact"},
    {"resolution", "voxels a side", "voxels", RUN_INTEGER, 8, 512, {64}, NULL},
    {"alpha", "a share", NULL, RUN_NUMBER, 0, 1, {0.5}, NULL},
    {"shift", "a vector", "m", RUN_VECTOR, -1, 1, {0, 0.25, 0}, NULL},
    {"fault", "what goes wrong", NULL, RUN_CHOICE, 0, 0, {0}, "none nan silent count step"},
    {0}};
static const RunStep steps[] = {{"first", "rows"}, {"second", "the shader's"}, {"third", "the last"}, {0}};
static const RunRow sweep[] = {{"brute", NULL, "method=raster resolution=8", NULL},
                               {"brute", NULL, "method=raster resolution=16", NULL},
                               {"ours", "lit", "method=exact shift=0,0,1", "8x4"},
                               {0}};
static const RunRow stability[] = {
    {"fine", NULL, "method=exact", NULL}, {"rough", "dark", "method=raster", "16x16"}, {0}};
static RunAbout about = {.chapter = "99_fake",
                         .title = "Fake",
                         .shows = "nothing real",
                         .source = "none",
                         .uses = RUN_USES_CAMERA | RUN_USES_LIGHT | RUN_USES_MEDIUM,
                         .scenes = scenes,
                         .own_scenes = own_scenes,
                         .parameters = parameters,
                         .steps = steps,
                         .sweep = sweep,
                         .stability = stability};
static double checked[4][2] = {{1, 1.05}, {INFINITY, INFINITY}}; // expected, got; tolerance 0.1
static long checked_nonfinite;
static bool offers_truth = true;

// Rows from the bottom: 0, 1, 2, … in red, so that flipping shows; NaN in one pixel where asked.
static void fill_rows(GLuint picture, int width, int height, bool nan_pixel)
{
    float *pixels = calloc((size_t)(4 * width * height), sizeof *pixels);
    for (int i = 0; i < width * height; ++i)
        pixels[4 * i] = (float)(i / width);
    if (nan_pixel)
        pixels[4 * (width + 2) + 1] = NAN; // second row from the bottom, third pixel
    gl.TextureSubImage2D(picture, 0, 0, 0, width, height, GL_RGBA, GL_FLOAT, pixels);
    free(pixels);
}

static int chapter(int argc, char **argv, FILE *trace)
{
    shader_search_first(".");
    Run *run = run_open(&about, argc, argv);
    Shader *compute = shader_open("count", NULL, "fake.comp"),
           *draw = shader_open("draw", NULL, "fake.vert", "fake.frag");
    while (run_setting(run)) {
        int width = run_width(run), height = run_height(run);
        const char *row = run_case(run);
        vec3 shift = run_vector(run, "shift");
        fprintf(trace, "setting %s %s %s %d %g %g %dx%d\n", row ? row : "-", run_scene(run)->name,
                run_choice(run, "method"), run_integer(run, "resolution"), run_number(run, "alpha"),
                (double)shift[2], width, height);
        GLuint rows = gl_texture(.label = "rows", .format = GL_RGBA32F, .width = width, .height = height);
        GLuint shaded = gl_texture(.label = "shaded", .format = GL_RGBA32F, .width = width, .height = height);
        GLuint target = gl_framebuffer(.label = "shaded", .color = {shaded}), points = 0;
        gl.CreateVertexArrays(1, &points);
        bool exact = run_chosen(run, "method", "exact");
        while (run_frame(run)) {
            fprintf(trace, "frame %d\n", run_frame_number(run));
            if (run_pass_common(run, "map", true, NULL)) {
                usleep(3000);
                fill_rows(rows, width, height, run_chosen(run, "fault", "nan"));
            }
            run_step(run, "first", rows);
            if (run_pass(run, "refine", exact, "the \"raster\" method\tneeds none")) {
                usleep(2000);
                shader_use(compute);
                gl.BindImageTexture(0, shaded, 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA32F);
                gl.DispatchCompute(4, 1, 1);
                run_count(run, "fetches", run_chosen(run, "fault", "count") ? NAN : 5);
                run_count(run, "fetches", 2);
                run_skipped(run, 3, 8);
            }
            for (int i = 0; i < 2; ++i)
                if (run_pass(run, "draw", true, NULL)) {
                    fputs("draw\n", trace);
                    shader_use(draw);
                    gl.BindVertexArray(points);
                    gl.BindFramebuffer(GL_FRAMEBUFFER, target);
                    gl.Viewport(0, 0, width, height);
                    gl.DrawArrays(GL_TRIANGLES, 0, 3);
                }
            if (!run_chosen(run, "fault", "step"))
                run_step(run, "second", shaded);
            run_step(run, "third", rows);
            if (offers_truth && run_truth_wanted(run)) {
                Image truth = image_make(width, height, 3);
                // The picture stands still; the truth grows by 2 at odd frames and shrinks at even ones: every change differs by 2.
                for (int i = 0; i < 3 * width * height; ++i)
                    truth.pixels[i] = 2.0f * (float)(run_frame_number(run) % 2);
                fprintf(trace, "truth %d\n", run_frame_number(run));
                run_truth(run, &truth);
                image_free(&truth);
            }
            Camera camera = run_camera(run);
            const Scene *scene = run_scene(run);
            fprintf(trace, "eye %.4f %.4f %.4f target %.4f %.4f %.4f\n", (double)camera.eye[0],
                    (double)camera.eye[1], (double)camera.eye[2], (double)camera.target[0],
                    (double)camera.target[1], (double)camera.target[2]);
            if (scene->light_count)
                fprintf(trace, "light %.4f %.4f %.4f cone %.4f\n", (double)scene->lights[0].position[0],
                        (double)scene->lights[0].position[1], (double)scene->lights[0].position[2],
                        (double)scene->lights[0].half_angle_rad);
            fprintf(trace, "far %g\n", (double)camera.far_distance);
        }
        if (run_measuring_error(run) && !run_chosen(run, "fault", "silent"))
            run_error(run, "converged", "wrong", 1.0 / run_integer(run, "resolution"));
        for (int i = 0; i < 2 && run_checking(run); ++i)
            run_check(run, i ? "limit, far" : "ratio", checked[i][0], checked[i][1], 0.1, checked_nonfinite);
        gl_framebuffer_delete(&target);
        gl_texture_delete(&rows);
        gl_texture_delete(&shaded);
        gl.DeleteVertexArrays(1, &points);
    }
    shader_close(compute);
    shader_close(draw);
    return run_close(run);
}

// --- A command and what came of it -------------------------------------------------------------------------------------------
typedef struct Outcome {
    int status;
    char *out, *error, *trace;
} Outcome;

static void file_put(const char *path, const char *text)
{
    FILE *file = fopen(path, "w");
    cr_assert(file, "%s: cannot be written", path);
    fputs(text, file);
    fclose(file);
}

// What the child itself registers to run at exit has run before this; the rest (threads of libraries, Criterion's own) is its parent's and
// would wait for threads that a fork does not copy.
static void leave(int status, void *unused)
{
    (void)unused;
    fflush(NULL);
    _exit(status);
}

static Outcome command(const char *line)
{
    char *words = strdup(line), *state = NULL, *argv[40] = {"99_fake"};
    int argc = 1;
    for (char *word = strtok_r(words, " ", &state); word && argc < 39; word = strtok_r(NULL, " ", &state))
        argv[argc++] = word;
    fflush(NULL);
    pid_t child = fork();
    if (child == 0) {
        on_exit(leave, NULL);
        if (!freopen(".stdout", "w", stdout) || !freopen(".stderr", "w", stderr))
            _exit(99);
        program_invocation_short_name = argv[0];
        FILE *trace = fopen(".trace", "w");
        setvbuf(trace, NULL, _IOLBF, 0);
        exit(chapter(argc, argv, trace));
    }
    int status = 0;
    waitpid(child, &status, 0);
    cr_assert(WIFEXITED(status), "%s: died of signal %d", line, WTERMSIG(status));
    char *trace = file_read(".trace", NULL);
    free(words);
    return (Outcome){WEXITSTATUS(status), file_read(".stdout", NULL), file_read(".stderr", NULL), trace};
}

static void into_empty_folder(void)
{
    char folder[] = "/tmp/test_run_XXXXXX";
    cr_assert(mkdtemp(folder) && chdir(folder) == 0, "no folder");
    unsetenv("DISPLAY");
    unsetenv("WAYLAND_DISPLAY");
    file_put("fake.comp",
             "layout(local_size_x = 8) in;\nlayout(rgba32f, binding = 0) uniform writeonly image2D picture;\n"
             "void main() { imageStore(picture, ivec2(gl_GlobalInvocationID.xy), vec4(EVERYTHING)); }\n");
    file_put(
        "fake.vert",
        "void main() { gl_Position = vec4(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1, 0, 1); }\n");
    file_put("fake.frag", "out vec4 color;\nvoid main() { color = vec4(0, 1 + EVERYTHING, 0, 1); }\n");
}

static void out_of_it(void)
{
    char folder[] = "/tmp/test_run_XXXXXX";
    if (getcwd(folder, sizeof folder) && strncmp(folder, "/tmp/test_run_", 14) == 0) {
        char *remove_all = text_format("rm -rf %s", folder);
        cr_assert(chdir("/") == 0 && system(remove_all) == 0, "%s", remove_all);
        free(remove_all);
    }
}

TestSuite(run, .init = into_empty_folder, .fini = out_of_it, .timeout = 60);

static void expect(const char *line, int status, const char *error)
{
    Outcome got = command(line);
    cr_expect_eq(got.status, status, "'%s' ended with %d, not %d: %s", line, got.status, status, got.error);
    cr_expect_str_eq(got.error, error, "'%s' said\n%snot\n%s", line, got.error, error);
}

// --- The command line ---------------------------------------------------------------------------------------------------------
// Everything wrong is one line that names it and what would be right, status 2, and no work begun (no trace of a setting).
#define PARAMETERS                                                                                           \
    "method resolution alpha shift fault eye target fov_deg light light_position light_direction "           \
    "light_intensity light_half_angle_deg "                                                                  \
    "scattering absorption mean_cosine exposure"

Test(run, wrong_request_is_one_exact_line)
{
    static const char *const wrong[][2] = {
        {"--sise 3x3", "--sise: no such option; the nearest is --size, --help lists all"},
        {"--outt=x.png", "--outt=x.png: no such option; the nearest is --out, --help lists all"},
        {"-x", "-x: no such option; the nearest is --set, --help lists all"},
        {"--plan -xy", "-xy: no such option; the nearest is --set, --help lists all"},
        {"-xy", "-xy: no such option; the nearest is --set, --help lists all"},
        {"--size=8x8 -xy --plan", "-xy: no such option; the nearest is --set, --help lists all"},
        {"--plan --=", "--=: no such option; the nearest is --set, --help lists all"},
        {"--size", "--size: a value is needed, as --size WxH"},
        {"--plan=yes", "--plan=yes: --plan takes no value"},
        {"picture.png", "picture.png: not an option, they begin with --; --help lists them"},
        {"--size 0x0", "--size 0x0: WIDTHxHEIGHT is needed, each a whole number from 1 to 16384, as 512x512"},
        {"--size 100000x100000",
         "--size 100000x100000: WIDTHxHEIGHT is needed, each a whole number from 1 to 16384, as 512x512"},
        {"--size 64", "--size 64: WIDTHxHEIGHT is needed, each a whole number from 1 to 16384, as 512x512"},
        {"--size -64x64",
         "--size -64x64: WIDTHxHEIGHT is needed, each a whole number from 1 to 16384, as 512x512"},
        {"--size 64x64x64",
         "--size 64x64x64: WIDTHxHEIGHT is needed, each a whole number from 1 to 16384, as 512x512"},
        {"--frames 0", "--frames 0: a whole number from 1 to 1000000 is needed"},
        {"--frames many", "--frames many: a whole number from 1 to 1000000 is needed"},
        {"--seed -1", "--seed -1: a whole number from 0 to 18446744073709551615 is needed"},
        {"--seed 18446744073709551616",
         "--seed 18446744073709551616: a whole number from 0 to 18446744073709551615 is needed"},
        {"--step fourth", "--step fourth: no such step; 1 to 3 or one of: first second third"},
        {"--step 0", "--step 0: no such step; 1 to 3 or one of: first second third"},
        {"--path circle", "--path circle: not one of: subpixel orbit light deform"},
        {"--path deform --out a.png", "--path deform: nothing deforms in this chapter"},
        {"--set resolution", "--set resolution: KEY=VALUE is needed; --list names the keys"},
        {"--set colour=1", "--set colour=1: no such parameter; there are: " PARAMETERS},
        {"--set resolution=abc",
         "--set resolution=abc: a whole number from 8 to 512 voxels is needed where 'abc' stands"},
        {"--set resolution=8.5",
         "--set resolution=8.5: a whole number from 8 to 512 voxels is needed where '8.5' stands"},
        {"--set resolution=1024", "--set resolution=1024: out of range, 8 to 512 voxels"},
        {"--set resolution=",
         "--set resolution=: a whole number from 8 to 512 voxels is needed where '' stands"},
        {"--set alpha=nan", "--set alpha=nan: a number from 0 to 1 is needed where 'nan' stands"},
        {"--set alpha=0.5m", "--set alpha=0.5m: a number from 0 to 1 is needed where '0.5m' stands"},
        {"--set alpha=1e999", "--set alpha=1e999: a number from 0 to 1 is needed where '1e999' stands"},
        {"--set shift=1,2", "--set shift=1,2: three numbers are needed, as 1,2,3"},
        {"--set shift=0,b,0", "--set shift=0,b,0: a number from -1 to 1 m is needed where 'b' stands"},
        {"--set shift=0,0,2", "--set shift=0,0,2: out of range, -1 to 1 m"},
        {"--set method=exac", "--set method=exac: not one of: raster exact"},
        {"--json", "--json: goes with --plan only"},
        {"--sweep a.csv --out b.png", "--out: does not go with --sweep or --stability, which write tables"},
        {"--sweep a.csv --plan",
         "--plan: does not go with --sweep or --stability; give one setting by --set"},
        {"--sweep a.csv --stability a.csv", "--stability a.csv: --sweep goes to the same file"},
        {"--out a.exr --truth a.exr", "--truth a.exr: --out goes to the same file"},
        {"--window --truth t.exr", "--truth: does not go with --window; use --out beside it"},
        {"--sweep a.csv --frames 3", "--frames: with --sweep it needs --path"},
        {"--sweep a.csv --set method=raster --set resolution=99",
         "--sweep: --set or --scene leaves no row of this chapter's sweep"},
        {"--out a%s.png",
         "--out a%s.png: one %d or %04d stands for the frame's number, nothing else may follow a %"},
        {"--out a%d%n.png",
         "--out a%d%n.png: one %d or %04d stands for the frame's number, nothing else may follow a %"},
        {"--out a%0d.png",
         "--out a%0d.png: one %d or %04d stands for the frame's number, nothing else may follow a %"},
        {"--shaders nowhere --plan", "--shaders nowhere: no such folder"},
        {"--plan --size 8x8 --set eye=1,2,3 --set target=1,2,3",
         "--set eye, target: both are at 1,2,3; they must differ"},
        {"--plan --size 8x8 --set light_direction=0,0,0",
         "--set light_direction: 0,0,0 points nowhere; a vector with a length is needed"},
        {"--plan --size 8x8 --set light=1 --set light_position=1,2,3",
         "--set light_position: scene lit cannot take it: a directional light has no position (it has 2 "
         "lights)"},
        {"--plan --size 8x8 --set light=1 --set light_half_angle_deg=20",
         "--set light_half_angle_deg: scene lit cannot take it: only a spot light has a cone (it has 2 "
         "lights)"},
        {"--plan --size 8x8 --set light=2",
         "--set light: scene lit cannot take it: the scene has no such light (it has 2 lights)"},

    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
        char *error = text_format("99_fake: %s\n", wrong[i][1]);
        expect(wrong[i][0], 2, error);
        free(error);
    }
}

static size_t count_of(const char *text, const char *part)
{
    size_t count = 0;
    for (const char *at = text; (at = strstr(at, part)); at += strlen(part))
        ++count;
    return count;
}

// The command did its work; everything that it said on the way.
static Outcome done(const char *line)
{
    Outcome got = command(line);
    cr_assert_eq(got.status, 0, "'%s' ended with %d: %s", line, got.status, got.error);
    return got;
}

static bool there(const char *path)
{
    return access(path, F_OK) == 0;
}

// Files of the working folder beside those that every command makes.
static int files_written(void)
{
    DIR *folder = opendir(".");
    int count = 0;
    for (struct dirent *entry; (entry = readdir(folder));)
        count += !strstr(" . .. .stdout .stderr .trace fake.comp fake.vert fake.frag ", entry->d_name);
    closedir(folder);
    return count;
}

Test(run, unknown_scene_lists_the_scenes)
{
    Outcome got = command("--scene kitchen --out a.exr");
    cr_assert_eq(got.status, 2, "status %d", got.status);
    cr_assert(
        strstr(got.error, "--scene kitchen: no such scene; a file with its ending, or one of: lit dark "),
        "%s", got.error);
    cr_assert(strstr(got.error, " cornell"), "the built-in scenes are not listed: %s", got.error);
    cr_assert_eq(count_of(got.error, "\n"), 1, "not one line: %s", got.error);
}

Test(run, list_is_lines_of_fields_between_tabs)
{
    Outcome got = done("--list");
    static const char *const lines[] = {"chapter\t99_fake\tFake\n",
                                        "default\tlit\ndefault\tdark\n",
                                        "scene\tlit\ta quad, a spot and a sun\n",
                                        "step\t2\tsecond\tthe shader's\n",
                                        "parameter\tmethod\traster exact\traster\thow\n",
                                        "parameter\tresolution\t8..512 voxels\t64\tvoxels a side\n",
                                        "parameter\tshift\tx,y,z -1..1 m\t0,0.25,0\ta vector\n",
                                        "parameter\teye\tx,y,z -1e+08..1e+08 m\tscene\t",
                                        "parameter\tlight\t0..1e+06\t0\t"};
    for (size_t i = 0; i < sizeof lines / sizeof *lines; ++i)
        cr_expect(strstr(got.out, lines[i]), "no line '%s' in\n%s", lines[i], got.out);
    cr_assert_str_eq(got.trace, "", "work was begun");
}

Test(run, help_names_every_option_and_parameter)
{
    Outcome got = done("--out nowhere/a.png --help");
    static const char *const words[] = {
        "--scene",  "--size",      "--step", "--set",      "--out",        "--window",    "--truth",
        "--sweep",  "--stability", "--plan", "--json",     "--everything", "--shaders",   "--list",
        "--frames", "--seed",      "--path", "resolution", "exposure",     "nothing real"};
    for (size_t i = 0; i < sizeof words / sizeof *words; ++i)
        cr_expect(strstr(got.out, words[i]), "no %s in\n%s", words[i], got.out);
}

Test(run, picture_is_written_top_row_first)
{
    Outcome got = done("--size 8x4 --out a.exr --set resolution=9 --set resolution=12");
    cr_assert(strstr(got.trace, "setting - lit raster 12 0.5 0 8x4\nframe 0\n"), "%s", got.trace);
    cr_assert_eq(count_of(got.trace, "frame"), 1, "one frame is rendered: %s", got.trace);
    Image image = image_read("a.exr");
    cr_assert(image.width == 8 && image.height == 4, "%dx%d", image.width, image.height);
    for (int y = 0; y < 4; ++y) // the chapter numbers rows from the bottom
        cr_expect_eq(image.pixels[y * 8 * image.channels], (float)(3 - y), "row %d", y);
    cr_assert_eq(files_written(), 1, "a temporary file was left");
}

Test(run, value_that_is_not_finite_is_an_error_and_no_file)
{
    // Row 1 from the bottom is row 2 from the top of 4.
    expect("--size 8x4 --out a.exr --set fault=nan", 1,
           "99_fake: --out a.exr: 1 of 96 values are NaN or Inf, the first at pixel 2,2 from the top left\n");
    cr_assert_eq(files_written(), 0, "something was left");
}

Test(run, step_shows_its_picture_and_stops_what_follows)
{
    Outcome first = done("--size 8x4 --out first.exr --step first --set method=exact"),
            second = done("--size 8x4 --out second.exr --step 2");
    cr_assert_eq(count_of(first.trace, "draw"), 0, "a pass ran after the step");
    cr_assert_eq(count_of(second.trace, "draw"), 2, "the passes before the step ran");
    cr_assert_eq(image_read("first.exr").pixels[0], 3.0f, "the first step's picture: rows");
    cr_assert_eq(image_read("second.exr").pixels[1], 1.0f, "the second's: green by the shader");
    expect("--size 8x4 --out a.exr --step second --set fault=step", 2,
           "99_fake: --step second: this setting does not come to it\n");
}

Test(run, frames_go_to_numbered_files_or_the_last_to_one)
{
    Outcome got = done("--size 8x4 --frames 3 --out a%02d.exr");
    cr_assert_eq(count_of(got.trace, "frame"), 3, "%s", got.trace);
    cr_assert(there("a00.exr") && there("a01.exr") && there("a02.exr") && files_written() == 3,
              "three files");
    done("--size 8x4 --frames 3 --out last.exr");
    cr_assert(there("last.exr") && files_written() == 4, "one more");
}

Test(run, path_moves_camera_or_light_and_nothing_else)
{
    Outcome still = done("--size 8x8 --frames 2 --out a.exr"),
            pixel = done("--size 8x8 --frames 9 --path subpixel --out a.exr");
    Outcome orbit = done("--size 8x8 --frames 2 --path orbit --out a.exr"),
            light = done("--size 8x8 --frames 46 --path light --out a.exr");
    const char *eye = "eye 0.0000 1.0000 4.0000 target 0.0000 0.0000 0.0000";
    cr_assert_eq(count_of(still.trace, eye), 2, "%s", still.trace);
    // Frame 8 is one pixel to the right: at distance √17 and fov 0.5 a pixel is 2·√17·tan(0.25)/8 = 0.2632 m.
    cr_assert(strstr(pixel.trace, "eye 0.2632 "), "%s", pixel.trace);
    cr_assert_eq(count_of(pixel.trace, eye), 1, "only frame 0 stands still");
    cr_assert_eq(count_of(orbit.trace, eye), 1, "only frame 0 stands still");
    cr_assert_eq(count_of(orbit.trace, "target 0.0000 0.0000 0.0000"), 2, "an orbit keeps its target");
    // Frame 45 has turned by 90° about y through the box's centre, the origin: (0, 1, 2) goes to (2, 1, 0).
    cr_assert(strstr(light.trace, "light 2.0000 1.0000 0.0000"), "%s", light.trace);
    cr_assert_eq(count_of(light.trace, eye), 46, "the camera stands still");
}

Test(run, common_parameters_reach_the_scene)
{
    Outcome got = done("--size 8x8 --out a.exr --seed 3 --set light_half_angle_deg=45 --set eye=0,0,1000");
    cr_assert(strstr(got.trace, "light 0.0000 3.0000 2.0000 cone 0.7854"), "seed and cone: %s", got.trace);
    cr_assert(strstr(got.trace, "eye 0.0000 0.0000 1000.0000 target 0.0000 0.0000 0.0000"), "%s", got.trace);
    // The far plane, 100 in the scene, now holds the whole quad (half diagonal √2).
    cr_assert(strstr(got.trace, "far 1001.41"), "%s", got.trace);
}

Test(run, no_display_and_no_wish_writes_a_picture_and_says_so)
{
    expect(
        "--size 8x4", 0,
        "99_fake: note: no display: the picture goes to out/99_fake.png; --help lists what else there is\n");
    cr_assert(there("out/99_fake.png"), "it is there");
}

Test(run, unwritable_output_is_found_before_the_work)
{
    static const char *const lines[] = {"--out nowhere/a.png", "--truth nowhere/a.exr",
                                        "--sweep nowhere/a.csv", "--stability nowhere/a.csv", "--out ."};
    for (size_t i = 0; i < sizeof lines / sizeof *lines; ++i) {
        Outcome got = command(lines[i]);
        cr_expect(got.status != 0 && count_of(got.error, "\n") == 1, "'%s': %d, %s", lines[i], got.status,
                  got.error);
        cr_expect(strstr(got.error, strchr(lines[i], ' ') + 1), "the path is not named: %s", got.error);
        cr_expect_eq(count_of(got.trace, "setting"), 0, "work was begun");
    }
    cr_assert_eq(command("--out a.jpg").status, 2,
                 "an ending that is neither .exr nor .png is a wrong request");
    cr_assert_eq(files_written(), 0, "something was left");
}

Test(run, truth_is_written_or_missed)
{
    Outcome got = done("--size 8x4 --frames 2 --truth t.exr");
    cr_assert(strstr(got.trace, "truth 1\n") && count_of(got.trace, "truth ") == 1,
              "asked once, in the last frame: %s", got.trace);
    cr_assert_eq(image_read("t.exr").pixels[0], 2.0f, "what the chapter gave");
    offers_truth = false;
    expect("--size 8x4 --truth u.exr", 1,
           "99_fake: --truth u.exr: this setting has no truth, nothing was written\n");
    cr_assert(!there("u.exr"), "nothing is written");
}

Test(run, shaders_of_a_student_are_taken_first)
{
    cr_assert_eq(mkdir("mine", 0777), 0, "a folder");
    file_put("mine/fake.frag", "out vec4 color;\nvoid main() { color = vec4(0, 7, 0, 1); }\n");
    file_put(
        "mine/fake.vert",
        "void main() { gl_Position = vec4(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1, 0, 1); }\n");
    file_put("mine/fake.comp", "layout(local_size_x = 8) in;\nvoid main() {}\n");
    done("--size 8x4 --out a.exr --step second --shaders mine");
    cr_assert_eq(image_read("a.exr").pixels[1], 7.0f, "the shader in mine/");
}

// --- Passes and the plan --------------------------------------------------------------------------------------------------------
// The text with # for every number of ms and fragments, for comparison.
static char *without_measured(const char *text)
{
    char *copy = strdup(text), *to = copy;
    for (const char *from = text; *from;) {
        size_t key = strncmp(from, "ms\": ", 5) == 0 ? 5 : strncmp(from, "fragments\": ", 12) == 0 ? 12 : 0;
        memcpy(to, from, key ? key : 1);
        to += key ? key : 1;
        from += key ? key : 1;
        if (key) {
            *to++ = '#';
            from += strspn(from, "0123456789.");
        }
    }
    *to = '\0';
    return copy;
}

Test(run, plan_as_json_is_exactly_the_documented_object)
{
    Outcome got = done("--plan --json --size 16x16");
    // One triangle over the picture, drawn twice under one name.
    cr_assert_str_eq(without_measured(got.out),
                     "{\"chapter\": \"99_fake\", \"scene\": \"lit\", \"passes\": [\n"
                     "  {\"name\": \"map\", \"ran\": true, \"ms\": #, \"skipped\": 0, \"of\": 0, \"counts\": "
                     "{}, \"reason\": null},\n"
                     "  {\"name\": \"refine\", \"ran\": false, \"ms\": #, \"skipped\": 0, \"of\": 0, "
                     "\"counts\": {}, \"reason\": \"the "
                     "\\\"raster\\\" method\\u0009needs none\"},\n"
                     "  {\"name\": \"draw\", \"ran\": true, \"ms\": #, \"skipped\": 0, \"of\": 0, "
                     "\"counts\": {\"fragments\": #, "
                     "\"primitives\": 2}, \"reason\": null}],\n \"total_ms\": #}\n",
                     "%s", got.out);
    // 2 · 16² fragments; the renderer counts whole blocks of 4×4, and those on the seam where it cut the triangle twice: below 1.5 times.
    double fragments = atof(strstr(got.out, "fragments\": ") + 12);
    cr_assert(fragments >= 512 && fragments < 768, "%s", got.out);
    // Two frames of warm-up, then the one that is listed; the chapter sleeps 3 ms in the map.
    cr_assert_eq(count_of(got.trace, "frame 0"), 3, "%s", got.trace);
    cr_assert_geq(atof(strstr(got.out, "\"ms\": ") + 6), 3.0, "the map's ms: %s", got.out);
    cr_assert_eq(atof(strstr(strstr(got.out, "refine"), "\"ms\": ") + 6), 0.0,
                 "a pass left out takes no time: %s", got.out);
}

Test(run, everything_runs_what_is_needless_and_marks_it)
{
    Outcome plan = done("--plan --json --size 16x16 --everything"),
            text = done("--plan --everything --size 16x16");
    cr_assert(strstr(without_measured(plan.out),
                     "{\"name\": \"refine\", \"ran\": true, \"ms\": #, \"skipped\": 3, \"of\": 8, "
                     "\"counts\": {\"fetches\": 7, "
                     "\"compute_invocations\": 32}, \"reason\": \"the \\\"raster\\\" method"),
              "4 groups of 8 ran, and the reason is kept: %s", plan.out);
    cr_assert_geq(atof(strstr(strstr(plan.out, "refine"), "\"ms\": ") + 6), 2.0, "its ms: %s", plan.out);
    cr_assert(strstr(text.out, "[needless: the \"raster\" method") && strstr(text.out, "3 of 8 left out") &&
                  strstr(text.out, "fetches=7"),
              "%s", text.out);
    done("--size 8x4 --out a.exr --step second --everything");
    cr_assert_eq(image_read("a.exr").pixels[1], 2.0f, "shaders see EVERYTHING 1");
    Outcome exact = done("--plan --size 16x16 --set method=exact");
    cr_assert(!strstr(exact.out, "needs none"), "needed: nothing to mark: %s", exact.out);
}

Test(run, count_that_is_not_a_number_is_refused)
{
    expect("--plan --size 16x16 --set method=exact --set fault=count", 1,
           "99_fake: pass 'refine': its count of fetches is not a finite number\n");
}

// --- Tables -----------------------------------------------------------------------------------------------------------------------
// The CSV without its comments, which must be there.
static char *rows_of(const char *path)
{
    char *text = file_read(path, NULL), *rows = text;
    cr_assert(text, "%s was not written", path);
    while (*rows == '#')
        rows = strchr(rows, '\n') + 1;
    cr_assert(rows > text, "no machine line in\n%s", text);
    return rows;
}

static char *line_of(char *text, int index) // without its end
{
    while (index--)
        text = strchr(text, '\n') + 1;
    return text_format("%.*s", (int)strcspn(text, "\n"), text);
}

Test(run, sweep_runs_every_row_on_its_scenes_and_writes_medians)
{
    Outcome got = done("--size 8x8 --sweep s.csv --set alpha=0.25");
    static const char *const settings[] = {
        "setting brute lit raster 8 0.25 0 8x8\n", "setting brute dark raster 8 0.25 0 8x8\n",
        "setting brute lit raster 16 0.25 0 8x8\n", "setting brute dark raster 16 0.25 0 8x8\n",
        "setting ours lit exact 64 0.25 1 8x4\n"};
    const char *at = got.trace;
    for (int i = 0; i < 5; ++i, ++at) {
        at = strstr(at, settings[i]);
        cr_assert(at, "%s is not there, or not in order:\n%s", settings[i], got.trace);
    }
    cr_assert_eq(count_of(got.trace, "setting "), 5, "five settings: %s", got.trace);
    cr_assert_eq(count_of(got.trace, "frame 0\n"), 5 * 9,
                 "two frames of warm-up and seven repeats, all of frame 0");
    char *rows = rows_of("s.csv");
    cr_assert_str_eq(line_of(rows, 0),
                     "chapter,technique,scene,width,height,settings,ms_technique,ms_min,ms_max,ms_frame,"
                     "reference,metric,error",
                     "the header");
    cr_assert_eq(count_of(rows, "\n"), 6, "%s", rows);
    double ms[4];
    char *ours = line_of(rows, 5), tail[64];
    cr_assert_eq(sscanf(ours,
                        "99_fake,ours,lit,8,4,\"method=exact;alpha=0.25;shift=0,0,1\",%lf,%lf,%lf,%lf,%63s",
                        ms, ms + 1, ms + 2, ms + 3, tail),
                 5, "%s", ours);
    cr_assert_str_eq(tail, "converged,wrong,0.015625", "%s", ours);
    // The chapter sleeps 2 ms in its own pass and 3 in the map; a sleep is never shorter.
    cr_assert(ms[1] >= 2 && ms[1] <= ms[0] && ms[0] <= ms[2], "min, median, max: %s", ours);
    cr_assert_geq(ms[3], ms[1] + 3, "the frame holds the map too: %s", ours);
    cr_assert(strstr(line_of(rows, 1), "99_fake,brute,lit,8,8,method=raster;resolution=8;alpha=0.25,"), "%s",
              rows);
}

Test(run, set_and_scene_leave_out_rows_that_say_otherwise)
{
    Outcome got = done("--size 8x8 --sweep s.csv --set resolution=16 --scene dark");
    cr_assert_eq(count_of(got.trace, "setting "), 1, "%s", got.trace);
    cr_assert(strstr(got.trace, "setting brute dark raster 16 "), "%s", got.trace);
}

Test(run, row_that_measures_nothing_is_an_error)
{
    expect("--size 8x8 --sweep s.csv --set fault=silent", 1,
           "99_fake: sweep row brute, scene lit: nothing was measured\n");
    cr_assert_eq(files_written(), 0, "no half table");
}

Test(run, flicker_is_the_change_that_the_truth_does_not_make)
{
    Outcome got = done("--size 8x8 --sweep s.csv --path orbit --frames 4 --scene lit --set method=exact");
    // The picture stands still while the truth steps by ±2 in every value: rms 2 exactly.
    cr_assert(strstr(line_of(rows_of("s.csv"), 1), ",truth,flicker,2"), "%s", rows_of("s.csv"));
    cr_assert_eq(count_of(got.trace, "truth "), 4, "one truth a frame: %s", got.trace);
    cr_assert_eq(count_of(got.trace, "frame 0\n"), 10, "nine measured, then the path's own first");
    offers_truth = false;
    expect("--size 8x8 --sweep t.csv --path orbit --set method=exact", 2,
           "99_fake: --path with --sweep: ours gives no truth for its frames, so no flicker\n");
}

Test(run, stability_rows_carry_their_verdict)
{
    Outcome got = done("--size 8x8 --stability t.csv");
    char *rows = rows_of("t.csv");
    cr_assert_str_eq(
        rows,
        "chapter,case,quantity,expected,got,error,tolerance,nonfinite,verdict\n"
        "99_fake,fine,ratio,1,1.05,0.05,0.1,0,pass\n99_fake,fine,\"limit, far\",inf,inf,0,0.1,0,pass\n"
        "99_fake,rough,ratio,1,1.05,0.05,0.1,0,pass\n99_fake,rough,\"limit, far\",inf,inf,0,0.1,0,pass\n",
        "%s", rows);
    cr_assert_eq(count_of(got.trace, "frame"), 2, "one frame a case: %s", got.trace);
    cr_assert(strstr(got.trace, "setting rough dark raster 64 0.5 0 16x16\n"), "a case's scene and size: %s",
              got.trace);
}

Test(run, failed_case_is_written_and_ends_with_1)
{
    static const struct {
        double got;
        long nonfinite;
        const char *row;
    } bad[] = {{1.11, 0, "99_fake,fine,ratio,1,1.11,0.11,0.1,0,fail\n"},
               {NAN, 0, "99_fake,fine,ratio,1,nan,nan,0.1,0,fail\n"},
               {1, 3, "99_fake,fine,ratio,1,1,0,0.1,3,fail\n"},
               {-INFINITY, 0, "99_fake,fine,ratio,1,-inf,inf,0.1,0,fail\n"}};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; ++i) {
        checked[0][1] = bad[i].got;
        checked_nonfinite = bad[i].nonfinite;
        // With non-finite values both quantities fail, otherwise the first alone.
        expect("--size 8x8 --stability t.csv --set method=exact", 1,
               bad[i].nonfinite ? "99_fake: --stability t.csv: 2 of 2 rows failed\n"
                                : "99_fake: --stability t.csv: 1 of 2 rows failed\n");
        cr_expect(strstr(rows_of("t.csv"), bad[i].row), "%s", rows_of("t.csv"));
    }
}

Test(run, sweep_and_stability_go_together)
{
    Outcome got = done("--size 8x8 --stability t.csv --sweep s.csv --set method=exact");
    cr_assert(strstr(got.trace, "setting fine") > strstr(got.trace, "setting ours"),
              "the sweep comes first: %s", got.trace);
    cr_assert(there("s.csv") && there("t.csv"), "both tables");
}
