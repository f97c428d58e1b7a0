// run_tables: the rows of --sweep and --stability: which settings there are, and what is written of each.
#include "run_internal.h"
#include <stdlib.h>
#include <string.h>

static const char *const task_names[] = {[RUN_SWEEP] = "sweep row", [RUN_STABILITY] = "stability case"};
static const char *const headers[] = {
    [RUN_SWEEP] = "chapter,technique,scene,width,height,settings,ms_technique,ms_min,ms_max,ms_frame,"
                  "reference,metric,error,ms_repeats,ms_frame_repeats",
    [RUN_STABILITY] = "chapter,case,quantity,expected,got,error,tolerance,nonfinite,verdict"};

void run_row_apply(const Run *run, const RunRow *row, RunValue *values)
{
    char *rest = text_format("%s", row->settings ? row->settings : ""), *text = rest, *state = NULL;
    for (char *word; (word = strtok_r(rest, " ", &state)); rest = NULL) {
        char *equals = strchr(word, '=');
        if (!equals)
            fail_work("row %s: '%s' is no KEY=VALUE", row->name, word);
        *equals = '\0';
        run_value_parse(run, values, row->name, word, equals + 1);
    }
    free(text);
}

// Whether the name is one of those in `list`, between commas.
static bool listed(const char *list, const char *name)
{
    const size_t length = strlen(name);
    for (const char *at = list; at; at = strchr(at, ',') ? strchr(at, ',') + 1 : NULL)
        if (strcspn(at, ",") == length && strncmp(at, name, length) == 0)
            return true;
    return false;
}

// Whether --row, --set and --scene leave this row: it sets no parameter to another value than --set does.
static bool row_taken(const Run *run, const RunRow *table, const RunRow *row)
{
    if ((run->row && row - table + 1 != run->row) || (run->row_names && !listed(run->row_names, row->name)))
        return false;
    bool taken = !run->scene_given || !row->scene || strcmp(run->scene_given, row->scene) == 0;
    RunValue *values = memory_new(run->parameter_count, sizeof *values, "a row's values");
    run_row_apply(run, row, values);
    for (size_t i = 0; i < run->parameter_count; ++i)
        if (values[i].given && run->asked[i].given)
            taken &= values[i].choice == run->asked[i].choice &&
                     memcmp(values[i].number, run->asked[i].number, sizeof values[i].number) == 0;
    free(values);
    return taken;
}

static void settings_add(Run *run, RunTask task, const RunRow *row, const char *scene)
{
    run->settings = memory_grow(run->settings, run->setting_count + 1, sizeof *run->settings, "the settings");
    run->settings[run->setting_count++] = (RunSetting){task, row, row && row->scene ? row->scene : scene};
}

void run_tables_open(Run *run)
{
    const char *first = run->scene_given ? run->scene_given : run->about->scenes[0];
    const char *const given[] = {run->scene_given, NULL}, *const *scenes =
                                                              run->scene_given ? given : run->about->scenes;
    for (const RunRow *row = run->about->sweep; run->sweep && row->name; ++row)
        for (const char *const *scene = scenes; *scene && row_taken(run, run->about->sweep, row); ++scene) {
            settings_add(run, RUN_SWEEP, row, *scene);
            if (row->scene)
                break;
        }
    if (run->sweep && !run->setting_count)
        fail_request("--sweep: --row, --set or --scene leaves no row of this chapter's sweep");
    size_t before = run->setting_count;
    for (const RunRow *row = run->about->stability; run->stability && row->name; ++row)
        if (row_taken(run, run->about->stability, row))
            settings_add(run, RUN_STABILITY, row, first);
    if (run->stability && run->setting_count == before)
        fail_request("--stability: --row, --set or --scene leaves no case of this chapter's table");
    const char *paths[] = {[RUN_SWEEP] = run->sweep, [RUN_STABILITY] = run->stability};
    if (!run->setting_count) {
        settings_add(run, RUN_PICTURE, NULL, first);
        return;
    }
    Machine machine = measure_machine((const char *)gl.GetString(GL_RENDERER),
                                      (const char *)gl.GetString(GL_VERSION), run->argc, run->argv);
    for (int task = RUN_SWEEP; task <= RUN_STABILITY; ++task)
        if (paths[task])
            run->tables[task] = csv_open(paths[task], &machine, headers[task]);
    measure_machine_free(&machine);
}

void run_tables_close(Run *run)
{
    for (int task = RUN_SWEEP; task <= RUN_STABILITY; ++task)
        if (run->tables[task])
            csv_close(run->tables[task]);
}

// Fields parted by tabs; takes the line.
static void row_write(Run *run, RunTask task, char *line)
{
    const char *fields[16]; // more than the headers above have columns
    size_t count = 0;
    if (!run->setting || run->setting->task != task)
        fail_work("a row of the wrong table: ask run_measuring_error, run_checking");
    for (char *rest = line; rest;)
        fields[count++] = strsep(&rest, "\t");
    csv_row(run->tables[task], fields, count);
    ++run->rows_of_setting;
    free(line);
}

