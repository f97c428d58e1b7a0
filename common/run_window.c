// run_window: the picture in a window, and the controls that change what the next frame is made of. Nothing is drawn anew
// while nothing has changed: on a software renderer an idle window should cost nothing.
#include "run_internal.h"

#include <GLFW/glfw3.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum {
    BORDER = 6,
    BAR = 10,
    SPACE = 4,
    BARS_WIDTH = 240
}; // pixels: a shader error's frame; a pass's bar, BARS_WIDTH is the whole frame's time
static const double ORBIT_RAD_PER_PIXEL = 0.008; // half a turn in some 400 pixels
static const double ZOOM_PER_NOTCH = 0.9;
static const double RELOAD_SECONDS = 0.1; // how often saved shaders are looked for
static const char keys[] =
    "left drag: orbit  wheel: zoom  Home: the camera as set  right drag: move the light  L: next light\n"
    "[ ]: step back, on  Tab: next parameter  Up, Down: change it  P: passes  R: reload shaders\n"
    "S: screenshot  H: this help  Esc: close\n";

struct RunWindow {
    GLFWwindow *window;
    Raster *raster;
    Shader *present;
    double cursor[2];
    size_t parameter; // that Up and Down change
    bool passes_shown, present_again, frame_again;
    char *shader_error; // of the last reload, or NULL
};

static void say(const char *text)
{
    fputs(text, stdout);
    fflush(stdout);
}

// Of this setting; NULL where the chapter has no such parameter.
static RunValue *value_of(Run *run, const char *name)
{
    int index = run_parameter_find(run, name);
    return index < 0 ? NULL : &run->values[index];
}

static bool parameter_offered(const Run *run, size_t i)
{
    return run->parameters[i].kind != RUN_VECTOR && !run_parameter_refused(run, i);
}

static void parameter_next(Run *run) // exposure at least is always offered
{
    size_t *parameter = &run->window_state->parameter;
    do
        *parameter = (*parameter + 1) % run->parameter_count;
    while (!parameter_offered(run, *parameter));
    run->window_state->present_again = true; // with its title
}

static void light_next(Run *run, int by)
{
    RunValue *light = value_of(run, "light");
    int count = (int)run->scene->light_count;
    if (!light || count < 2)
        return;
    for (size_t i = 0; i < run->parameter_count; ++i) // it starts from what the scene says
        if (strncmp(run->parameters[i].name, "light_", 6) == 0)
            run->values[i].given = false;
    light->number[0] = ((int)light->number[0] + count + by) % count;
    light->given = run->rebuild = true;
}

static void parameter_change(Run *run, int by)
{
    const RunParameter *of = &run->parameters[run->window_state->parameter];
    RunValue *value = &run->values[run->window_state->parameter];
    double *number = &value->number[0], range = of->most - of->least;
    int choices = 1;
    for (const char *c = of->choices; c && *c; ++c)
        choices += *c == ' ';
    if (value == value_of(run, "light")) { // no further than the scene has lights
        light_next(run, by);
        return;
    }
    if (of->kind == RUN_CHOICE)
        value->choice = (value->choice + choices + by) % choices;
    else if (of->kind == RUN_INTEGER && range > 32) // wide ranges are walked by octaves
        *number = by > 0 ? fmax(*number * 2, 1) : floor(*number / 2);
    else
        *number += by * (of->kind == RUN_INTEGER ? 1 : fmin(range / 20, 0.5));
    *number = fmin(fmax(*number, of->least), of->most);
    value->given = run->rebuild = true;
}

// Swing where the light is about the scene's centre, and the way it shines along.
static void light_move(Run *run, float yaw_rad, float pitch_rad)
{
    RunValue *chosen = value_of(run, "light");
    if (!chosen || run->scene->light_count == 0)
        return;
    const Light *light = &run->scene->lights[(size_t)chosen->number[0]];
    vec3 centre = 0.5f * (run->scene->lower + run->scene->upper);
    for (int way = 0; way < 2; ++way) {
        if (light->kind == (way ? LIGHT_POINT : LIGHT_DIRECTIONAL))
            continue;
        Camera arm = {.eye = way ? -light->direction : light->position - centre, .up = vec3_make(0, 1, 0)};
        vec3 swung = camera_orbit(arm, yaw_rad, pitch_rad, 1).eye, set = way ? -swung : centre + swung;
        RunValue *value = value_of(run, way ? "light_direction" : "light_position");
        for (int i = 0; i < 3; ++i)
            value->number[i] = (double)set[i];
        value->given = run->rebuild = true;
    }
}

