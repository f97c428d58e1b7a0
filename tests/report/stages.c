// report: from which stage the error comes, by rows in which one stage was exact (oracle=map); and how far apart the techniques are at their
// limits, by pictures.
#include "report.h"

#include <math.h>

// Settings without their oracle: rows with equal ones form a bar. The caller frees it.
static char *without_oracle(const char *settings)
{
    char *rest = text_format("%s", ""), *longer;
    for (const char *at = settings; *at; at += strcspn(at, ";"), at += *at == ';') {
        if (strncmp(at, "oracle=", 7) == 0)
            continue;
        longer = text_format("%s%s%.*s", rest, *rest ? ";" : "", (int)strcspn(at, ";"), at);
        free(rest);
        rest = longer;
    }
    return rest;
}

static bool same_bar(const SweepRow *a, const SweepRow *b)
{
    char *x = without_oracle(a->settings), *y = without_oracle(b->settings);
    bool same = strcmp(a->technique, b->technique) == 0 && strcmp(x, y) == 0;
    free(x);
    free(y);
    return same;
}

// Whether a row of the group with the same technique has another value of this setting ("steps=64").
static bool varies(const SweepRow **group, size_t count, const SweepRow *row, const char *setting)
{
    char *key = text_format("%.*s", (int)strcspn(setting, "="), setting),
         *value = setting_of(row->settings, key);
    bool differs = false;
    for (size_t i = 0; i < count && !differs; i++) {
        char *other = setting_of(group[i]->settings, key);
        differs = strcmp(group[i]->technique, row->technique) == 0 && (!other || strcmp(other, value) != 0);
        free(other);
    }
    free(key);
    free(value);
    return differs;
}

// The technique; under it the settings by which the group's rows of this technique differ, the oracle apart. The caller frees it.
static char *bar_name(const SweepRow **group, size_t count, const SweepRow *row)
{
    char *rest = without_oracle(row->settings), *name = text_format("%s", row->technique);
    for (char *from = rest, *setting; (setting = strsep(&from, ";")) != NULL;)
        if (*setting && varies(group, count, row, setting)) {
            char *longer = text_format("%s\n%s", name, setting);
            free(name);
            name = longer;
        }
    free(rest);
    return name;
}

// Errors of independent stages add in their squares: with stage s exact, E² falls by that stage's part. Parts of a bar of height E are in
// proportion to those falls; where they add to more than E² (stages that are not independent) they are scaled to it.
static void bar_parts(double error, const double *without, size_t stages, double *parts)
{
    double sum = 0, squared = error * error;
    for (size_t s = 0; s < stages; s++) {
        parts[s] = isfinite(without[s]) ? fmax(0, squared - without[s] * without[s]) : 0;
        sum += parts[s];
    }
    double whole = fmax(sum, squared);
    for (size_t s = 0; s < stages; s++)
        parts[s] = whole > 0 ? error * parts[s] / whole : 0;
    parts[stages] = whole > 0 ? error * (whole - sum) / whole : 0;
}

static size_t stages_of(const SweepRow **group, size_t count, const char **stages)
{
    size_t found = 0;
    for (size_t i = 0; i < count; i++) {
        char *oracle = oracle_of(group[i]);
        size_t s = 0;
        while (oracle && s < found && strcmp(stages[s], oracle) != 0)
            s++;
        if (oracle && s == found)
            stages[found++] = oracle;
        else
            free(oracle);
    }
    return found;
}

// Each bar as a whole, its error under its name: errors of methods lie powers of ten apart, and of a bar too short to be seen no stage could be told.
static void shares_draw(const char *path, const char *title, const SweepRow *row, const FigureBars *bars,
                        const Machine *machine)
{
    double *shares = memory_new(bars->bar_count * bars->part_count, sizeof *shares, "bars");
    char **names = memory_new(bars->bar_count, sizeof *names, "bars"),
         *axis = text_format("share of %s", row->metric);
    for (size_t b = 0; b < bars->bar_count; b++) {
        const double *parts = bars->values + b * bars->part_count;
        double error = 0;
        for (size_t p = 0; p < bars->part_count; p++)
            error += parts[p];
        for (size_t p = 0; p < bars->part_count && error > 0; p++)
            shares[b * bars->part_count + p] = parts[p] / error;
        names[b] = text_format("%s\n%.2g", bars->bars[b], error);
    }
    measure_bars(
        path, title, axis,
        &(FigureBars){(const char *const *)names, bars->parts, bars->bar_count, bars->part_count, shares},
        machine);
    for (size_t b = 0; b < bars->bar_count; b++)
        free(names[b]);
    free(names);
    free(shares);
    free(axis);
}

static void bars_draw(FILE *page, const Chapter *chapter, const SweepRow *row, const FigureBars *bars)
{
    char *label = text_format("%s-budget", chapter->name), *name = group_name(label, row),
         *title = text_format("where the error comes from: %s, %sx%s, against %s", row->scene, row->width,
                              row->height, row->reference);
    static const char *const endings[] = {"svg", "png"};
    for (int i = 0; i < 2; i++) {
        char *path = text_format("%s/%s.%s", chapter->folder, name, endings[i]);
        shares_draw(path, title, row, bars, &chapter->machine);
        free(path);
    }
    char *path = text_format("%s/%s.csv", chapter->folder, name);
    Csv *csv = csv_open(path, &chapter->machine, "bar,stage,part");
    for (size_t b = 0; b < bars->bar_count; b++)
        for (size_t p = 0; p < bars->part_count; p++) {
            char *value = text_format("%.9g", bars->values[b * bars->part_count + p]);
            csv_row(csv, (const char *const[]){bars->bars[b], bars->parts[p], value}, 3);
            free(value);
        }
    csv_close(csv);
    page_figure(page, chapter->folder, name,
                "A bar is the error E of a row, which stands under it. With a stage exact it is E', and the "
                "stage's part is in "
                "proportion to E² − E'²; where the parts "
                "add to more than E² they are scaled to it.",
                &chapter->machine);
    free(path);
    free(title);
    free(name);
    free(label);
}

