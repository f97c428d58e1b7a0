// run_window: the picture in a window, and the controls that change what the next frame is made of. Nothing is drawn anew
// while nothing has changed: on a software renderer an idle window should cost nothing.
#include "run_internal.h"

#include <GLFW/glfw3.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum {
    BORDER_PIXELS = 6, // of the red frame of a shader error
    BAR_PIXELS = 10,   // height of one pass's bar
    BAR_SPACE = 4,
    BARS_WIDTH = 240 // the whole frame's time
};
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

static void parameter_next(Run *run)
{
    for (size_t tried = 0; tried < run->parameter_count; ++tried) {
        run->window_state->parameter = (run->window_state->parameter + 1) % run->parameter_count;
        if (parameter_offered(run, run->window_state->parameter))
            return;
    }
}

static void title_set(Run *run)
{
    const struct RunWindow *state = run->window_state;
    const RunParameter *parameter = &run->parameters[state->parameter];
    char *value = run_value_text(run, state->parameter, &run->values[state->parameter]);
    const char *step = run->step_shown >= 0 ? run->about->steps[run->step_shown].name : "";
    char *title = state->shader_error ? text_format("shader error: %s", state->shader_error)
                                      : text_format("%s - %s - step %s - %s = %s", run->about->chapter,
                                                    run->scene_name, step, parameter->name, value);
    glfwSetWindowTitle(state->window, title);
    free(title);
    free(value);
}

static void parameter_change(Run *run, bool up)
{
    size_t i = run->window_state->parameter;
    const RunParameter *of = &run->parameters[i];
    if (!parameter_offered(run, i))
        return;
    RunValue *value = &run->values[i];
    double *number = &value->number[0];
    if (of->kind == RUN_CHOICE) {
        int choices = 1;
        for (const char *c = of->choices; *c; ++c)
            choices += *c == ' ';
        value->choice = (value->choice + (up ? 1 : choices - 1)) % choices;
    } else if (of->kind == RUN_INTEGER && of->most - of->least > 32) { // wide ranges are walked by octaves
        *number = up ? fmax(*number * 2, 1) : floor(*number / 2);
    } else {
        *number += (up ? 1 : -1) * (of->kind == RUN_INTEGER ? 1 : fmin((of->most - of->least) / 20, 0.5));
    }
    *number = fmin(fmax(*number, of->least), of->most);
    value->given = true;
    run->rebuild = true;
}

static void light_next(Run *run)
{
    RunValue *light = value_of(run, "light");
    if (!light || run->scene->light_count < 2)
        return;
    light->number[0] = (double)(((size_t)light->number[0] + 1) % run->scene->light_count);
    for (size_t i = 0; i < run->parameter_count; ++i) // the next light starts from what the scene says
        if (strncmp(run->parameters[i].name, "light_", 6) == 0)
            run->values[i].given = false;
    light->given = true;
    run->rebuild = true;
}

static void value_set_vector(Run *run, const char *name, vec3 vector)
{
    RunValue *value = value_of(run, name);
    for (int i = 0; value && i < 3; ++i)
        value->number[i] = (double)vector[i];
    if (value)
        value->given = true;
}

// Swing the light about the scene's centre; the way that a spot or the sun points swings along.
static void light_move(Run *run, float yaw_rad, float pitch_rad)
{
    RunValue *chosen = value_of(run, "light");
    if (!chosen || run->scene->light_count == 0)
        return;
    const Light *light = &run->scene->lights[(size_t)chosen->number[0]];
    vec3 centre = 0.5f * (run->scene->lower + run->scene->upper), up = vec3_make(0, 1, 0);
    if (light->kind != LIGHT_POINT) {
        Camera way = {.eye = centre - light->direction, .target = centre, .up = up};
        value_set_vector(run, "light_direction", centre - camera_orbit(way, yaw_rad, pitch_rad, 1).eye);
    }
    if (light->kind != LIGHT_DIRECTIONAL) {
        Camera place = {.eye = light->position, .target = centre, .up = up};
        value_set_vector(run, "light_position", camera_orbit(place, yaw_rad, pitch_rad, 1).eye);
    }
    run->rebuild = true;
}

static void camera_move(Run *run, float yaw_rad, float pitch_rad, float zoom)
{
    run->camera = camera_orbit(run->camera, yaw_rad, pitch_rad, zoom);
    run->camera_moved = true;
    run->window_state->frame_again = true;
}

static void shaders_reload(Run *run, bool all)
{
    struct RunWindow *state = run->window_state;
    char *error = NULL;
    int replaced = all ? shader_reload_all(&error) : shader_reload_changed(&error);
    if (error)
        fprintf(stderr, "%s\n", error);
    if (replaced)
        run->rebuild = true; // what the old shader left in buffers is stale
    if (replaced || error || all) {
        free(state->shader_error);
        state->shader_error = error;
        state->present_again = true;
    }
}

