// report: numbers, figures and the page of `make report`, all from the rows that the chapters' programs wrote. tests/tools/report.sh runs
// the programs; here nothing is measured and no number stands that is not computed from a row.
//   main.c      which chapters, in which order the page tells of them
//   chapter.c   a chapter's tables and its report.txt, read
//   diagrams.c  error over run time; who is faster at an equal error, who is better in an equal time
//   orders.c    orders of convergence, measured and expected
//   tables.c    stability, plans, what could not be measured
//   stages.c    the error budget; how far apart the techniques are at their limits
//   page.c      HTML
#ifndef REPORT_H
#define REPORT_H

#include "../csv.h"
#include "measure.h"

// One line of a text file whose fields are parted by tabs.
enum { LINE_FIELDS = 6 };
typedef struct TextLine {
    const char *fields[LINE_FIELDS]; // "" where the line has fewer
} TextLine;
typedef struct TextLines {
    char *text;
    TextLine *lines;
    size_t count;
} TextLines;
TextLines lines_read(const char *path); // none where there is no such file; '#' begins a comment line

typedef struct SweepRow {
    const char *chapter, *technique, *scene, *width, *height, *settings, *reference, *metric;
    double ms, ms_least, ms_most, error;
    double *repeats; // of ms
    size_t repeat_count;
    bool brute;
    char *curve;   // as the diagram's key names it
    char *problem; // value of the setting that poses another problem (report.txt: same KEY), or ""
} SweepRow;

typedef struct Chapter {
    const char *name, *title;
    char *folder; // of its tables, and where its figures go
    TextLines told, list, status,
        limits;                      // report.txt; --list; what failed or is left; pictures at the limits
    CsvTable sweep, stability, plan; // rows is 0 where there is no such table
    Machine machine;
    SweepRow *rows; // the sweep's
    size_t row_count;
} Chapter;
Chapter chapter_read(const char *out, const char *chapters, const char *name);
void chapter_free(Chapter *chapter);
// The field after these in report.txt, as told(c, "family"), or NULL.
const char *chapter_told(const Chapter *chapter, const char *key);
// Whether report.txt has a line of this key and value, or, where `unless_any`, no line of this key at all.
bool chapter_tells(const Chapter *chapter, const char *key, const char *value, bool unless_any);

// "64" of "method=march;steps=64" for "steps"; NULL where it is not set. The caller frees it.
char *setting_of(const char *settings, const char *key);
// The exact stage that the row was given (oracle=map: "map"), or NULL for none. The caller frees it.
char *oracle_of(const SweepRow *row);

// Rows of one picture: same scene, size, reference and metric. `group` is filled with pointers to those of rows[first], in order; the count.
size_t group_of(const SweepRow *rows, size_t count, size_t first, bool oracles, const SweepRow **group);
// Whether no row before `first` is of its group.
bool group_begins(const SweepRow *rows, size_t count, size_t first, bool oracles);
// "airlight-cornell-256x256-nrmse": a file's name for a group; the caller frees it.
char *group_name(const char *label, const SweepRow *row);

// Each writes its part of the page, and its CSV files and figures into the folder.
void diagrams_write(FILE *page, const char *folder, const char *label, const SweepRow *rows, size_t count,
                    const Machine *machine);
void orders_write(FILE *page, const Chapter *chapter);
void stability_write(FILE *page, const Chapter *chapter);
void plans_write(FILE *page, const Chapter *chapter);
void status_write(FILE *page, const Chapter *chapter);
void budget_write(FILE *page, const Chapter *chapter);
// All pairs of the chapters' pictures at their limits, into the folder.
void consistency_write(FILE *page, const char *folder, const Chapter *const *chapters, size_t count);

void page_begin(FILE *page);
void page_end(FILE *page);
void page_text(FILE *page, const char *text); // &, <, > and " escaped
void page_format(FILE *page, const char *format, ...) __attribute__((format(printf, 2, 3))); // the same
// A figure drawn twice by now, FOLDER/NAME.svg and .png: the drawing itself, links to the files beside it, the caption, the machine line.
void page_figure(FILE *page, const char *folder, const char *name, const char *caption,
                 const Machine *machine);
void page_row(FILE *page, const char *cell, const char *const *fields, size_t count); // cell: "td" or "th"
// A CSV file and a table of the page, row by row.
typedef struct Table {
    FILE *page;
    Csv *csv;
    char *link;
    size_t columns;
} Table;
Table table_begin(FILE *page, const char *folder, const char *name, const Machine *machine,
                  const char *header);
void table_row(Table *table, const char *const *fields);
void table_end(Table *table);

#endif
