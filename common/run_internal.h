// run_internal: what the files of run share among themselves; chapters see run.h alone.
//   run.c          open, close, settings loop, frame loop, pictures
//   run_options.c  the command line: argp, --help, --list
//   run_values.c   values of parameters: from text, to text, for the chapter
//   run_setting.c  one setting: scene, camera, lights and medium as set, --path
//   run_plan.c     passes, counts, --plan
//   run_tables.c   rows of --sweep and --stability
//   run_window.c   the window: shows the last frame's picture, takes its events
// Every string that a chapter hands over (names, reasons, counts) is kept by pointer: literals, as in its `about`.
#ifndef RUN_INTERNAL_H
#define RUN_INTERNAL_H

#include "run.h"

// The value of parameters[i]: numbers (NUMBER, INTEGER: the first), or which of `choices` (0 is the first).
// `given`: by --set, a row or the window. A common parameter (eye, scattering, …) that is not given is the scene's own.
typedef struct RunValue {
    bool given;
    double number[3];
    int choice;
} RunValue;

typedef struct RunCount {
    int pass; // index
    const char *what;
    double value;
} RunCount;

// One pass of the last frame, in the order of its first begin.
typedef struct RunPass {
    const char *name, *reason; // reason: why it was, or would have been, left out; NULL where it was needed
    bool common, ran;
    double ms, skipped, of; // ms is 0 unless Run.timing
} RunPass;

enum { RUN_REPEATS = 7 }; // odd, so that the median is one of them; 3 of them may be disturbed
// Frames of more than a second are disturbed by less of their time, and cost more: 3 of them do.
enum { RUN_REPEATS_SLOW = 3, RUN_SLOW_MS = 1000 };

typedef enum RunTask { RUN_PICTURE, RUN_SWEEP, RUN_STABILITY } RunTask;

// One turn of the settings loop.
typedef struct RunSetting {
    RunTask task;
    const RunRow *row; // NULL for RUN_PICTURE
    const char *scene;
} RunSetting;

typedef enum RunPath { RUN_STILL, RUN_SUBPIXEL, RUN_ORBIT, RUN_LIGHT, RUN_DEFORM } RunPath;

struct Run {
    const RunAbout *about;
    int argc;
    char **argv;

    // The command line.
    const char *scene_given, *out, *truth, *sweep, *stability, *shaders;
    char *out_made; // *out where it is nobody's word
    bool window, plan, json, everything, list, help, step_given;
    int frames;            // 0: not given
    int row;               // of the table, from 1; 0: all
    const char *row_names; // or its rows of these names, commas between them; NULL: all
    int step_count;
    uint64_t seed;
    RunPath path;

    // Parameters: the chapter's own, then the common ones that it uses; exposure is always the last.
    RunParameter *parameters;
    char **words; // one a parameter: its choices, each ended by NUL
    size_t parameter_count;
    RunValue *asked;  // by --set
    RunValue *values; // of this setting: asked, then the row's, then the window's

    // Settings.
    RunSetting *settings;
    size_t setting_count, setting_next;
    const RunSetting *setting; // NULL before the first
    int width, height, asked_width, asked_height;

    // The scene as set, and what the file or generator gave.
    Scene *scene;
    const char *scene_name;
    Camera scene_camera;
    Medium scene_medium;
    Light *scene_lights;
    Light *set_lights; // lights before --path moves one

    struct RunWindow *window_state; // run_window.c's own; NULL off-screen
    // What the window may change between two frames, beside `values`:
    Camera camera;     // as set, or as orbited; --path moves run_camera from here
    bool camera_moved; // orbited by hand: the next setting keeps `camera`
    int step_wanted;   // index into about->steps at which frames stop
    bool rebuild;      // a value, size or shader has changed: this setting ends, run_setting starts it anew
    bool timing;       // glFinish around passes, so that passes[i].ms are set

    // This frame.
    int frame;        // frame number, -1 before the first
    int frames_begun; // in this setting, with warm-up and repeats
    bool stopped;     // step_wanted was reached
    int step_shown;   // index of the last step reached, -1: none
    GLuint shown;     // its picture, 0: none
    RunPass *passes;  // the last frame's
    RunCount *counts; // of its passes
    size_t pass_count, count_count;
    int pass_current; // -1: none is running
    double pass_start_ms;
    GLuint queries[3]; // pipeline statistics, in run_plan.c's order; 0 where they are not made

    // Measuring.
    int warm_up, frames_wanted; // frames of this setting before those that count; and all together, 0: no end
    size_t repeats;             // of this setting, which are measured
    double technique_ms[RUN_REPEATS], frame_ms[RUN_REPEATS];
    Image flicker_before; // picture minus truth of the last frame of --path
    double flicker_sum;
    long flicker_values;
    Image truth_now;
    bool truth_given;
    Csv *tables[3]; // by RunTask
    long rows_of_setting, checked, failed;
};

// run_options.c: fills the options, parameters, asked values; ends the program for --help, --list and every wrong request.
void run_options_parse(Run *run, int argc, char **argv);
void run_size_parse(const char *option, const char *text, int *width, int *height);
void run_stdout_flush(void); // ends the program where standard output is full
// --out with the number of this frame put into its %d; the caller frees it.
char *run_out_path(const Run *run, int frame);

// run_values.c: " a b c" of structs that begin with their name, a NULL name ends them; the caller frees it. And which of such words one is, or -1.
char *run_names_join(const void *items, size_t stride);
int run_word_find(const char *words, const char *wanted);
// Set values[i] of the parameter `key` from text; `option` is named in the error ("--set", "row case_name").
void run_value_parse(const Run *run, RunValue *values, const char *option, const char *key, const char *text);

// run_setting.c: the chapter's parameters and the common ones; values[] into scene and camera, and back.
void run_parameters_make(Run *run);
bool run_parameter_of_scene(const Run *run, size_t parameter); // where it is not given, the scene has its own
void run_setting_apply(Run *run); // ends the program where the scene cannot take what is set
void run_setting_move(Run *run);  // --path: the light of this frame
// Why the scene as loaded cannot take this parameter (light_position without a light), NULL where it can. The window offers only what
// it can take, and takes `given` off the light_… values where it changes `light`.
const char *run_parameter_refused(const Run *run, size_t parameter);
int run_parameter_find(const Run *run, const char *name);                      // index, or -1
char *run_value_text(const Run *run, size_t parameter, const RunValue *value); // as --set takes it; to free

// run_plan.c
void run_plan_begin_frame(Run *run);
void run_plan_end_pass(Run *run);
char *run_plan_text(const Run *run); // a readable table of the last frame's passes; the caller frees it
char *run_plan_json(const Run *run);
void run_plan_close(Run *run);
double run_plan_ms(const Run *run, bool with_common); // sum over the last frame's passes

// run_tables.c
void run_tables_open(Run *run); // lists the settings; opens the CSV files
void run_tables_close(Run *run);
void run_tables_setting_end(Run *run);
void run_flicker_frame(Run *run); // one frame of --path in a sweep, with its truth
void run_flicker_end(Run *run);
void run_row_apply(const Run *run, const RunRow *row, RunValue *values);

// run_window.c
// Open the window's own objects; the context (GL_PLATFORM_WINDOW) is already current.
void run_window_open(Run *run);
// A new setting has begun (title, parameter list).
void run_window_setting(Run *run);
// Present run->shown (bottom row first, linear, at the parameter `exposure`), poll events, apply controls; false when closed.
bool run_window_frame(Run *run);
void run_window_close(Run *run);

#endif
