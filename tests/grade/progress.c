// progress: what is solved and how many hints were read, in .progress. See course.h.
#include "course.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

void progress_read(Course *course)
{
    if (access(course->progress_file, F_OK) != 0) {
        course->progress = json_object();
        return;
    }
    json_error_t where;
    course->progress = json_load_file(course->progress_file, 0, &where);
    if (!json_is_object(course->progress))
        fail_work("%s:%d: not what make check has written (%s); move it away to begin anew",
                  course->progress_file, where.line, where.text);
}

void progress_write(const Course *course)
{
    char *text = json_dumps(course->progress, JSON_INDENT(2) | JSON_SORT_KEYS);
    const char *temporary = file_begin(course->progress_file);
    FILE *file = fopen(temporary, "w");
    bool written = file && fprintf(file, "%s\n", text) > 0;
    if (!file || fclose(file) || !written)
        fail_work("%s: cannot be written", course->progress_file);
    file_commit(temporary);
    free(text);
}

static json_t *of(const Course *course, const Entry *entry)
{
    return json_object_get(course->progress, entry->id);
}

static void set(Course *course, const Entry *entry, const char *key, json_t *value)
{
    if (!json_is_object(of(course, entry)))
        json_object_set_new(course->progress, entry->id, json_object());
    json_object_set_new(of(course, entry), key, value);
}

bool progress_flag(const Course *course, const Entry *entry, const char *flag)
{
    return json_is_true(json_object_get(of(course, entry), flag));
}

void progress_set_flag(Course *course, const Entry *entry, const char *flag, bool value)
{
    set(course, entry, flag, json_boolean(value));
}

int progress_hints(const Course *course, const Entry *entry)
{
    int hints = (int)json_integer_value(json_object_get(of(course, entry), "hints"));
    return hints < 0 ? 0 : hints > 3 ? 3 : hints;
}

void progress_set_hints(Course *course, const Entry *entry, int hints)
{
    set(course, entry, "hints", json_integer(hints));
}

const Entry *progress_next(const Course *course)
{
    for (int i = 0; i < course->manifest.count; i++)
        if (!progress_flag(course, &course->manifest.entries[i], "passes"))
            return &course->manifest.entries[i];
    return NULL;
}
