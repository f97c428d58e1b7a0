// report: orders of convergence, for every technique whose rows in one picture differ in one number.
#include "report.h"

#include <math.h>

static bool number_of(const SweepRow *row, const char *key, double *value)
{
    char *text = setting_of(row->settings, key), *end = text;
    *value = text ? strtod(text, &end) : 0;
    bool is = text && end != text && !*end;
    free(text);
    return is;
}

// The key of the only number in which the rows' settings differ, or NULL. The caller frees it.
static char *what_varies(const SweepRow **rows, size_t count)
{
    char *only = NULL;
    for (const char *at = rows[0]->settings; *at; at += strcspn(at, ";"), at += *at == ';') {
        char *key = text_format("%.*s", (int)strcspn(at, "=;"), at);
        bool varies = false, numbers = true;
        double first, value;
        numbers = number_of(rows[0], key, &first);
        for (size_t i = 1; i < count && numbers; i++) {
            numbers = number_of(rows[i], key, &value);
            varies |= numbers && value != first;
        }
        if (numbers && varies && only) { // two of them: no single order
            free(only);
            free(key);
            return NULL;
        }
        if (numbers && varies)
            only = key;
        else
            free(key);
    }
    return only;
}

// The chapter's line: order TECHNIQUE METRIC EXPECTED [SCENE [REFERENCE]], "-" for any scene; the one with the scene wins.
static const char *expected_of(const Chapter *chapter, const SweepRow *row)
{
    const char *expected = NULL;
    bool of_scene = false;
    for (size_t i = 0; i < chapter->told.count; i++) {
        const char *const *f = chapter->told.lines[i].fields;
        const bool scene = strcmp(f[4], row->scene) == 0, any = !*f[4] || strcmp(f[4], "-") == 0;
        if (strcmp(f[0], "order") || strcmp(f[1], row->technique) || strcmp(f[2], row->metric) ||
            (*f[5] && strcmp(f[5], row->reference)))
            continue;
        if (scene || (any && !of_scene))
            expected = f[3];
        of_scene = of_scene || scene;
    }
    return expected;
}

static void order_write(Table *table, const Chapter *chapter, const SweepRow **rows, size_t count,
                        const char *key)
{
    double *x = memory_new(2 * count, sizeof *x, "order"), *y = x + count;
    for (size_t i = 0; i < count; i++) {
        number_of(rows[i], key, &x[i]);
        y[i] = rows[i]->error;
    }
    OrderFit fit = measure_order_fit(x, y, count);
    free(x);
    const char *same = chapter_told(chapter, "same");
    if (same && strcmp(same, key) == 0) // another problem at each value: its error need not fall
        return;
    const char *expected = expected_of(chapter, rows[0]), *verdict = "";
    if (!fit.used && !expected) // every error is 0: there is nothing to say
        return;
    double wanted = expected ? strtod(expected, NULL) : NAN;
    if (expected && isfinite(fit.least))
        verdict = -fit.most <= wanted && wanted <= -fit.least ? "inside" : "outside";
    char *used = text_format("%zu of %zu", fit.used, count),
         *order = isfinite(fit.slope) ? text_format("%.3f", -fit.slope) : text_format("-"),
         *least = isfinite(fit.least) ? text_format("%.3f", -fit.most) : text_format("-"),
         *most = isfinite(fit.most) ? text_format("%.3f", -fit.least) : text_format("-");
    table_row(table,
              (const char *const[]){rows[0]->technique, rows[0]->scene, rows[0]->metric, rows[0]->reference,
                                    key, used, order, least, most, expected ? expected : "-", verdict});
    free(used);
    free(order);
    free(least);
    free(most);
}

void orders_write(FILE *page, const Chapter *chapter)
{
    const SweepRow **group = memory_new(chapter->row_count + 1, sizeof(SweepRow *), "orders"),
                   **rows = memory_new(chapter->row_count + 1, sizeof(SweepRow *), "orders");
    fputs("<h3>Orders of convergence</h3>\n<p class=\"quiet\">The error falls as the parameter to the power "
          "of minus the order: least squares "
          "of the logarithms, 95 % interval by Student's t; errors of 0 have no logarithm and are left "
          "out.</p>\n",
          page);
    Table table = table_begin(page, chapter->folder, "orders", &chapter->machine,
                              "technique,scene,metric,reference,over,rows,order,least,most,expected,verdict");
    for (size_t first = 0; first < chapter->row_count; first++) {
        if (!group_begins(chapter->rows, chapter->row_count, first, false))
            continue;
        size_t members = group_of(chapter->rows, chapter->row_count, first, false, group);
        for (size_t i = 0; i < members; i++) {
            size_t count = 0;
            bool begins = true;
            for (size_t k = 0; k < members; k++)
                if (strcmp(group[k]->technique, group[i]->technique) == 0) {
                    begins &= k >= i;
                    rows[count++] = group[k];
                }
            char *key = begins ? what_varies(rows, count) : NULL;
            if (key)
                order_write(&table, chapter, rows, count, key);
            free(key);
        }
    }
    table_end(&table);
    free(rows);
    free(group);
}