static void screenshot(Run *run)
{
    char *path = NULL;
    int number = 0;
    do {
        free(path);
        path = text_format("out/%s-%d.png", run->about->chapter, ++number);
    } while (access(path, F_OK) == 0);
    folder_make("out");
    Image picture = run_picture(run);
    image_write(path, &picture, (float)run_number(run, "exposure"));
    printf("%s\n", path);
    fflush(stdout);
    image_free(&picture);
    free(path);
}

static void passes_toggle(Run *run)
{
    run->window_state->passes_shown = !run->window_state->passes_shown;
    run->timing = run->window_state->passes_shown;
    run->rebuild = true; // the frame that builds everything is the one to see
}

static void on_key(GLFWwindow *window, int key, int scancode, int action, int modifiers)
{
    (void)scancode, (void)modifiers;
    Run *run = glfwGetWindowUserPointer(window);
    int last = run->step_count - 1, step = run->step_shown;
    if (action == GLFW_RELEASE)
        return;
    switch (key) {
    case GLFW_KEY_LEFT_BRACKET:
    case GLFW_KEY_RIGHT_BRACKET:
        step += key == GLFW_KEY_LEFT_BRACKET ? -1 : 1;
        run->step_wanted = step < 0 ? 0 : step > last ? last : step;
        run->rebuild = true; // what the passes of later steps build does not exist yet
        break;
    case GLFW_KEY_HOME:
        run->camera_moved = false;
        run->rebuild = true;
        break;
    case GLFW_KEY_L:
        light_next(run);
        break;
    case GLFW_KEY_TAB:
        parameter_next(run);
        title_set(run);
        break;
    case GLFW_KEY_UP:
    case GLFW_KEY_DOWN:
        parameter_change(run, key == GLFW_KEY_UP);
        break;
    case GLFW_KEY_P:
        passes_toggle(run);
        break;
    case GLFW_KEY_R:
        shaders_reload(run, true);
        break;
    case GLFW_KEY_S:
        screenshot(run);
        break;
    case GLFW_KEY_H:
        fputs(keys, stdout);
        fflush(stdout);
        break;
    case GLFW_KEY_ESCAPE:
        glfwSetWindowShouldClose(window, GLFW_TRUE);
        break;
    default:
        break;
    }
}

static void on_cursor(GLFWwindow *window, double x, double y)
{
    Run *run = glfwGetWindowUserPointer(window);
    struct RunWindow *state = run->window_state;
    float yaw = (float)((state->cursor[0] - x) * ORBIT_RAD_PER_PIXEL);
    float pitch = (float)((y - state->cursor[1]) * ORBIT_RAD_PER_PIXEL);
    state->cursor[0] = x;
    state->cursor[1] = y;
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
    if (width < 1 || height < 1 || (width == run->width && height == run->height)) // minimized, or no change
        return;
    run->width = width;
    run->height = height;
    run->rebuild = true;
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
    fputs(keys, stdout);
    fflush(stdout);
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
    for (size_t i = 0; i < run->pass_count; ++i) {
        int y = run->height - ((int)i + 1) * (BAR_PIXELS + BAR_SPACE);
        rectangle(BAR_SPACE, y, BARS_WIDTH, BAR_PIXELS, black);
        rectangle(BAR_SPACE, y,
                  run->passes[i].ran ? 1 + (int)(run->passes[i].ms / total * (BARS_WIDTH - 1))
                                     : BARS_WIDTH / 8,
                  BAR_PIXELS, run->passes[i].ran ? green : grey);
    }
}

static void present(Run *run)
{
    const struct RunWindow *state = run->window_state;
    gl.BindTextureUnit(0, run->shown);
    shader_set_float(state->present, "exposure_stops", (float)run_number(run, "exposure"));
    raster_fullscreen(state->raster, state->present, 0, run->width, run->height);
    gl.Enable(GL_SCISSOR_TEST);
    if (state->passes_shown)
        passes_draw(run);
    if (state->shader_error) {
        const float red[] = {0.9f, 0.05f, 0.05f, 1};
        rectangle(0, 0, run->width, BORDER_PIXELS, red);
        rectangle(0, run->height - BORDER_PIXELS, run->width, BORDER_PIXELS, red);
        rectangle(0, 0, BORDER_PIXELS, run->height, red);
        rectangle(run->width - BORDER_PIXELS, 0, BORDER_PIXELS, run->height, red);
    }
    gl.Disable(GL_SCISSOR_TEST);
    glfwSwapBuffers(state->window);
    title_set(run);
}

bool run_window_frame(Run *run)
{
    struct RunWindow *state = run->window_state;
    state->present_again = true;
    state->frame_again = run->path != RUN_STILL || run->frames; // an animation, or so many frames and no more
    if (state->passes_shown) {
        char *plan = run_plan_text(run);
        fputs(plan, stdout);
        fflush(stdout);
        free(plan);
    }
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
    run->window_state = NULL;
}
