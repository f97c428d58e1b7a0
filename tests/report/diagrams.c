// report: work-precision diagrams, and what they say in numbers.
#include "report.h"

#include <math.h>

// The curves of a group, brute force first, each as the points that measure compares.
typedef struct Curve {
    const char *name;
    CurvePoint *points;
    const SweepRow **rows;
    size_t count;
    bool brute;
} Curve;

static size_t curves_make(const SweepRow **group, size_t count, Curve *curves)
{
    size_t made = 0;
    for (int brute = 1; brute >= 0; brute--)
        for (size_t i = 0; i < count; i++) {
            const SweepRow *row = group[i];
            size_t k = 0;
            while (k < made && strcmp(curves[k].name, row->curve) != 0)
                k++;
            if (row->brute != (brute == 1))
                continue;
            if (k == made)
                curves[made++] = (Curve){row->curve, memory_new(count, sizeof(CurvePoint), "curve"),
                                         memory_new(count, sizeof(SweepRow *), "curve"), 0, row->brute};
            curves[k].rows[curves[k].count] = row;
            curves[k].points[curves[k].count++] = (CurvePoint){row->error, row->repeats, row->repeat_count};
        }
    return made;
}

static bool figure_draw(const char *folder, const char *name, const SweepRow **group, size_t count,
                        const Curve *curves, size_t curve_count, const Machine *machine)
{
    FigurePoint *points = memory_new(count, sizeof *points, "figure");
    size_t used = 0;
    bool any = false;
    for (size_t k = 0; k < curve_count; k++)
        for (size_t i = 0; i < curves[k].count; i++) {
            const SweepRow *row = curves[k].rows[i];
            points[used++] = (FigurePoint){curves[k].name, row->ms, row->ms_least, row->ms_most, row->error};
            any |= isfinite(row->ms) && isfinite(row->error);
        }
    char *title = text_format("%s, %sx%s, against %s", group[0]->scene, group[0]->width, group[0]->height,
                              group[0]->reference);
    static const char *const endings[] = {"svg", "png"};
    for (int i = 0; i < 2 && any; i++) {
        char *path = text_format("%s/%s.%s", folder, name, endings[i]);
        measure_figure(path, title, group[0]->metric, points, used, machine);
        free(path);
    }
    free(title);
    free(points);
    return any;
}

static void points_write(const char *folder, const char *name, const SweepRow **group, size_t count,
                         const Machine *machine)
{
    char *path = text_format("%s/%s.csv", folder, name);
    Csv *csv = csv_open(path, machine, "curve,chapter,technique,settings,ms_technique,ms_min,ms_max,error");
    for (size_t i = 0; i < count; i++) {
        const SweepRow *row = group[i];
        char *ms = text_format("%.4f", row->ms), *least = text_format("%.4f", row->ms_least),
             *most = text_format("%.4f", row->ms_most), *error = text_format("%.9g", row->error);
        csv_row(csv,
                (const char *const[]){row->curve, row->chapter, row->technique, row->settings, ms, least,
                                      most, error},
                8);
        free(ms);
        free(least);
        free(most);
        free(error);
    }
    csv_close(csv);
    free(path);
}

static const char *const reaches[] = {
    [MEASURE_REACHED] = "reached", [MEASURE_BOUND] = "bound", [MEASURE_NOT_REACHED] = "not reached"};

// "12.3×, 11.0 to 13.1"; "≥ 12.3× …"; "not reached".
static char *speed_up_text(const Compared *c)
{
    if (c->reach == MEASURE_NOT_REACHED)
        return text_format("not reached");
    const char *least = c->reach == MEASURE_BOUND ? "≥ " : "";
    return isfinite(c->least) ? text_format("%s%.3g× (%.3g to %.3g)", least, c->value, c->least, c->most)
                              : text_format("%s%.3g× (no interval: one repeat)", least, c->value);
}

static char *error_text(const Compared *c)
{
    return c->reach == MEASURE_NOT_REACHED
               ? text_format("not reached")
               : text_format("%s%.3g", c->reach == MEASURE_BOUND && c->value > 0 ? "≤ " : "", c->value);
}

static void compared_write(Csv *csv, const char *technique, const SweepRow *brute, const Compared *c)
{
    char *error = text_format("%.9g", brute->error), *ms = text_format("%.4f", brute->ms),
         *value = text_format("%.6g", c->value), *least = text_format("%.6g", c->least),
         *most = text_format("%.6g", c->most);
    csv_row(
        csv,
        (const char *const[]){technique, brute->settings, error, ms, reaches[c->reach], value, least, most},
        8);
    free(error);
    free(ms);
    free(value);
    free(least);
    free(most);
}

