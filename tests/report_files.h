// report_files: a folder for each of the report's tests, commands run in it, files put there and read again.
#ifndef REPORT_FILES_H
#define REPORT_FILES_H

#include "csv.h"

#include <criterion/criterion.h>
#include <sys/wait.h>
#include <unistd.h>

static char folder[] = "/tmp/report-XXXXXX"; // $T in commands; $B is the build folder
static const double ROUNDING = 1e-5;         // tables print six digits

static void begin(void)
{
    cr_assert(mkdtemp(folder), "no folder in /tmp");
    setenv("T", folder, 1);
    char *build = realpath(getenv("BUILD") ? getenv("BUILD") : "build", NULL);
    cr_assert(build, "the build folder");
    setenv("B", build, 1);
    unsetenv("QUICK");
    unsetenv("FULL");
    free(build);
}
static void end(void)
{
    cr_expect_eq(system("rm -rf \"$T\""), 0, "the temporary folder stays");
}
TestSuite(report, .init = begin, .fini = end, .timeout = 120);

static int shell(const char *command)
{
    int status = system(command);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}
static char *path_of(const char *name)
{
    return text_format("%s/%s", folder, name);
}
static void file_put(const char *name, const char *text)
{
    char *path = path_of(name);
    FILE *file = fopen(path, "w");
    cr_assert(file && fputs(text, file) >= 0 && fclose(file) == 0, "%s", path);
    free(path);
}
static char *text_of(const char *name)
{
    char *path = path_of(name), *text = file_read(path, NULL);
    free(path);
    return text;
}
static size_t count_of(const char *text, const char *part)
{
    size_t count = 0;
    for (; text && (text = strstr(text, part)); text += strlen(part))
        count++;
    return count;
}
// Field `header` of the first row in which the field `key` is `value`.
static const char *field_where(const CsvTable *table, const char *key, const char *value, const char *header)
{
    for (size_t row = 1; row < table->rows; row++)
        if (strcmp(csv_table_field(table, row, key), value) == 0)
            return csv_table_field(table, row, header);
    cr_assert_fail("no row with %s %s", key, value);
    return NULL; // never reached
}
static CsvTable table_of(const char *name)
{
    char *path = path_of(name);
    CsvTable table = csv_table_read(path);
    free(path);
    return table;
}

#endif