// What a row sets, then what --set adds, as "steps=64;dither=blue".
static char *settings_text(const Run *run)
{
    char *all = NULL;
    size_t bytes = 0;
    FILE *to = open_memstream(&all, &bytes);
    const char *between = "";
    for (size_t i = 0; i < run->parameter_count; ++i)
        if (run->values[i].given) {
            char *value = run_value_text(run, i, &run->values[i]);
            fprintf(to, "%s%s=%s", between, run->parameters[i].name, value);
            free(value);
            between = ";";
        }
    fclose(to);
    return all;
}

// Repeats in the order of their running, as "1.2 1.1 1.3", so that whoever compares two medians can say how sure that is.
static char *repeats_text(const double *ms, size_t count)
{
    char *all = NULL;
    size_t bytes = 0;
    FILE *to = open_memstream(&all, &bytes);
    for (size_t i = 0; i < count; ++i)
        fprintf(to, "%s%.4f", i ? " " : "", ms[i]);
    fclose(to);
    return all;
}

void run_error(Run *run, const char *reference, const char *metric, double error)
{
    if (isnan(error))
        fail_work("sweep row %s, scene %s: %s is not a number", run_case(run), run->scene_name, metric);
    Statistics technique = measure_statistics(run->technique_ms, run->repeats);
    Statistics frame = measure_statistics(run->frame_ms, run->repeats);
    char *settings = settings_text(run), *repeats = repeats_text(run->technique_ms, run->repeats),
         *frames = repeats_text(run->frame_ms, run->repeats);
    row_write(run, RUN_SWEEP,
              text_format("%s\t%s\t%s\t%d\t%d\t%s\t%.4f\t%.4f\t%.4f\t%.4f\t%s\t%s\t%.9g\t%s\t%s",
                          run->about->chapter, run_case(run), run->scene_name, run->width, run->height,
                          settings, technique.median, technique.least, technique.most, frame.median,
                          reference, metric, error, repeats, frames));
    free(settings);
    free(repeats);
    free(frames);
}

void run_image_errors(Run *run, const char *reference, const Image *got, const Image *expected,
                      const char *prefix)
{
    const ImageError e = image_compare(got, expected);
    const struct {
        const char *name;
        double value;
    } rows[] = {{"nrmse", e.nrmse},
                {"rel_rmse", e.rel_rmse},
                {"p99_abs", e.p99_abs},
                {"max_abs", e.max_abs},
                {"mean_ratio", e.mean_ratio}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char *metric = text_format("%s%s", prefix, rows[i].name);
        run_error(run, reference, metric, rows[i].value);
        free(metric);
    }
}

void run_check(Run *run, const char *quantity, double expected, double got, double tolerance, long nonfinite)
{
    double error = got == expected ? 0 : fabs(got - expected); // an expected infinity is met by the same
    bool passed = error <= tolerance && nonfinite == 0;        // NaN passes nothing
    row_write(run, RUN_STABILITY,
              text_format("%s\t%s\t%s\t%.9g\t%.9g\t%.3g\t%.3g\t%ld\t%s", run->about->chapter, run_case(run),
                          quantity, expected, got, error, tolerance, nonfinite, passed ? "pass" : "fail"));
    run->failed += !passed;
    ++run->checked;
}

// A row that measured nothing would be missing without a word.
void run_tables_setting_end(Run *run)
{
    if (run->setting && run->setting->task != RUN_PICTURE && run->rows_of_setting == 0)
        fail_work("%s %s, scene %s: nothing was measured", task_names[run->setting->task], run_case(run),
                  run->scene_name);
    run->rows_of_setting = 0;
}

// flicker: rms over frames and pixels of (frame change − the truth's change), so of the change of (picture − truth).
void run_flicker_frame(Run *run)
{
    if (!run->truth_now.pixels)
        fail_request("--path with --sweep: %s gives no truth for its frames, so no flicker", run_case(run));
    Image now = run_picture(run), *before = &run->flicker_before;
    for (long i = 0; i < 3L * now.width * now.height; ++i) {
        now.pixels[i] -= run->truth_now.pixels[i / 3 * run->truth_now.channels + i % 3];
        double change = before->pixels ? (double)now.pixels[i] - (double)before->pixels[i] : 0;
        run->flicker_sum += change * change;
        run->flicker_values += before->pixels != NULL;
    }
    image_free(before);
    image_free(&run->truth_now);
    *before = now;
}

void run_flicker_end(Run *run)
{
    run_error(run, "truth", "flicker", sqrt(run->flicker_sum / (double)run->flicker_values));
    image_free(&run->flicker_before);
    run->flicker_sum = 0;
    run->flicker_values = 0;
}
