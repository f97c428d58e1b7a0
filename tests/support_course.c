// support_course: see support_course.h.
#include "support_course.h"
#include "base.h"
#include "grade/compare.h"
#include "grade/inputs.h"
#include "grade/recorded.h"

#include <criterion/criterion.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>

enum { KEPT = 64 };

static struct {
    char folder[32], *build;
    char *said[KEPT];
    int count;
} state;

void course_folder_make(void)
{
    strcpy(state.folder, "/tmp/course_XXXXXX");
    cr_assert(mkdtemp(state.folder));
    cr_assert_eq(chmod(state.folder, 0755), 0); // a confined child reads in it
    const char *named = getenv("BUILD");
    state.build = realpath(named && *named ? named : "build", NULL);
    cr_assert(state.build, "make builds first");
}

void course_folder_remove(void)
{
    int status;
    course_shell(&status, "chmod -R u+rwx $T; rm -rf $T");
    for (int i = 0; i < state.count; i++)
        free(state.said[i]);
    free(state.build);
    state.count = 0;
}

const char *course_folder(void)
{
    return state.folder;
}

const char *course_shell(int *status, const char *command)
{
    char *whole = text_format("T=%s B=%s; export T B; unset MAKEFLAGS MFLAGS; { %s\n} </dev/null 2>&1",
                              state.folder, state.build, command);
    FILE *pipe = popen(whole, "r");
    free(whole);
    char *text = NULL;
    size_t bytes = 0;
    FILE *out = open_memstream(&text, &bytes);
    for (int c; pipe && (c = getc(pipe)) != EOF;)
        putc(c, out);
    fclose(out);
    int ended = pipe ? pclose(pipe) : -1;
    *status = WIFEXITED(ended) ? WEXITSTATUS(ended) : -1;
    cr_assert(state.count < KEPT);
    return state.said[state.count++] = text;
}

const char *course_says(int status, const char *command)
{
    int ended;
    const char *text = course_shell(&ended, command);
    cr_assert_eq(ended, status, "%s: status %d, not %d: %s", command, ended, status, text);
    return text;
}

void course_tree(const char *made)
{
    char *command = text_format("rm -rf $T/tree && cp -R $B/%s $T/tree", made);
    course_says(0, command);
    free(command);
}

void course_write(const char *name, const char *text)
{
    char *path = text_format("%s/%s", state.folder, name);
    course_write_at(path, text);
    free(path);
}

void course_write_at(const char *path, const char *text)
{
    char *folder = text_format("%.*s", (int)(strrchr(path, '/') - path), path);
    folder_make(folder);
    FILE *file = fopen(path, "w");
    cr_assert(file, "%s", path);
    bool written = fputs(text, file) >= 0;
    cr_assert(fclose(file) == 0 && written, "%s", path);
    free(folder);
}

bool course_has(const char *text, const char *const *words)
{
    for (; *words; words++)
        if (!strstr(text, *words))
            return false;
    return true;
}

// --- the worst error of a recorded output, over its tolerance
static double worst(const Entry *entry, const Check *check, const char *mutant, CourseDefinition definition)
{
    float *got = recorded_read("tests/data", entry, check, mutant);
    Input input = input_make(entry, check, 0);
    size_t channels = (size_t)check->shape.channels, items = check_values(check) / channels;
    double ratio = 0;
    for (size_t i = 0; i < items; i++) {
        double wanted[4] = {0};
        definition(input.values + input.head + input.stride * i, got + channels * i, wanted);
        for (size_t c = 0; c < channels; c++) {
            double error =
                fabs((double)got[channels * i + c] - wanted[c]) / tolerance_at(check->tolerance, wanted[c]);
            ratio = isfinite(error) ? fmax(ratio, error) : INFINITY;
        }
    }
    input_free(&input);
    free(got);
    return ratio;
}

void course_judge(const char *id, CourseDefinition definition)
{
    Manifest manifest = manifest_open("exercises/manifest.json", "tests/grade/manifest.schema.json");
    const Entry *entry = manifest_find(&manifest, id);
    cr_assert(entry, "%s: no such exercise", id);
    // a tenth of what a student is allowed: what is recorded is to be no part of what a student is told
    for (const Check *check = entry->checks; check < entry->checks + entry->check_count; check++) {
        double right = worst(entry, check, NULL, definition);
        cr_expect(right < 0.1, "%s %s: the recorded output is off by %g of the tolerance", id, check->name,
                  right);
    }
    for (int i = 0; i < entry->misconception_count; i++) {
        const Misconception *mistake = &entry->misconceptions[i];
        double wrong = worst(entry, mistake->seen_in, mistake->mutant, definition);
        cr_expect(wrong > 1, "%s %s: %s is off by %g of the tolerance alone", id, mistake->seen_in->name,
                  mistake->mutant, wrong);
    }
    manifest_close(&manifest);
}