// The curve's points that pose the same problem as the row; the count.
static size_t points_like(const Curve *curve, const SweepRow *row, CurvePoint *points)
{
    size_t count = 0;
    for (size_t i = 0; i < curve->count; i++)
        if (strcmp(curve->rows[i]->problem, row->problem) == 0)
            points[count++] = curve->points[i];
    return count;
}

static Compared compare(const Curve *brute, const Curve *other, const SweepRow *row, bool equal_time)
{
    CurvePoint *of_brute = memory_new(brute->count + other->count, sizeof *of_brute, "comparison"),
               *of_other = of_brute + brute->count;
    size_t brute_count = points_like(brute, row, of_brute), other_count = points_like(other, row, of_other);
    Compared compared = equal_time
                            ? measure_error_at(of_other, other_count, row->ms)
                            : measure_speed_up(of_brute, brute_count, of_other, other_count, row->error);
    free(of_brute);
    return compared;
}

// One line a setting of brute force, one column a technique.
static void comparison_write(FILE *page, const char *folder, const char *name, const Curve *curves,
                             size_t count, bool equal_time, const Machine *machine)
{
    const Curve *brute = &curves[0];
    char *path = text_format("%s/%s.equal_%s.csv", folder, name, equal_time ? "time" : "error");
    Csv *csv =
        csv_open(path, machine,
                 equal_time ? "technique,brute_settings,brute_error,brute_ms,reach,error,least,most"
                            : "technique,brute_settings,brute_error,brute_ms,reach,speed_up,least,most");
    fprintf(page, "<details%s><summary>%s</summary><div class=\"scroll\"><table>\n<tr><th>",
            equal_time ? "" : " open",
            equal_time ? "Error in an equal time" : "Speed-up at an equal error (bootstrap 95 % interval)");
    page_text(page, brute->name);
    fputs("</th><th>error</th><th>ms</th>", page);
    for (size_t k = 1; k < count; k++) {
        fputs("<th>", page);
        page_text(page, curves[k].name);
        fputs("</th>", page);
    }
    fputs("</tr>\n", page);
    for (size_t i = 0; i < brute->count; i++) {
        const SweepRow *row = brute->rows[i];
        fputs("<tr><td>", page);
        page_text(page, row->settings);
        fprintf(page, "</td><td>%.3g</td><td>%.3g</td>", row->error, row->ms);
        for (size_t k = 1; k < count; k++) {
            Compared c = compare(brute, &curves[k], row, equal_time);
            compared_write(csv, curves[k].name, row, &c);
            char *text = equal_time ? error_text(&c) : speed_up_text(&c);
            fputs("<td>", page);
            page_text(page, text);
            fputs("</td>", page);
            free(text);
        }
        fputs("</tr>\n", page);
    }
    fputs("</table></div></details>\n", page);
    csv_close(csv);
    free(path);
}

static void group_write(FILE *page, const char *folder, const char *label, const SweepRow **group,
                        size_t count, const Machine *machine)
{
    char *name = group_name(label, group[0]);
    Curve *curves = memory_new(count, sizeof *curves, "curves");
    size_t curve_count = curves_make(group, count, curves);
    bool drawn = figure_draw(folder, name, group, count, curves, curve_count, machine);
    points_write(folder, name, group, count, machine);
    if (drawn) {
        char *caption =
            text_format("%s over run time, %s, %s x %s pixels, against %s.", group[0]->metric,
                        group[0]->scene, group[0]->width, group[0]->height,
                        strcmp(group[0]->reference, "truth") == 0 ? "the truth" : group[0]->reference);
        page_figure(page, folder, name, caption, machine);
        free(caption);
    } else {
        fputs("<p class=\"bad\">", page);
        page_format(page, "%s: none of %zu points has a finite time and error.", name, count);
        fputs("</p>\n", page);
    }
    if (!curves[0].brute) {
        fputs("<p class=\"bad\">", page);
        page_format(page, "%s: no row of brute force, so nothing to compare with.", name);
        fputs("</p>\n", page);
    } else if (curve_count > 1) {
        comparison_write(page, folder, name, curves, curve_count, false, machine);
        comparison_write(page, folder, name, curves, curve_count, true, machine);
    }
    for (size_t k = 0; k < curve_count; k++) {
        free(curves[k].points);
        free(curves[k].rows);
    }
    free(curves);
    free(name);
}

void diagrams_write(FILE *page, const char *folder, const char *label, const SweepRow *rows, size_t count,
                    const Machine *machine)
{
    const SweepRow **group = memory_new(count + 1, sizeof(SweepRow *), "a diagram's rows");
    for (size_t first = 0; first < count; first++)
        if (group_begins(rows, count, first, false)) {
            size_t members = group_of(rows, count, first, false, group);
            group_write(page, folder, label, group, members, machine);
        }
    free(group);
}
