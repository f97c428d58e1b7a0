// stability_table: a chapter's program writes its table, or the rows that `options` leave; every check of it must pass.
#ifndef STABILITY_TABLE_H
#define STABILITY_TABLE_H

#include "base.h"

#include <criterion/criterion.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// `checks`: how many there are at least, so that a table that lost its rows does not pass.
static inline void check_stability_table(const char *program, const char *options, int checks)
{
    const char *build = getenv("BUILD");
    char *path = text_format("/tmp/stability-%d.csv", (int)getpid());
    char *command =
        text_format("%s/%s %s --stability %s 2>/dev/null", build ? build : "build", program, options, path);
    cr_assert_eq(system(command), 0, "%s fails", command);
    char *table = file_read(path, NULL);
    int passed = 0, failed = 0;
    for (const char *line = table; (line = strchr(line, '\n')) != NULL; line++) {
        passed += line - table > 5 && strncmp(line - 5, ",pass", 5) == 0;
        failed += line - table > 5 && strncmp(line - 5, ",fail", 5) == 0;
    }
    cr_assert(failed == 0 && passed >= checks, "%d checks pass, %d fail", passed, failed);
    unlink(path);
    free(path);
    free(command);
    free(table);
}

#endif
