// figure: work-precision diagrams from the CSV file that --sweep wrote: one figure a scene.
//
//     build/figure SWEEP.csv --metric NAME [--scene SCENE] [--technique PATTERN] [--reference NAME] OUT.svg|OUT.png
//
// With several scenes each figure's name carries its scene: OUT-cornell.svg.
#include <argp.h>
#include <ctype.h>
#include <fnmatch.h>
#include <math.h>
#include <string.h>

#include "../csv.h"
#include "measure.h"

typedef struct Request {
    const char *sweep, *out, *metric, *scene, *technique, *reference;
} Request;

static const struct argp_option options[] = {
    {"metric", 'm', "NAME", 0, "The metric to draw, as in the file's column", 0},
    {"scene", 's', "SCENE", 0, "Only this scene (default: a figure each)", 0},
    {"technique", 't', "PATTERN", 0,
     "Only techniques whose names fit, as file names in a shell: 'bias*', '@(cube|rays)'", 0},
    {"reference", 'r', "NAME", 0, "Only errors against this: truth, converged", 0},
    {0},
};

static error_t parse(int key, char *argument, struct argp_state *state)
{
    Request *request = state->input;
    switch (key) {
    case 'm':
        request->metric = argument;
        return 0;
    case 's':
        request->scene = argument;
        return 0;
    case 't':
        request->technique = argument;
        return 0;
    case 'r':
        request->reference = argument;
        return 0;
    case ARGP_KEY_ARG:
        if (state->arg_num >= 2)
            fail_request("'%s': one sweep and one picture are needed, this is a third file", argument);
        *(state->arg_num ? &request->out : &request->sweep) = argument;
        return 0;
    case ARGP_KEY_END:
        if (state->arg_num < 2 || !request->metric)
            fail_request("needed: SWEEP.csv --metric NAME OUT.svg|OUT.png");
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static double number(const CsvTable *table, size_t row, const char *header)
{
    const char *text = csv_table_field(table, row, header);
    char *end;
    double value = strtod(text, &end);
    if (end == text || *end)
        fail_work("row %zu: %s is '%s', not a number", row, header, text);
    return value;
}

static bool same(const CsvTable *table, size_t row, const char *header, const char *text)
{
    return !text || strcmp(csv_table_field(table, row, header), text) == 0;
}

// A row that the request asks for. One with an exact stage (oracle=map) is no point of its technique: make report draws those.
static bool wanted(const CsvTable *table, size_t row, const Request *request)
{
    return same(table, row, "metric", request->metric) && same(table, row, "scene", request->scene) &&
           same(table, row, "reference", request->reference) &&
           !strstr(csv_table_field(table, row, "settings"), "oracle=") &&
           (!request->technique ||
            fnmatch(request->technique, csv_table_field(table, row, "technique"), FNM_EXTMATCH) == 0);
}

// The technique; with what else the curve must be told apart by, where the figure's rows differ in it.
static char *curve_name(const CsvTable *table, const size_t *rows, size_t count, size_t row)
{
    static const char *const parts[] = {"width", "height", "reference"};
    char *name = text_format("%s", csv_table_field(table, row, "technique"));
    for (size_t part = 0; part < sizeof parts / sizeof *parts; part++) {
        bool uniform = true;
        for (size_t i = 0; i < count; i++)
            uniform &= same(table, rows[i], parts[part], csv_table_field(table, row, parts[part]));
        if (!uniform) {
            char *longer =
                text_format("%s, %s %s", name, parts[part], csv_table_field(table, row, parts[part]));
            free(name);
            name = longer;
        }
    }
    return name;
}

static void draw(const CsvTable *table, const Request *request, const char *scene, const char *path)
{
    Machine machine = {0};
    for (size_t i = 0; i < table->comment_count && i < MACHINE_LINES; i++)
        machine.lines[i] = table->comments[i];
    size_t *rows = memory_new(table->rows, sizeof *rows, "figure"), count = 0;
    for (size_t row = 1; row < table->rows; row++)
        if (same(table, row, "scene", scene) && wanted(table, row, request))
            rows[count++] = row;
    FigurePoint *points = memory_new(count, sizeof *points, "figure");
    char **names = memory_new(count, sizeof *names, "figure");
    for (size_t i = 0; i < count; i++) {
        names[i] = curve_name(table, rows, count, rows[i]);
        points[i] = (FigurePoint){
            .technique = names[i],
            .ms = number(table, rows[i], "ms_technique"),
            .ms_least = number(table, rows[i], "ms_min"),
            .ms_most = number(table, rows[i], "ms_max"),
            .error = number(table, rows[i], "error"),
        };
    }
    char *title =
        text_format("%s, %s, %sx%s, against %s", csv_table_field(table, rows[0], "chapter"), scene,
                    csv_table_field(table, rows[0], "width"), csv_table_field(table, rows[0], "height"),
                    csv_table_field(table, rows[0], "reference"));
    measure_figure(path, title, request->metric, points, count, &machine);
    printf("%s\n", path);
    free(title);
    for (size_t i = 0; i < count; i++)
        free(names[i]);
    free(names);
    free(points);
    free(rows);
}

int main(int argc, char **argv)
{
    const struct argp argp = {
        options, parse, "SWEEP.csv OUT", "Error over run time from a sweep (OUT: .svg, .png).", NULL,
        NULL,    NULL};
    Request request = {0};
    argp_err_exit_status = 2;
    argp_parse(&argp, argc, argv, 0, NULL, &request);

    CsvTable table = csv_table_read(request.sweep);
    const char **scenes = memory_new(table.rows, sizeof *scenes, "figure");
    size_t count = 0;
    for (size_t row = 1; row < table.rows; row++) {
        bool another = wanted(&table, row, &request);
        for (size_t i = 0; i < count && another; i++)
            another = !same(&table, row, "scene", scenes[i]);
        if (another)
            scenes[count++] = csv_table_field(&table, row, "scene");
    }
    if (!count)
        fail_request("%s: no row has metric '%s'%s%s%s%s%s%s; the first row's metric is '%s'", request.sweep,
                     request.metric, request.scene ? " and scene " : "", request.scene ? request.scene : "",
                     request.technique ? " and technique " : "", request.technique ? request.technique : "",
                     request.reference ? " and reference " : "", request.reference ? request.reference : "",
                     table.rows > 1 ? csv_table_field(&table, 1, "metric") : "missing");
    for (size_t i = 0; i < count; i++) {
        const char *dot = strrchr(request.out, '.'), *end = dot ? dot : request.out + strlen(request.out);
        char *path = text_format("%.*s%s%s%s", (int)(end - request.out), request.out, count > 1 ? "-" : "",
                                 count > 1 ? scenes[i] : "", end);
        for (char *c = path + (end - request.out); count > 1 && c < path + strlen(path) - strlen(end); c++)
            *c = isalnum((unsigned char)*c) ? *c : '-'; // a scene may be a file's path
        draw(&table, &request, scenes[i], path);
        free(path);
    }
    free(scenes);
    csv_table_free(&table);
    return 0;
}
