// speed: chapter 06's figures of speed from the CSV files that its sweeps wrote, one of each scene, as one table.
//
//     build/speed SWEEP.csv ... OUT.csv
//
// A row of OUT is a setting of the volume. Ratios are of median times, in brackets the middle 95 % of 1000 resamples of both sides' repeats (measure.h):
//   equal_samples  as many shadow rays a pixel as the setting has φ, over the technique's own passes; error: the technique's rel_rmse against the truth over
//                  that of those rays; paper: whether the ratio is at least the 423 of the paper, at an error at most 1.25 of the rays'
//   fewest, equal_error   the fewest rays of all rows that are as near to the truth in rel_rmse, and the ratio of their time
//   frame          equal samples again, depth map and G-buffer in both
//   brute_rel_rmse, brute_nrmse   chapter 04's methods on the same map at the same error against its limit, straight lines in log-log between the settings
//                  that none other beats, over the technique
//   map_share      rel_rmse of the map's limit against the truth, over the technique's against that limit; beyond: whether brute force is at least 10 and 20
//                  times slower, asked where that share is at least 2
// "at most": a cheaper setting than the cheapest that was run might do, too.
#include <math.h>

#include "../csv.h"
#include "measure.h"

enum { PHI = 512, LONGEST = 96 }; // the program's φ where a row sets none
static const double PAPER = 423, ERROR_MOST = 1.25, SHARE_LEAST = 2, BRUTE_REL_RMSE = 10, BRUTE_NRMSE = 20;
static const double UNIT = 1; // the error at which two settings are compared as they are

// What one setting's rows say together.
typedef struct Setting {
    const char *technique, *scene, *settings;
    double *ms, *frame_ms; // of its repeats
    size_t repeats, frame_repeats;
    double truth, converged, converged_nrmse,
        map; // errors; rel_rmse where no other is named; NaN: not in the table
} Setting;

typedef struct Sweeps {
    CsvTable *tables;
    size_t table_count;
    Setting *settings;
    size_t count;
} Sweeps;

static double number(const char *text, const char *what)
{
    char *end;
    const double value = strtod(text, &end);
    if (end == text || *end)
        fail_work("%s is '%s', not a number", what, text);
    return value;
}

static double *numbers(const char *text, size_t *count)
{
    double *all = NULL;
    char *end;
    *count = 0;
    for (double value; value = strtod(text, &end), end != text; text = end) {
        all = memory_grow(all, *count + 1, sizeof *all, "repeats");
        all[(*count)++] = value;
    }
    if (*count < 2)
        fail_work("repeats '%s': an interval needs two or more", text);
    return all;
}

// The value of KEY in "a=1;b=2"; its length; NULL: not there.
static const char *value_of(const Setting *setting, const char *key, size_t *length)
{
    for (const char *at = setting->settings; at; at = strchr(at, ';') ? strchr(at, ';') + 1 : NULL)
        if (strncmp(at, key, strlen(key)) == 0 && at[strlen(key)] == '=') {
            at += strlen(key) + 1;
            *length = strcspn(at, ";");
            return at;
        }
    *length = 0;
    return NULL;
}

static bool same_value(const Setting *a, const Setting *b, const char *key)
{
    size_t length[2];
    const char *text[2] = {value_of(a, key, &length[0]), value_of(b, key, &length[1])};
    return !text[0] == !text[1] && length[0] == length[1] &&
           (!text[0] || strncmp(text[0], text[1], length[0]) == 0);
}

// Samples along a pixel's ray.
static long samples_of(const Setting *setting)
{
    size_t length;
    const char *samples = value_of(setting, "samples", &length), *phi = value_of(setting, "phi", &length);
    const long given = samples ? strtol(samples, NULL, 10) : 0;
    return given > 0 ? given : phi ? strtol(phi, NULL, 10) : PHI;
}

static bool is_rays(const Setting *setting)
{
    return strcmp(setting->technique, "rays") == 0;
}