static void camera_move(Run *run, float yaw_rad, float pitch_rad, float zoom)
{
    run->camera = camera_orbit(run->camera, yaw_rad, pitch_rad, zoom);
    run->camera_moved = run->window_state->frame_again = true;
}

static void shaders_reload(Run *run, bool all)
{
    struct RunWindow *state = run->window_state;
    char *error = NULL;
    int replaced = all ? shader_reload_all(&error) : shader_reload_changed(&error);
    if (!replaced && !error)
        return;
    if (error)
        fprintf(stderr, "%s\n", error);
    if (replaced)
        printf("%d shaders compiled\n", replaced);
    say("");
    free(state->shader_error);
    state->shader_error = error;
    state->present_again = true;
    run->rebuild |= replaced > 0; // what the old shader left in buffers is stale
}

static void screenshot(const Run *run)
{
    char *path = NULL;
    for (int number = 1; !path || access(path, F_OK) == 0; ++number) {
        free(path);
        path = text_format("out/%s-%d.png", run->about->chapter, number);
    }
    Image picture = run_picture(run);
    folder_make("out");
    image_write(path, &picture, (float)run_number(run, "exposure"));
    printf("%s\n", path);
    fflush(stdout);
    image_free(&picture);
    free(path);
}

static void on_key(GLFWwindow *window, int key, int scancode, int action, int modifiers)
{
    (void)scancode, (void)modifiers;
    Run *run = glfwGetWindowUserPointer(window);
    struct RunWindow *state = run->window_state;
    bool change = key == GLFW_KEY_UP || key == GLFW_KEY_DOWN, back = key == GLFW_KEY_LEFT_BRACKET;
    if (change && action != GLFW_RELEASE)
        parameter_change(run, key == GLFW_KEY_UP ? 1 : -1); // again and again while it is held
    if (change || action != GLFW_PRESS)
        return;
    if (back || key == GLFW_KEY_RIGHT_BRACKET) {
        int step = run->step_shown + (back ? -1 : 1);
        run->step_wanted = step < 0 ? 0 : step < run->step_count ? step : run->step_count - 1;
        run->rebuild = true; // what the passes of later steps build does not exist yet
    } else if (key == GLFW_KEY_HOME) {
        run->camera_moved = false;
        run->rebuild = true;
    } else if (key == GLFW_KEY_P) {
        run->timing = state->passes_shown = !state->passes_shown;
        run->rebuild = true; // the frame that builds everything is the one to see
    } else if (key == GLFW_KEY_L)
        light_next(run, 1);
    else if (key == GLFW_KEY_TAB)
        parameter_next(run);
    else if (key == GLFW_KEY_R)
        shaders_reload(run, true);
    else if (key == GLFW_KEY_S)
        screenshot(run);
    else if (key == GLFW_KEY_H)
        say(keys);
    else if (key == GLFW_KEY_ESCAPE)
        glfwSetWindowShouldClose(window, GLFW_TRUE);
}

