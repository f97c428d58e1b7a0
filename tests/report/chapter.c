// report: what a chapter's programs have written, and what its author tells of it.
#include "report.h"

#include <ctype.h>
#include <math.h>
#include <sys/stat.h>

TextLines lines_read(const char *path)
{
    TextLines lines = {.text = file_read(path, NULL)};
    char *rest = lines.text;
    for (char *line; rest && (line = strsep(&rest, "\n"));) {
        if (!*line || *line == '#')
            continue;
        lines.lines = memory_grow(lines.lines, lines.count + 1, sizeof *lines.lines, path);
        TextLine *into = &lines.lines[lines.count++];
        for (size_t i = 0; i < LINE_FIELDS; i++) {
            const char *field = line ? strsep(&line, "\t") : NULL;
            into->fields[i] = field ? field : "";
        }
    }
    return lines;
}

static void lines_free(TextLines *lines)
{
    free(lines->text);
    free(lines->lines);
}

const char *chapter_told(const Chapter *chapter, const char *key)
{
    for (size_t i = 0; i < chapter->told.count; i++)
        if (strcmp(chapter->told.lines[i].fields[0], key) == 0)
            return chapter->told.lines[i].fields[1];
    return NULL;
}

bool chapter_tells(const Chapter *chapter, const char *key, const char *value, bool unless_any)
{
    bool any = false, tells = false;
    for (size_t i = 0; i < chapter->told.count; i++)
        if (strcmp(chapter->told.lines[i].fields[0], key) == 0) {
            any = true;
            tells |= strcmp(chapter->told.lines[i].fields[1], value) == 0;
        }
    return tells || (unless_any && !any);
}

static CsvTable table_read(const char *folder, const char *name)
{
    char *path = text_format("%s/%s", folder, name);
    struct stat is;
    CsvTable table = stat(path, &is) == 0 ? csv_table_read(path) : (CsvTable){0};
    free(path);
    return table;
}

static double number(const CsvTable *table, size_t row, const char *header)
{
    const char *text = csv_table_field(table, row, header);
    char *end;
    double value = strtod(text, &end);
    if (end == text || *end)
        fail_work("a sweep's row %zu: %s is '%s', not a number", row, header, text);
    return value;
}

static bool has_column(const CsvTable *table, const char *header)
{
    for (size_t i = 0; i < table->columns; i++)
        if (strcmp(table->fields[i], header) == 0)
            return true;
    return false;
}

// Rows of a sweep without repeats (an older one) have one: the median.
static void repeats_read(const CsvTable *table, size_t row, SweepRow *into)
{
    const char *text = has_column(table, "ms_repeats") ? csv_table_field(table, row, "ms_repeats") : "";
    char *end;
    for (double ms; ms = strtod(text, &end), end != text; text = end) {
        into->repeats = memory_grow(into->repeats, into->repeat_count + 1, sizeof ms, "repeats");
        into->repeats[into->repeat_count++] = ms;
    }
    if (!into->repeat_count) {
        into->repeats = memory_new(1, sizeof *into->repeats, "repeats");
        into->repeats[into->repeat_count++] = into->ms;
    }
}

static void rows_read(Chapter *chapter)
{
    const CsvTable *table = &chapter->sweep;
    chapter->rows = memory_new(table->rows + 1, sizeof *chapter->rows, "rows");
    for (size_t row = 1; row < table->rows; row++) {
        const char *metric = csv_table_field(table, row, "metric");
        if (!chapter_tells(chapter, "metric", metric, true))
            continue;
        SweepRow *into = &chapter->rows[chapter->row_count++];
        *into = (SweepRow){
            .chapter = csv_table_field(table, row, "chapter"),
            .technique = csv_table_field(table, row, "technique"),
            .scene = csv_table_field(table, row, "scene"),
            .width = csv_table_field(table, row, "width"),
            .height = csv_table_field(table, row, "height"),
            .settings = csv_table_field(table, row, "settings"),
            .reference = csv_table_field(table, row, "reference"),
            .metric = metric,
            .ms = number(table, row, "ms_technique"),
            .ms_least = number(table, row, "ms_min"),
            .ms_most = number(table, row, "ms_max"),
            .error = number(table, row, "error"),
        };
        into->brute = chapter_tells(chapter, "brute", into->technique, false);
        into->curve = text_format("%s%s", into->technique, into->brute ? " (brute force)" : "");
        const char *same = chapter_told(chapter, "same");
        into->problem = same ? setting_of(into->settings, same) : NULL;
        into->problem = into->problem ? into->problem : text_format("%s", "");
        repeats_read(table, row, into);
    }
}

