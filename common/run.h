// run: the command line, the settings loop, the frame loop, passes, steps, plan, sweep, stability table and window that every chapter shares.
// It is a library that main.c calls, never the reverse; main.c reads top to bottom:
//
//     Run *run = run_open(&about, argc, argv);
//     while (run_setting(run)) {       one scene and parameter set: the window's, one row of a sweep, one stability case
//         … build from run_scene, run_number …
//         while (run_frame(run)) {     one picture; while measuring: warm-up, then n repeats
//             if (run_pass(run, "name", needed, "why it is not needed"))
//                 …
//             run_step(run, "name", picture_texture);
//         }
//         … run_error / run_check, then destroy …
//     }
//     return run_close(run);
#ifndef RUN_H
#define RUN_H

#include "image.h"
#include "measure.h"
#include "raster.h"
#include "scene.h"

typedef enum RunKind { RUN_NUMBER, RUN_INTEGER, RUN_VECTOR, RUN_CHOICE } RunKind;

// One `--set name=value`. A NULL name ends a list.
typedef struct RunParameter {
    const char *name, *shows, *unit;
    RunKind kind;
    double least, most;  // NUMBER, INTEGER; VECTOR: each component
    double initial[3];   // NUMBER, INTEGER: the first
    const char *choices; // CHOICE: "raster exact", the first is the default
} RunParameter;

// One setting of a sweep or one stability case: "method=exact resolution=64". A NULL name ends a list.
typedef struct RunRow {
    const char *name;  // sweep: the technique; stability: the case, unique
    const char *scene; // NULL: the sweep's --scene or default scenes
    const char *settings;
    const char *size; // "256x256" or NULL
} RunRow;

typedef struct RunStep {
    const char *name, *shows;
} RunStep;

// Which common settings the chapter's pictures depend on; only those exist as parameters.
// DEFORM is no parameter: --path deform moves the scene, by the chapter's own rule, where run_deforming.
enum { RUN_USES_CAMERA = 1, RUN_USES_LIGHT = 2, RUN_USES_MEDIUM = 4, RUN_USES_DEFORM = 8 };

typedef struct RunAbout {
    const char *chapter; // "01_voxelization"
    const char *title, *shows, *source;
    unsigned uses;
    const char *const *scenes;      // default scenes by name, the first is the default; NULL ends it
    const SceneKind *own_scenes;    // made in this chapter; may be NULL
    const RunParameter *parameters; // the chapter's own
    const RunStep *steps;
    const RunRow *sweep, *stability;
} RunAbout;

typedef struct Run Run;

// Parse the command line, check every path and value that can be checked before work begins, open the context.
Run *run_open(const RunAbout *about, int argc, char **argv);
int run_close(Run *run); // finishes files; the exit status

// Next setting; false after the last one. Loads the scene (kept while the next row has the same), builds the camera and lights as set.
bool run_setting(Run *run);
// Next frame of this setting.
bool run_frame(Run *run);

const Scene *run_scene(const Run *run); // with camera, lights and medium as set
Camera run_camera(const Run *run);      // of this frame (orbit, --path)
int run_width(const Run *run);
int run_height(const Run *run);
float run_aspect(const Run *run);
double run_number(const Run *run, const char *name);
int run_integer(const Run *run, const char *name);
vec3 run_vector(const Run *run, const char *name);
const char *run_choice(const Run *run, const char *name);
// strcmp(run_choice(…), choice) == 0; a choice not listed ends the program.
bool run_chosen(const Run *run, const char *name, const char *choice);
// 0, 1, …: fixed steps of 1/60 s for animation. Warm-up and repeats of a measurement are all frame 0, so what is built in frame 0 is measured.
int run_frame_number(const Run *run);
bool run_everything(const Run *run); // --everything: what a pass does inside leaves nothing out either
uint64_t run_seed(const Run *run);   // --seed: what is random is drawn from it
bool run_deforming(const Run *run);  // --path deform: the scene of frame n is moved by the chapter's own rule
const char *run_case(const Run *run);     // name of the sweep row or stability case, or NULL
bool run_measuring_error(const Run *run); // this setting wants run_error (a sweep)
bool run_checking(const Run *run);        // this setting wants run_check (a stability case)
bool run_picture_needed(const Run *run);  // false in sweep and stability rows unless a picture is measured

// Begin a pass; it lasts until the next one, a step or the frame's end. Returns whether to do it: `needed`, or --everything. A pass that is left out is
// listed by --plan with `reason_if_left_out`. After the step at which --step stops, no pass runs. A pass that always runs: run_pass(run, "name", true, NULL).
bool run_pass(Run *run, const char *name, bool needed, const char *reason_if_left_out);
// A name may come again in a frame: its passes are added up. --plan counts fragments, primitives and compute invocations by itself, as the
// renderer does (a software one: in whole blocks of pixels). Strings are kept by pointer: literals.
// As run_pass for work that is not the technique's own (map, G-buffer, display): counted in ms_frame, not in ms_technique.
bool run_pass_common(Run *run, const char *name, bool needed, const char *reason_if_left_out);
// Add to the current pass: a machine-independent count; or how many of its items were left out inside it.
void run_count(Run *run, const char *what, double count);
void run_skipped(Run *run, double skipped, double of);

// The picture (RGBA32F texture, linear radiance, the run's size) of a named step; the last step reached is shown, --step stops there.
void run_step(Run *run, const char *name, GLuint picture);
// Whether this step's picture is the one that will be shown: passes that only paint another can be left out.
bool run_step_shown(const Run *run, const char *name);
Image run_picture(const Run *run); // the shown picture of the last frame, top row first; the caller frees it

// --truth FILE was given: give the picture to write for this setting's view (asked in the last frame and after it). In a sweep with --path it is
// asked in each frame, for flicker. Ask after the frame's last step, so that no pass is charged for it.
bool run_truth_wanted(const Run *run);
void run_truth(Run *run, const Image *truth);

// One row of the sweep's CSV for this setting: reference is "truth" or "converged".
void run_error(Run *run, const char *reference, const char *metric, double error);
// The rows that every picture of radiance gets, each name behind `prefix`: nrmse, rel_rmse, p99_abs, max_abs, mean_ratio (image_compare).
void run_image_errors(Run *run, const char *reference, const Image *got, const Image *expected,
                      const char *prefix);
// One row of the stability CSV: passes where |got − expected| ≤ tolerance and nonfinite is 0.
void run_check(Run *run, const char *quantity, double expected, double got, double tolerance, long nonfinite);

#endif
