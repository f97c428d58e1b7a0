// plan_lines: the lines of what --plan prints, a pass each.
#ifndef PLAN_LINES_H
#define PLAN_LINES_H

#include <criterion/criterion.h>
#include <stdio.h>
#include <string.h>

// The pass's line, or NULL.
static inline const char *line_of(const char *plan, const char *pass)
{
    const size_t length = strlen(pass);
    const char *line = plan;
    while (line && !(strncmp(line, pass, length) == 0 && strncmp(line + length, "  ", 2) == 0))
        line = strchr(line, '\n') ? strchr(line, '\n') + 1 : NULL;
    return line;
}

// Whether it ran; it must be in the plan.
static inline bool ran(const char *plan, const char *pass)
{
    const char *line = line_of(plan, pass);
    char word[8] = "";
    cr_assert(line, "no pass '%s' in\n%s", pass, plan);
    sscanf(line + strlen(pass), "%7s", word);
    return strcmp(word, "yes") == 0;
}

#endif
