// Reading the CSV files that measure.h writes (RFC 4180 after comment lines that begin with '#'), for tools and tests.
#ifndef CSV_H
#define CSV_H

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "base.h"

typedef struct CsvTable {
    char *text; // all fields lie in it
    char **comments;
    size_t comment_count; // without "# "
    char **fields;
    size_t columns, rows; // the header is row 0; field (row, column) is fields[row * columns + column]
} CsvTable;

// Ends the program where the file cannot be read, is cut off, or a row has not as many fields as the header.
static inline CsvTable csv_table_read(const char *path)
{
    size_t bytes = 0;
    CsvTable table = {.text = file_read(path, &bytes)};
    if (!table.text)
        fail_work("%s: cannot be read: %s", path, strerror(errno));
    if (bytes && table.text[bytes - 1] != '\n')
        fail_work("%s: the last row is cut off: no line break ends it", path);
    char *in = table.text;
    while (*in == '#') {
        table.comments = memory_grow(table.comments, table.comment_count + 1, sizeof *table.comments, path);
        table.comments[table.comment_count++] = in + 1 + strspn(in + 1, " ");
        in += strcspn(in, "\n");
        if (*in)
            *in++ = '\0';
    }
    size_t count = 0, in_row = 0;
    while (*in) {
        char *out = in; // quotes go, so a field never grows
        table.fields = memory_grow(table.fields, count + 1, sizeof *table.fields, path);
        table.fields[count++] = out;
        in_row++;
        if (*in == '"') {
            for (in++; *in && (*in != '"' || in[1] == '"'); in++) {
                in += *in == '"';
                *out++ = *in;
            }
            if (*in != '"')
                fail_work("%s: a quoted field has no end", path);
            in++;
        } else {
            in += strcspn(in, ",\n");
            out = in;
        }
        char end = *in;
        if (end && end != ',' && end != '\n')
            fail_work("%s: row %zu: text after a closing quote", path, table.rows);
        in += end != '\0';
        *out = '\0';
        if (end != ',') {
            table.columns = table.rows ? table.columns : in_row;
            if (in_row != table.columns)
                fail_work("%s: row %zu has %zu fields, the header has %zu", path, table.rows, in_row,
                          table.columns);
            table.rows++;
            in_row = 0;
        }
    }
    if (in_row || !table.rows)
        fail_work("%s: %s", path, in_row ? "the last row is cut off" : "no header and no rows");
    return table;
}

// The field under this header; ends the program where there is no such column.
static inline const char *csv_table_field(const CsvTable *table, size_t row, const char *header)
{
    for (size_t column = 0; column < table->columns; column++)
        if (strcmp(table->fields[column], header) == 0)
            return table->fields[row * table->columns + column];
    fail_work("the table has no column '%s'", header);
}

static inline void csv_table_free(CsvTable *table)
{
    free(table->text);
    free(table->comments);
    free(table->fields);
    *table = (CsvTable){0};
}

#endif
