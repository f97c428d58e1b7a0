// report: the tables that are shown as they came: stability cases, plans, what could not be measured.
#include "report.h"

#include <math.h>

void stability_write(FILE *page, const Chapter *chapter)
{
    const CsvTable *table = &chapter->stability;
    fputs("<h3>Stability</h3>\n", page);
    if (table->rows < 2) {
        fputs("<p class=\"quiet\">No row.</p>\n", page);
        return;
    }
    size_t failed = 0;
    for (size_t row = 1; row < table->rows; row++)
        failed += strcmp(csv_table_field(table, row, "verdict"), "pass") != 0;
    fprintf(page, "<p%s>%zu of %zu rows pass, %zu fail.</p>\n", failed ? " class=\"bad\"" : "",
            table->rows - 1 - failed, table->rows - 1, failed);
    for (int passes = failed ? 0 : 1; passes < 2; passes++) { // what fails comes first
        fprintf(page, "<details%s><summary>%s</summary><div class=\"scroll\"><table>\n",
                passes ? "" : " open", passes ? "rows that pass" : "rows that fail");
        page_row(page, "th", (const char *const *)table->fields, table->columns);
        for (size_t row = 1; row < table->rows; row++)
            if ((strcmp(csv_table_field(table, row, "verdict"), "pass") == 0) == passes)
                page_row(page, "td", (const char *const *)&table->fields[row * table->columns],
                         table->columns);
        fputs("</table></div></details>\n", page);
    }
}

// What `all` counts more than `some`, both "fragments=12;fetches=3": "fragments 7, …". The caller frees it.
static char *counts_saved(const char *all, const char *some)
{
    char *saved = text_format("%s", "");
    for (const char *at = all; *at; at += strcspn(at, ";"), at += *at == ';') {
        char *key = text_format("%.*s", (int)strcspn(at, "=;"), at), *with = setting_of(all, key),
             *without = setting_of(some, key);
        double difference = (with ? strtod(with, NULL) : 0) - (without ? strtod(without, NULL) : 0);
        if (difference != 0.0) {
            char *longer = text_format("%s%s%s %.6g", saved, *saved ? ", " : "", key, difference);
            free(saved);
            saved = longer;
        }
        free(key);
        free(with);
        free(without);
    }
    return saved;
}

static size_t same_pass(const CsvTable *table, size_t row) // with --everything; 0: none
{
    static const char *const keys[] = {"scene", "options", "pass"};
    for (size_t other = 1; other < table->rows; other++) {
        bool same = strcmp(csv_table_field(table, other, "everything"), "yes") == 0;
        for (int i = 0; i < 3; i++)
            same &= strcmp(csv_table_field(table, row, keys[i]), csv_table_field(table, other, keys[i])) == 0;
        if (same)
            return other;
    }
    return 0;
}

void plans_write(FILE *page, const Chapter *chapter)
{
    const CsvTable *plan = &chapter->plan;
    fputs("<h3>What is left out</h3>\n", page);
    if (plan->rows < 2) {
        fputs("<p class=\"quiet\">No plan.</p>\n", page);
        return;
    }
    fputs("<p class=\"quiet\">Each plan ran twice, the second time with --everything; its milliseconds are "
          "those of one frame, its counts are exact. A pass stands here if "
          "it was left out, if it left out a "
          "part of its work, or if its counts differ.</p>\n",
          page);
    Table table = table_begin(page, chapter->folder, "saved", &chapter->machine,
                              "scene,options,pass,left_out,why,ms,ms_with_everything,ms_saved,counts_saved");
    for (size_t row = 1; row < plan->rows; row++) {
        size_t all = same_pass(plan, row);
        if (strcmp(csv_table_field(plan, row, "everything"), "no") != 0 || !all)
            continue;
        bool ran = strcmp(csv_table_field(plan, row, "ran"), "true") == 0;
        double ms = strtod(csv_table_field(plan, row, "ms"), NULL),
               ms_all = strtod(csv_table_field(plan, all, "ms"), NULL),
               skipped = strtod(csv_table_field(plan, row, "skipped"), NULL);
        char *counts =
                 counts_saved(csv_table_field(plan, all, "counts"), csv_table_field(plan, row, "counts")),
             *out = !ran          ? text_format("the pass")
                    : skipped > 0 ? text_format("%s of %s", csv_table_field(plan, row, "skipped"),
                                                csv_table_field(plan, row, "of"))
                                  : text_format("-"),
             *some = text_format("%.3f", ms), *every = text_format("%.3f", ms_all),
             *less = text_format("%.3f", ms_all - ms);
        if (!ran || skipped > 0 || *counts)
            table_row(&table, (const char *const[]){
                                  csv_table_field(plan, row, "scene"), csv_table_field(plan, row, "options"),
                                  csv_table_field(plan, row, "pass"), out,
                                  csv_table_field(plan, row, "reason"), some, every, less, counts});
        free(counts);
        free(out);
        free(some);
        free(every);
        free(less);
    }
    table_end(&table);
}

void status_write(FILE *page, const Chapter *chapter)
{
    if (!chapter->status.count)
        return;
    fputs("<h3 class=\"bad\">Not measured</h3>\n<div class=\"scroll\"><table>\n", page);
    page_row(page, "th", (const char *const[]){"state", "what", "why"}, 3);
    for (size_t i = 0; i < chapter->status.count; i++)
        page_row(page, "td", chapter->status.lines[i].fields, 3);
    fputs("</table></div>\n", page);
}
