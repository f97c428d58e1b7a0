// record: tests/data/ID/ from the solutions and the known mistakes. See course.h.
#include "attempt.h"
#include "course.h"
#include "recorded.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

// Write the values where they differ from what the file holds in the least; returns whether.
static bool write_values(const char *path, const float *values, size_t count)
{
    size_t bytes = 0;
    char *old = file_read(path, &bytes);
    bool same = old && bytes == count * sizeof *values && !memcmp(old, values, bytes);
    free(old);
    if (same)
        return false;
    const char *temporary = file_begin(path);
    FILE *file = fopen(temporary, "wb");
    bool written = file && fwrite(values, sizeof *values, count, file) == count;
    if (!file || fclose(file) || !written)
        fail_work("%s: cannot be written: %s", path, strerror(errno));
    file_commit(temporary);
    printf("  %s\n", path);
    return true;
}

static void record_check(const Course *course, const Attempt *attempt, const Check *check, const char *mutant)
{
    Outcome outcome = attempt_run(attempt, check, 0);
    if (!outcome.values)
        fail_work("%s: check %s of %s: %s", attempt->entry->id, check->name, mutant ? mutant : "the solution",
                  outcome.why);
    char *path = recorded_path(course->data, attempt->entry, check, mutant);
    write_values(path, outcome.values, check_values(check));
    free(path);
    outcome_free(&outcome);
}

// `mutant` NULL: the solution, all checks; else the check that it is recognised by.
static void record_tree(const Course *course, const Entry *entry, const char *tree,
                        const Misconception *mutant)
{
    char *folder = text_format("%s/record/%s", course->build, entry->id);
    Attempt attempt = attempt_open(entry, tree, course->build, folder);
    free(folder);
    if (entry->kind != EXERCISE_MEASURE) {
        ConfineResult built = attempt_build(&attempt, NULL);
        if (built.end != CONFINE_EXIT || built.status != 0)
            fail_work("%s: %s does not compile: %s", entry->id, mutant ? mutant->mutant : "the solution",
                      built.text);
        free(built.text);
    }
    for (int i = 0; i < entry->check_count; i++)
        if (!mutant || mutant->seen_in == &entry->checks[i])
            record_check(course, &attempt, &entry->checks[i], mutant ? mutant->mutant : NULL);
    attempt_close(&attempt);
}

int course_record(const Course *course, const Entry *entry)
{
    char *folder = text_format("%s/%s", course->data, entry->id);
    folder_make(folder);
    free(folder);
    char *tree = text_format("%s/solutions", course->build);
    record_tree(course, entry, tree, NULL);
    free(tree);
    for (int i = 0; i < entry->misconception_count; i++) {
        const Misconception *mutant = &entry->misconceptions[i];
        tree = text_format("%s/wrong/%s/%s", course->build, entry->id, mutant->mutant);
        record_tree(course, entry, tree, mutant);
        free(tree);
    }
    return 0;
}
