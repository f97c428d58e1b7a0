// support_run: see support_run.h.
#include "support_run.h"
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
    {"fault", "what goes wrong", NULL, RUN_CHOICE, 0, 0, {0}, "none nan silent count step slow"},
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
double fake_checked[4][2] = {{1, 1.05}, {INFINITY, INFINITY}}; // expected, got; tolerance 0.1
long fake_nonfinite;
bool fake_offers_truth = true;

// Rows from the bottom: 0, 1, 2, … in red, so that flipping shows; NaN in one pixel where asked.
static void fill_rows(GLuint picture, int width, int height, bool nan_pixel)
{
    float *pixels = calloc(4 * (size_t)width * (size_t)height, sizeof *pixels);
    for (int i = 0; i < width * height; ++i) {
        int row = i / width;
        pixels[4 * i] = (float)row;
    }
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
                usleep(run_chosen(run, "fault", "slow") ? 1001000 : 3000);
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
            if (fake_offers_truth && run_truth_wanted(run)) {
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
            run_check(run, i ? "limit, far" : "ratio", fake_checked[i][0], fake_checked[i][1], 0.1,
                      fake_nonfinite);
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
void file_put(const char *path, const char *text)
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

Outcome fake_command(const char *line)
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

void fake_folder_enter(void)
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

void fake_folder_leave(void)
{
    char folder[] = "/tmp/test_run_XXXXXX";
    if (getcwd(folder, sizeof folder) && strncmp(folder, "/tmp/test_run_", 14) == 0) {
        char *remove_all = text_format("rm -rf %s", folder);
        cr_assert(chdir("/") == 0 && system(remove_all) == 0, "%s", remove_all);
        free(remove_all);
    }
}

void fake_expect(const char *line, int status, const char *error)
{
    Outcome got = fake_command(line);
    cr_expect_eq(got.status, status, "'%s' ended with %d, not %d: %s", line, got.status, status, got.error);
    cr_expect_str_eq(got.error, error, "'%s' said\n%snot\n%s", line, got.error, error);
}

size_t count_of(const char *text, const char *part)
{
    size_t count = 0;
    for (const char *at = text; (at = strstr(at, part)); at += strlen(part))
        ++count;
    return count;
}

// The command did its work; everything that it said on the way.
Outcome fake_done(const char *line)
{
    Outcome got = fake_command(line);
    cr_assert_eq(got.status, 0, "'%s' ended with %d: %s", line, got.status, got.error);
    return got;
}

bool there(const char *path)
{
    return access(path, F_OK) == 0;
}

// Files of the working folder beside those that every command makes.
int files_written(void)
{
    DIR *folder = opendir(".");
    int count = 0;
    for (struct dirent *entry; (entry = readdir(folder));)
        count += !strstr(" . .. .stdout .stderr .trace fake.comp fake.vert fake.frag ", entry->d_name);
    closedir(folder);
    return count;
}