static bool is_brute(const Setting *setting)
{
    static const char *const names[] = {"march", "jittered", "equiangular", "factored", "segments"};
    bool found = false;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        found |= strcmp(setting->technique, names[i]) == 0;
    return found;
}

static Setting *setting_find(Sweeps *sweeps, const CsvTable *table, size_t row)
{
    const char *technique = csv_table_field(table, row, "technique"),
               *scene = csv_table_field(table, row, "scene"),
               *settings = csv_table_field(table, row, "settings");
    for (size_t i = 0; i < sweeps->count; i++) {
        Setting *known = &sweeps->settings[i];
        if (strcmp(known->technique, technique) == 0 && strcmp(known->scene, scene) == 0 &&
            strcmp(known->settings, settings) == 0)
            return known;
    }
    sweeps->settings = memory_grow(sweeps->settings, sweeps->count + 1, sizeof *sweeps->settings, "settings");
    Setting *made = &sweeps->settings[sweeps->count++];
    *made = (Setting){technique, scene, settings, .truth = NAN, .converged = NAN, .converged_nrmse = NAN};
    made->map = NAN;
    made->ms = numbers(csv_table_field(table, row, "ms_repeats"), &made->repeats);
    made->frame_ms = numbers(csv_table_field(table, row, "ms_frame_repeats"), &made->frame_repeats);
    return made;
}

static void sweep_read(Sweeps *sweeps, const char *path)
{
    sweeps->tables =
        memory_grow(sweeps->tables, sweeps->table_count + 1, sizeof *sweeps->tables, "the sweeps");
    CsvTable *table = &sweeps->tables[sweeps->table_count++];
    *table = csv_table_read(path);
    for (size_t row = 1; row < table->rows; row++) {
        Setting *setting = setting_find(sweeps, table, row);
        const bool truth = strcmp(csv_table_field(table, row, "reference"), "truth") == 0;
        const char *metric = csv_table_field(table, row, "metric");
        const double error = number(csv_table_field(table, row, "error"), "an error");
        if (strcmp(metric, "rel_rmse") == 0)
            *(truth ? &setting->truth : &setting->converged) = error;
        else if (strcmp(metric, "nrmse") == 0 && !truth)
            setting->converged_nrmse = error;
        else if (strcmp(metric, "map_rel_rmse") == 0)
            setting->map = error;
    }
}

// "3.1 (2.9–3.3)".
static void ratio_text(char text[LONGEST], const char *before, Compared ratio)
{
    if (ratio.reach == MEASURE_NOT_REACHED)
        snprintf(text, LONGEST, "not reached");
    else
        snprintf(text, LONGEST, "%s%.3g (%.3g–%.3g)", before, ratio.value, ratio.least, ratio.most);
}

// Of two settings as they are.
static Compared times(const Setting *slow, const Setting *fast, bool frames)
{
    const CurvePoint points[2] = {
        {UNIT, frames ? slow->frame_ms : slow->ms, frames ? slow->frame_repeats : slow->repeats},
        {UNIT, frames ? fast->frame_ms : fast->ms, frames ? fast->frame_repeats : fast->repeats}};
    return measure_speed_up(&points[0], 1, &points[1], 1, UNIT);
}

static double median(const Setting *setting)
{
    return measure_statistics(setting->ms, setting->repeats).median;
}

// Brute force on the row's scene and map over the row, at the row's error.
static Compared brute_force(const Sweeps *sweeps, const Setting *row, bool nrmse, char text[LONGEST])
{
    CurvePoint *brute = memory_new(sweeps->count + 1, sizeof *brute, "brute force");
    size_t count = 0;
    const double error = nrmse ? row->converged_nrmse : row->converged;
    const Setting *cheapest = NULL;
    bool bound = false;
    for (size_t i = 0; i < sweeps->count; i++) {
        const Setting *other = &sweeps->settings[i];
        if (!is_brute(other) || strcmp(other->scene, row->scene) != 0 || !same_value(other, row, "map"))
            continue;
        brute[count] =
            (CurvePoint){nrmse ? other->converged_nrmse : other->converged, other->ms, other->repeats};
        if (!cheapest || median(other) < median(cheapest)) {
            cheapest = other;
            bound = brute[count].error < error;
        }
        count++;
    }
    const CurvePoint own = {error, row->ms, row->repeats};
    const Compared ratio = measure_speed_up(brute, count, &own, 1, error);
    ratio_text(text, bound ? "at most " : "", ratio);
    free(brute);
    return ratio;
}

