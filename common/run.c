// run: open and close, the settings loop, the frame loop, pictures.
#include "run_internal.h"
#include <stdlib.h>
#include <string.h>

// The first frame compiles shaders to machine code, the second finds caches and clocks settled.
enum { WARM_UP = 2, PATH_FRAMES = 16 };

Run *run_open(const RunAbout *about, int argc, char **argv)
{
    Run *run = memory_new(1, sizeof *run, "the run");
    run->about = about;
    run->argc = argc;
    run->argv = argv;
    run->seed = 1;
    run->width = run->height = 512;
    run->frame = run->pass_current = -1;
    run_parameters_make(run);
    run_options_parse(run, argc, argv);
    if (run->shaders)
        shader_search_first(run->shaders);
    if (run->everything)
        shader_define_all("EVERYTHING", 1);
    run->asked_width = run->width;
    run->asked_height = run->height;
    gl_open(run->window ? GL_PLATFORM_WINDOW : gl_headless_platform(), run->width, run->height, about->title);
    run_tables_open(run);
    if (run->window)
        run_window_open(run);
    return run;
}

static void scene_drop(Run *run)
{
    scene_close(run->scene);
    free(run->scene_lights);
    free(run->set_lights);
}

static void scene_load(Run *run, const char *name)
{
    if (run->scene_name && strcmp(run->scene_name, name) == 0)
        return;
    scene_drop(run);
    const SceneKind *kind = run->about->own_scenes;
    while (kind && kind->name && strcmp(kind->name, name) != 0)
        ++kind;
    Scene *scene = kind && kind->name ? scene_from(kind, run->seed) : scene_open(name, run->seed);
    char *report = scene_report_text(scene);
    if (report)
        note("%s", report);
    free(report);
    run->scene = scene;
    run->scene_name = name;
    run->scene_camera = scene->camera;
    run->scene_medium = scene->medium;
    run->scene_lights = memory_new(scene->light_count, sizeof(Light), "the lights");
    run->set_lights = memory_new(scene->light_count, sizeof(Light), "the lights");
    for (size_t i = 0; i < scene->light_count; ++i)
        run->scene_lights[i] = scene->lights[i];
}

bool run_setting(Run *run)
{
    run_tables_setting_end(run);
    if (!run->rebuild) {
        if (run->setting_next == run->setting_count)
            return false;
        run->setting = &run->settings[run->setting_next++];
        memcpy(run->values, run->asked, run->parameter_count * sizeof *run->values);
        run->width = run->asked_width;
        run->height = run->asked_height;
        const RunRow *row = run->setting->row;
        if (row)
            run_row_apply(run, row, run->values);
        if (row && row->size)
            run_size_parse(row->name, row->size, &run->width, &run->height);
    }
    run->rebuild = false;
    run->frame = -1;
    run->frames_begun = 0;
    RunTask task = run->setting->task;
    run->repeats = RUN_REPEATS;
    int frames = run->frames ? run->frames : run->path ? PATH_FRAMES : 1;
    run->warm_up = task == RUN_SWEEP ? WARM_UP + RUN_REPEATS : run->plan ? WARM_UP : 0;
    run->frames_wanted = run->warm_up + (task == RUN_STABILITY             ? 1
                                         : task == RUN_SWEEP && !run->path ? 0
                                         : run->window                     ? run->frames
                                                                           : frames);
    scene_load(run, run->setting->scene);
    run_setting_apply(run);
    if (run->window)
        run_window_setting(run);
    return true;
}

// "name%04d.png" with this frame's number; other uses of % are refused.
char *run_out_path(const Run *run, int frame)
{
    const char *percent = strchr(run->out, '%'), *rest = percent ? percent + 1 : "";
    if (!percent)
        return text_format("%s", run->out);
    bool zeros = *rest == '0';
    int digits = zeros && rest[1] >= '1' && rest[1] <= '9' ? rest[1] - '0' : 1;
    rest += zeros ? 2 : 0;
    if (*rest != 'd' || strchr(rest, '%') || (zeros && rest[-1] == '0'))
        fail_request("--out %s: one %%d or %%04d stands for the frame's number, nothing else may follow a %%",
                     run->out);
    return text_format("%.*s%0*d%s", (int)(percent - run->out), run->out, digits, frame, rest + 1);
}

void run_stdout_flush(void)
{
    if (fflush(stdout) || ferror(stdout))
        fail_work("standard output: cannot be written");
}

static void picture_write(const Run *run, const char *option, const char *path, const Image *image)
{
    long bad = image_count_nonfinite(image), first = 0,
         values = (long)image->width * image->height * image->channels;
    while (bad && isfinite(image->pixels[first]))
        ++first;
    if (bad)
        fail_work("%s %s: %ld of %ld values are NaN or Inf, the first at pixel %ld,%ld from the top left",
                  option, path, bad, values, first / image->channels % image->width,
                  first / image->channels / image->width);
    image_write(path, image, (float)run_number(run, "exposure"));
}

static void picture_end(Run *run, bool last)
{
    if (run->step_given && !run->window && run->step_shown != run->step_wanted)
        fail_request("--step %s: this setting does not come to it", run->about->steps[run->step_wanted].name);
    if (run->out && (last || strchr(run->out, '%'))) {
        Image image = run_picture(run);
        char *path = run_out_path(run, run->frame);
        picture_write(run, "--out", path, &image);
        free(path);
        image_free(&image);
    }
    if (last && run->plan) {
        char *text = run->json ? run_plan_json(run) : run_plan_text(run);
        fputs(text, stdout);
        run_stdout_flush();
        free(text);
    }
}

