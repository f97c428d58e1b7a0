// answers: see answers.h.
#include "answers.h"
#include "base.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

// The text after "name =" where the line begins so, else NULL.
static const char *after_name(const char *line, const char *name)
{
    line += strspn(line, " \t");
    size_t length = strlen(name);
    if (strncmp(line, name, length))
        return NULL;
    line += length + strspn(line + length, " \t");
    return *line == '=' ? line + 1 : NULL;
}

static bool is_blank(const char *text)
{
    text += strspn(text, " \t\r");
    return *text == '\n' || *text == '\0' || !strncmp(text, "//", 2);
}

bool answer_read(const char *file, const char *name, double *answer, char **why)
{
    *why = NULL;
    char *text = file_read(file, NULL), *end;
    if (!text) {
        *why = text_format("%s: %s", file, strerror(errno));
        return false;
    }
    const char *value = NULL;
    int lines = 0, line = 0, at = 0;
    for (char *start = text; start; start = strchr(start, '\n')) {
        start += *start == '\n';
        line++;
        const char *found = after_name(start, name);
        value = found ? found : value;
        at = found ? line : at;
        lines += found != NULL;
    }
    if (lines != 1)
        *why = text_format("%s: %s line \"%s = number\"", file, lines ? "more than one" : "no", name);
    else if (is_blank(value))
        *why = text_format("%s:%d: \"%s =\" has no number yet", file, at, name);
    else if (*answer = strtod(value, &end), end == value || !is_blank(end) || !isfinite(*answer))
        *why =
            text_format("%s:%d: \"%s =%.*s\" is no number", file, at, name, (int)strcspn(value, "\n"), value);
    free(text);
    return !*why;
}