static void budget_group(FILE *page, const Chapter *chapter, const SweepRow **group, size_t count)
{
    const char **stages = memory_new(count + 1, sizeof *stages, "stages"),
               **bars = memory_new(count, sizeof *bars, "bars");
    size_t found = stages_of(group, count, stages), bar_count = 0;
    double *values = memory_new(count * (found + 1), sizeof *values, "bars"),
           *without = memory_new(found + 1, sizeof *without, "bars");
    for (size_t i = 0; i < count && found; i++) {
        char *oracle = oracle_of(group[i]);
        bool any = false;
        for (size_t s = 0; s < found; s++)
            without[s] = NAN;
        for (size_t k = 0; k < count && !oracle; k++) {
            char *exact = oracle_of(group[k]);
            for (size_t s = 0; exact && s < found; s++)
                if (strcmp(stages[s], exact) == 0 && same_bar(group[i], group[k])) {
                    without[s] = group[k]->error;
                    any = true;
                }
            free(exact);
        }
        if (any) {
            bar_parts(group[i]->error, without, found, &values[bar_count * (found + 1)]);
            bars[bar_count++] = bar_name(group, count, group[i]);
        }
        free(oracle);
    }
    stages[found] = "rest";
    if (bar_count)
        bars_draw(page, chapter, group[0], &(FigureBars){bars, stages, bar_count, found + 1, values});
    for (size_t s = 0; s < found; s++)
        free((char *)stages[s]);
    for (size_t b = 0; b < bar_count; b++)
        free((char *)bars[b]);
    free(values);
    free(without);
    free(stages);
    free(bars);
}

void budget_write(FILE *page, const Chapter *chapter)
{
    const SweepRow **group = memory_new(chapter->row_count + 1, sizeof(SweepRow *), "error budget");
    bool headed = false;
    for (size_t i = 0; i < chapter->row_count; i++) {
        char *oracle = oracle_of(&chapter->rows[i]);
        if (oracle && !headed)
            fputs("<h3>Where the error comes from</h3>\n", page);
        headed |= oracle != NULL;
        free(oracle);
    }
    for (size_t first = 0; first < chapter->row_count && headed; first++)
        if (group_begins(chapter->rows, chapter->row_count, first, true))
            budget_group(page, chapter, group,
                         group_of(chapter->rows, chapter->row_count, first, true, group));
    free(group);
}

// A picture at a limit, and what its line and column are called.
typedef struct Limit {
    Image image;
    char *name;
    const char *options;
} Limit;

static size_t limits_read(const Chapter *const *chapters, size_t count, Limit *limits)
{
    size_t read = 0;
    for (size_t c = 0; c < count; c++)
        for (size_t i = 0; i < chapters[c]->limits.count; i++) {
            const char *const *fields = chapters[c]->limits.lines[i].fields;
            char *path = text_format("%s/%s", chapters[c]->folder, fields[1]);
            limits[read++] = (Limit){image_read(path),
                                     count > 1 ? text_format("%.2s %s", chapters[c]->name, fields[0])
                                               : text_format("%s", fields[0]),
                                     fields[2]};
            free(path);
        }
    return read;
}

static char *distance_text(const Image *a, const Image *b)
{
    if (a->width != b->width || a->height != b->height || a->channels != b->channels)
        return text_format("another size");
    return text_format("%.3g", image_compare(a, b).nrmse);
}

void consistency_write(FILE *page, const char *folder, const Chapter *const *chapters, size_t count)
{
    size_t most = 0;
    for (size_t c = 0; c < count; c++)
        most += chapters[c]->limits.count;
    if (!most)
        return;
    fputs("<h3>At their limits</h3>\n<p class=\"quiet\">nrmse of each line's picture against each column's; "
          "all should tend to the same "
          "picture.</p>\n",
          page);
    Limit *limits = memory_new(most, sizeof *limits, "limits");
    const size_t all = limits_read(chapters, count, limits);
    char *header = text_format("limit,options");
    for (size_t i = 0; i < all; i++) {
        char *longer = text_format("%s,%s", header, limits[i].name);
        free(header);
        header = longer;
    }
    Table table = table_begin(page, folder, "consistency", &chapters[0]->machine, header);
    const char **fields = memory_new(all + 2, sizeof *fields, "limits");
    for (size_t i = 0; i < all; i++) {
        fields[0] = limits[i].name;
        fields[1] = limits[i].options;
        for (size_t k = 0; k < all; k++)
            fields[2 + k] = distance_text(&limits[i].image, &limits[k].image);
        table_row(&table, fields);
        for (size_t k = 0; k < all; k++)
            free((char *)fields[2 + k]);
    }
    table_end(&table);
    for (size_t i = 0; i < all; i++) {
        image_free(&limits[i].image);
        free(limits[i].name);
    }
    free(fields);
    free(limits);
    free(header);
}