Chapter chapter_read(const char *out, const char *chapters, const char *name)
{
    char *folder = text_format("%s/%s", out, name), *told = text_format("%s/%s/report.txt", chapters, name),
         *list = text_format("%s/list.txt", folder), *status = text_format("%s/status.txt", folder),
         *limits = text_format("%s/limits.txt", folder);
    Chapter chapter = {.name = name,
                       .title = "",
                       .folder = folder,
                       .told = lines_read(told),
                       .list = lines_read(list),
                       .status = lines_read(status),
                       .limits = lines_read(limits),
                       .sweep = table_read(folder, "sweep.csv"),
                       .stability = table_read(folder, "stability.csv"),
                       .plan = table_read(folder, "plan.csv")};
    for (size_t i = 0; i < chapter.list.count; i++)
        if (strcmp(chapter.list.lines[i].fields[0], "chapter") == 0)
            chapter.title = chapter.list.lines[i].fields[2];
    const CsvTable *from = chapter.sweep.rows ? &chapter.sweep : &chapter.stability;
    for (size_t i = 0; i < from->comment_count && i < MACHINE_LINES; i++)
        chapter.machine.lines[i] = from->comments[i];
    rows_read(&chapter);
    free(told);
    free(list);
    free(status);
    free(limits);
    return chapter;
}

void chapter_free(Chapter *chapter)
{
    for (size_t i = 0; i < chapter->row_count; i++) {
        free(chapter->rows[i].repeats);
        free(chapter->rows[i].curve);
        free(chapter->rows[i].problem);
    }
    free(chapter->rows);
    free(chapter->folder);
    TextLines *lines[] = {&chapter->told, &chapter->list, &chapter->status, &chapter->limits};
    for (int i = 0; i < 4; i++)
        lines_free(lines[i]);
    csv_table_free(&chapter->sweep);
    csv_table_free(&chapter->stability);
    csv_table_free(&chapter->plan);
}

char *setting_of(const char *settings, const char *key)
{
    size_t length = strlen(key);
    for (const char *at = settings; *at; at += strcspn(at, ";"), at += *at == ';')
        if (strncmp(at, key, length) == 0 && at[length] == '=')
            return text_format("%.*s", (int)strcspn(at + length + 1, ";"), at + length + 1);
    return NULL;
}

char *oracle_of(const SweepRow *row)
{
    char *oracle = setting_of(row->settings, "oracle");
    if (oracle && strcmp(oracle, "none") == 0) {
        free(oracle);
        return NULL;
    }
    return oracle;
}

static bool member(const SweepRow *a, const SweepRow *b, bool oracles)
{
    char *oracle = oracles ? NULL : oracle_of(b);
    bool same = !oracle && !strcmp(a->scene, b->scene) && !strcmp(a->width, b->width) &&
                !strcmp(a->height, b->height) && !strcmp(a->reference, b->reference) &&
                !strcmp(a->metric, b->metric);
    free(oracle);
    return same;
}

size_t group_of(const SweepRow *rows, size_t count, size_t first, bool oracles, const SweepRow **group)
{
    size_t members = 0;
    for (size_t i = 0; i < count; i++)
        if (member(&rows[first], &rows[i], oracles))
            group[members++] = &rows[i];
    return members;
}

bool group_begins(const SweepRow *rows, size_t count, size_t first, bool oracles)
{
    if (first >= count || !member(&rows[first], &rows[first], oracles))
        return false;
    for (size_t i = 0; i < first; i++)
        if (member(&rows[first], &rows[i], oracles))
            return false;
    return true;
}

char *group_name(const char *label, const SweepRow *row)
{
    char *name = text_format("%s-%s-%sx%s-%s%s", label, row->scene, row->width, row->height, row->metric,
                             strcmp(row->reference, "truth") == 0 ? "" : "-converged");
    for (char *c = name; *c; c++)
        *c = isalnum((unsigned char)*c) || *c == '_' ? *c : '-'; // a scene may be a file's path
    return name;
}