static void row_write(Csv *csv, const Sweeps *sweeps, const Setting *row)
{
    const Setting *equal = NULL, *fewest = NULL, *least = NULL;
    for (size_t i = 0; i < sweeps->count; i++) {
        const Setting *other = &sweeps->settings[i];
        if (!is_rays(other) || strcmp(other->scene, row->scene) != 0)
            continue;
        const long samples = samples_of(other);
        if (samples == samples_of(row))
            equal = other;
        if (!least || samples < samples_of(least))
            least = other;
        if (other->truth <= row->truth && (!fewest || samples < samples_of(fewest)))
            fewest = other;
    }
    if (!equal)
        fail_work("scene %s, %s: no row of as many rays", row->scene, row->settings);
    char text[5][LONGEST] = {"", "", "not reached", "", ""},
         part[5][LONGEST] = {"", "", "not reached", "", ""};
    const Compared samples = times(equal, row, false);
    const double error = row->truth / equal->truth, share = row->map / row->converged;
    ratio_text(text[0], "", samples);
    ratio_text(text[1], "", times(equal, row, true));
    if (fewest) {
        ratio_text(text[2], fewest == least ? "at most " : "", times(fewest, row, false));
        snprintf(part[2], LONGEST, "%ld%s", samples_of(fewest), fewest == least ? " or fewer" : "");
    }
    const Compared rel_rmse = brute_force(sweeps, row, false, text[3]),
                   nrmse = brute_force(sweeps, row, true, text[4]);
    snprintf(part[0], LONGEST, "%.4f", median(row));
    snprintf(part[1], LONGEST, "%.4f", error);
    snprintf(part[3], LONGEST, "%.4f", share);
    const char *paper = samples.value >= PAPER && error <= ERROR_MOST ? "met" : "not met",
               *beyond = !(share >= SHARE_LEAST)                                          ? "not asked"
                         : rel_rmse.value >= BRUTE_REL_RMSE && nrmse.value >= BRUTE_NRMSE ? "met"
                                                                                          : "not met";
    const char *fields[] = {row->scene, row->settings, part[0], text[0], part[1], paper, part[2],
                            text[2],    text[1],       text[3], text[4], part[3], beyond};
    csv_row(csv, fields, sizeof fields / sizeof *fields);
}

int main(int argc, char **argv)
{
    if (argc < 3)
        fail_request("needed: SWEEP.csv ... OUT.csv");
    Sweeps sweeps = {0};
    for (int i = 1; i < argc - 1; i++)
        sweep_read(&sweeps, argv[i]);
    Machine machine = {0};
    for (size_t i = 0; i < sweeps.tables[0].comment_count && i < MACHINE_LINES; i++)
        machine.lines[i] = sweeps.tables[0].comments[i];
    Csv *csv = csv_open(argv[argc - 1], &machine,
                        "scene,settings,ms,equal_samples,error,paper,fewest,equal_error,frame,"
                        "brute_rel_rmse,brute_nrmse,map_share,beyond");
    for (size_t i = 0; i < sweeps.count; i++) {
        const Setting *row = &sweeps.settings[i];
        if (!is_rays(row) && !is_brute(row) && strcmp(row->technique, "bounds") != 0)
            row_write(csv, &sweeps, row);
    }
    csv_close(csv);
    for (size_t i = 0; i < sweeps.count; i++) {
        free(sweeps.settings[i].ms);
        free(sweeps.settings[i].frame_ms);
    }
    for (size_t i = 0; i < sweeps.table_count; i++)
        csv_table_free(&sweeps.tables[i]);
    free(sweeps.settings);
    free(sweeps.tables);
    return 0;
}