static void on_cursor(GLFWwindow *window, double x, double y)
{
    Run *run = glfwGetWindowUserPointer(window);
    double *cursor = run->window_state->cursor;
    float yaw = (float)((cursor[0] - x) * ORBIT_RAD_PER_PIXEL);
    float pitch = (float)((y - cursor[1]) * ORBIT_RAD_PER_PIXEL);
    cursor[0] = x;
    cursor[1] = y;
    if (glfwGetMouseButton(window, GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS)
        camera_move(run, yaw, pitch, 1);
    else if (glfwGetMouseButton(window, GLFW_MOUSE_BUTTON_RIGHT) == GLFW_PRESS)
        light_move(run, yaw, pitch);
}

static void on_scroll(GLFWwindow *window, double x, double y)
{
    (void)x;
    camera_move(glfwGetWindowUserPointer(window), 0, 0, (float)pow(ZOOM_PER_NOTCH, y));
}

static void on_refresh(GLFWwindow *window)
{
    ((Run *)glfwGetWindowUserPointer(window))->window_state->present_again = true;
}

static void on_size(GLFWwindow *window, int width, int height)
{
    Run *run = glfwGetWindowUserPointer(window);
    if (width < 1 || height < 1) // minimized
        return;
    run->rebuild |= width != run->width || height != run->height;
    run->width = width;
    run->height = height;
}

void run_window_open(Run *run)
{
    struct RunWindow *state = run->window_state = memory_new(1, sizeof *state, "the window's state");
    state->window = gl_window();
    state->raster = raster_open();
    state->present = shader_open("present", NULL, "common/fullscreen.vert", "common/present.frag");
    glfwSetWindowUserPointer(state->window, run);
    glfwSetKeyCallback(state->window, on_key);
    glfwSetCursorPosCallback(state->window, on_cursor);
    glfwSetScrollCallback(state->window, on_scroll);
    glfwSetWindowRefreshCallback(state->window, on_refresh);
    glfwSetFramebufferSizeCallback(state->window, on_size);
    glfwGetCursorPos(state->window, &state->cursor[0], &state->cursor[1]);
    say(keys);
}

void run_window_setting(Run *run)
{
    if (!parameter_offered(run, run->window_state->parameter))
        parameter_next(run);
}

static void rectangle(int x, int y, int width, int height, const float color[4])
{
    gl.Scissor(x, y, width, height);
    gl.ClearNamedFramebufferfv(0, GL_COLOR, 0, color);
}

// A bar for each pass, top down in their order: green as long as its share of the frame, grey where it was left out.
static void passes_draw(const Run *run)
{
    const float green[] = {0.2f, 0.8f, 0.3f, 1}, grey[] = {0.4f, 0.4f, 0.4f, 1}, black[] = {0, 0, 0, 1};
    double total = fmax(run_plan_ms(run, true), 1e-9);
    for (int i = 0; i < (int)run->pass_count; ++i) {
        const RunPass *pass = &run->passes[i];
        int y = run->height - (i + 1) * (BAR + SPACE);
        int length = pass->ran ? 1 + (int)(pass->ms / total * (BARS_WIDTH - 1)) : BARS_WIDTH / 8;
        rectangle(SPACE, y, BARS_WIDTH, BAR, black);
        rectangle(SPACE, y, length, BAR, pass->ran ? green : grey);
    }
}

static void title_set(const Run *run)
{
    const struct RunWindow *state = run->window_state;
    char *value = run_value_text(run, state->parameter, &run->values[state->parameter]);
    char *title = state->shader_error ? text_format("shader error: %s", state->shader_error)
                                      : text_format("%s - %s - step %s - %s = %s", run->about->chapter,
                                                    run->scene_name, run->about->steps[run->step_shown].name,
                                                    run->parameters[state->parameter].name, value);
    glfwSetWindowTitle(state->window, title);
    free(title);
    free(value);
}

static void present(const Run *run)
{
    const struct RunWindow *state = run->window_state;
    const float red[] = {0.9f, 0.05f, 0.05f, 1};
    gl.BindTextureUnit(0, run->shown);
    shader_set_float(state->present, "exposure_stops", (float)run_number(run, "exposure"));
    raster_fullscreen(state->raster, state->present, 0, run->width, run->height);
    gl.Enable(GL_SCISSOR_TEST);
    if (state->passes_shown)
        passes_draw(run);
    for (int side = 0; side < 4 && state->shader_error; ++side) // left, bottom, right, top
        rectangle(side == 2 ? run->width - BORDER : 0, side == 3 ? run->height - BORDER : 0,
                  side % 2 ? run->width : BORDER, side % 2 ? BORDER : run->height, red);
    gl.Disable(GL_SCISSOR_TEST);
    glfwSwapBuffers(state->window);
    title_set(run);
}

bool run_window_frame(Run *run)
{
    struct RunWindow *state = run->window_state;
    char *plan = state->passes_shown ? run_plan_text(run) : NULL;
    say(plan ? plan : "");
    free(plan);
    state->present_again = true;
    state->frame_again = run->path != RUN_STILL || run->frames; // an animation, or so many frames and no more
    do {
        if (state->present_again && run->shown)
            present(run);
        state->present_again = false;
        if (state->frame_again)
            glfwPollEvents();
        else
            glfwWaitEventsTimeout(RELOAD_SECONDS);
        shaders_reload(run, false);
    } while (!glfwWindowShouldClose(state->window) && !state->frame_again && !run->rebuild);
    return !glfwWindowShouldClose(state->window);
}

void run_window_close(Run *run)
{
    struct RunWindow *state = run->window_state;
    shader_close(state->present);
    raster_close(state->raster);
    free(state->shader_error);
    free(state);
}