// After the last frame of warm-up, which compiles nothing any more: slow frames are repeated less.
static void repeats_choose(Run *run)
{
    if (run_plan_ms(run, true) < RUN_SLOW_MS)
        return;
    run->repeats = RUN_REPEATS_SLOW;
    run->warm_up -= RUN_REPEATS - RUN_REPEATS_SLOW;
    run->frames_wanted -= RUN_REPEATS - RUN_REPEATS_SLOW;
}

// Whether another frame follows.
static bool frame_end(Run *run)
{
    RunTask task = run->setting->task;
    int index = run->frames_begun - 1, repeat = index - WARM_UP;
    run_plan_end_pass(run);
    gl_check("the frame");
    if (task == RUN_SWEEP && repeat == -1)
        repeats_choose(run);
    if (task == RUN_SWEEP && repeat >= 0 && repeat < (int)run->repeats) {
        run->technique_ms[repeat] = run_plan_ms(run, false);
        run->frame_ms[repeat] = run_plan_ms(run, true);
    }
    if (task == RUN_SWEEP && index >= run->warm_up)
        run_flicker_frame(run);
    bool open = !run->window || run_window_frame(run);
    bool last = !open || run->frames_begun == run->frames_wanted;
    if (!open)
        run->rebuild = false;
    if (last && task == RUN_SWEEP && run->path)
        run_flicker_end(run);
    if (task == RUN_PICTURE && index >= run->warm_up)
        picture_end(run, last);
    return !last && !run->rebuild;
}

bool run_frame(Run *run)
{
    if (run->frames_begun > 0 && !frame_end(run))
        return false;
    int index = run->frames_begun++;
    // Warm-up and repeats are the frame 0 again and again: what is built for it is built in each of them.
    run->frame = index < run->warm_up ? 0 : index - run->warm_up;
    if (!run->window)
        run->timing = run->plan || (run->setting->task == RUN_SWEEP && index < run->warm_up);
    if (run->setting->task == RUN_SWEEP)
        run->truth_given = false;
    run->stopped = false;
    run->step_shown = -1;
    run->shown = 0;
    run_setting_move(run);
    run_plan_begin_frame(run);
    return true;
}

static int step_find(const Run *run, const char *name)
{
    for (int step = 0; step < run->step_count; ++step)
        if (strcmp(run->about->steps[step].name, name) == 0)
            return step;
    fail_work("step '%s' is not among this chapter's steps", name);
}

bool run_step_shown(const Run *run, const char *name)
{
    return step_find(run, name) == run->step_wanted;
}

void run_step(Run *run, const char *name, GLuint picture)
{
    run_plan_end_pass(run);
    if (run->stopped)
        return;
    int step = step_find(run, name);
    run->step_shown = step;
    run->shown = picture;
    run->stopped =
        step == run->step_wanted && step + 1 < run->step_count; // passes after the last may measure
}

Image run_picture(const Run *run)
{
    if (!run->shown)
        fail_work("this setting has made no picture");
    GLint width = 0, height = 0; // the texture's own: a window may have got another size since
    gl.GetTextureLevelParameteriv(run->shown, 0, GL_TEXTURE_WIDTH, &width);
    gl.GetTextureLevelParameteriv(run->shown, 0, GL_TEXTURE_HEIGHT, &height);
    size_t row = 3 * (size_t)width, rows = (size_t)height;
    Image image = image_make(width, height, 3);
    float *below = memory_new(row * rows, sizeof *below, "the picture");
    gl.MemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT); // it may have been written by image stores
    gl_texture_read(run->shown, 0, GL_RGB, GL_FLOAT, row * rows * sizeof *below, below);
    for (size_t y = 0; y < rows; ++y)
        memcpy(image.pixels + y * row, below + (rows - 1 - y) * row, row * sizeof *below);
    free(below);
    return image;
}

bool run_truth_wanted(const Run *run)
{
    bool last = run->frames_begun == run->frames_wanted;
    if (run->setting->task == RUN_SWEEP)
        return run->path && run->frames_begun > run->warm_up && !run->truth_given;
    return run->truth && last && !run->truth_given;
}

void run_truth(Run *run, const Image *truth)
{
    run_plan_end_pass(run);
    if (truth->width != run->width || truth->height != run->height || truth->channels < 3)
        fail_work("the truth has another size than the picture");
    if (run->setting->task == RUN_PICTURE && run->truth)
        picture_write(run, "--truth", run->truth, truth);
    if (run->setting->task == RUN_SWEEP) {
        size_t values = (size_t)truth->width * (size_t)truth->height * (size_t)truth->channels;
        run->truth_now = image_make(truth->width, truth->height, truth->channels);
        memcpy(run->truth_now.pixels, truth->pixels, values * sizeof *truth->pixels);
    }
    run->truth_given = true;
}

int run_close(Run *run)
{
    if (run->truth && !run->truth_given)
        fail_work("--truth %s: this setting has no truth, nothing was written", run->truth);
    if (run->window)
        run_window_close(run);
    run_plan_close(run);
    gl_close();
    run_tables_close(run);
    if (run->failed)
        fail_work("--stability %s: %ld of %ld rows failed", run->stability, run->failed, run->checked);
    scene_drop(run);
    free(run->parameters);
    free(run->asked);
    free(run->values);
    free(run->settings);
    for (size_t i = 0; i < run->parameter_count; ++i)
        free(run->words[i]);
    free(run->words);
    free(run->out_made);
    free(run);
    return 0;
}
