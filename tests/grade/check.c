// check: make check EX=NN.M. Builds the student's files, runs them on the inputs of seed 0, compares with what tests/data holds, and says in
// one screen what is right, what is wrong, where, and what to do next. See course.h.
#include "course.h"
#include "recorded.h"
#include "report.h"

#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

enum { TEXT_LINES = 14, INDENT = 10 };

// What a compiler or program said, as much as fits a screen.
static void say_text(int indent, const char *text, int lines)
{
    int line = 0;
    for (; *text && line < lines; line++) {
        int length = (int)strcspn(text, "\n");
        printf("%*s%.*s\n", indent, "", length, text);
        text += length + (text[length] == '\n');
    }
    if (*text)
        printf("%*s… (there is more; the first is the one to mend)\n", indent, "");
}

static bool files_there(const Course *course, const Entry *entry)
{
    bool there = true;
    for (int i = 0; i < entry->file_count; i++) {
        char *path = course_path(course, entry, i);
        if (access(path, R_OK) != 0) {
            printf("  %s is missing. %s\n", path,
                   access(course->solutions, F_OK) == 0 ? "make exercises brings the stub back."
                                                        : "Take it from the tree that you were handed out.");
            there = false;
        }
        free(path);
    }
    return there;
}

static bool build(const Attempt *attempt)
{
    ConfineResult result = attempt_build(attempt, NULL);
    bool good = result.end == CONFINE_EXIT && result.status == 0;
    if (!good)
        puts("  It does not compile, so nothing was checked:\n");
    else if (*result.text)
        puts("  It compiles, and the compiler has a remark:\n");
    if (*result.text) {
        say_text(4, result.text, good ? TEXT_LINES / 2 : TEXT_LINES);
        putchar('\n');
    }
    free(result.text);
    return good;
}

// What the checks of one exercise came to, in the entry's order.
typedef struct Results {
    Outcome *outcomes;
    float **wanted, **got; // got: the outcomes' values
    bool *passes;
    int passing;
} Results;

// After one that did not end: it would hang here, too.
static bool not_run(const Results *results, int i)
{
    return i > 0 && results->outcomes[i - 1].end == CONFINE_WALL;
}

static Results results_make(const Course *course, const Attempt *attempt)
{
    const Entry *entry = attempt->entry;
    size_t count = (size_t)entry->check_count;
    Results results = {.outcomes = memory_new(count, sizeof(Outcome), "outcomes"),
                       .wanted = memory_new(count, sizeof(float *), "outcomes"),
                       .got = memory_new(count, sizeof(float *), "outcomes"),
                       .passes = memory_new(count, sizeof(bool), "outcomes")};
    for (int i = 0; i < entry->check_count; i++) {
        const Check *check = &entry->checks[i];
        results.wanted[i] = recorded_read(course->data, entry, check, NULL);
        if (not_run(&results, i)) {
            results.outcomes[i] = (Outcome){.why = text_format("was not run again"), .end = CONFINE_WALL};
            continue;
        }
        results.outcomes[i] = attempt_run(attempt, check, 0);
        results.got[i] = results.outcomes[i].values;
        results.passes[i] =
            results.got[i] &&
            !compare_values(results.got[i], results.wanted[i], check_values(check), check->tolerance).wrong;
        results.passing += results.passes[i];
    }
    return results;
}

static void results_free(Results *results, const Entry *entry)
{
    for (int i = 0; i < entry->check_count; i++) {
        outcome_free(&results->outcomes[i]);
        free(results->wanted[i]);
    }
    free(results->outcomes);
    free(results->wanted);
    free(results->got);
    free(results->passes);
}

// A check whose program gave no output, and why.
static void say_failed_run(const Attempt *attempt, const Check *check, const Outcome *outcome)
{
    const char *text = outcome->text ? outcome->text : "";
    bool of_program =
        attempt->entry->kind != EXERCISE_MEASURE && strncmp(outcome->why, "its output", 10) != 0;
    char *why = text_format("%s%s%s", of_program ? "the program " : "", outcome->why, *text ? ":" : "");
    say_wrapped(INDENT, "", why);
    free(why);
    say_text(INDENT, text + (strncmp(text, "program: ", 9) ? 0 : 9),
             TEXT_LINES / 2); // what fail_work begins with
    if (outcome->end == CONFINE_SIGNAL || outcome->end == CONFINE_WALL)
        printf("%*sRun it yourself, under gdb say:\n%*s%s/program %s/%s.in /tmp/out\n", INDENT, "",
               INDENT + 2, "", attempt_kept(attempt), attempt_kept(attempt), check->name);
}

static void say_verdict(const Check *check, const char *verdict)
{
    char *text = check->points > 0 ? text_format("%s: %s (%g point%s)", check->name, check->asks,
                                                 check->points, check->points == 1 ? "" : "s")
                                   : text_format("%s: %s", check->name, check->asks);
    say_wrapped(2, verdict, text);
    free(text);
}

// Yours, wanted and difference as one PNG, of a grid or picture.
static void say_picture(const Course *course, const Attempt *attempt, const Check *check)
{
    const Shape *shape = &check->shape;
    if (shape->dimensions == 1)
        return;
    folder_make(course->out);
    char *words[10] = {text_format("%s/course_picture", course->build),
                       text_format("%s/%s.out", attempt->folder, check->name),
                       recorded_path(course->data, attempt->entry, check, NULL),
                       text_format("%d", shape->dimensions),
                       text_format("%d", shape->size[0]),
                       text_format("%d", shape->size[1]),
                       text_format("%d", shape->size[2]),
                       text_format("%d", shape->channels),
                       text_format("%s/%s_%s.png", course->out, attempt->entry->id, check->name)};
    pid_t process;
    int status = -1;
    fflush(stdout);
    if (posix_spawn(&process, words[0], NULL, NULL, words, environ) == 0 &&
        waitpid(process, &status, 0) == process && status == 0)
        printf("%*syours | wanted | difference: %s\n", INDENT, "", words[8]);
    for (int i = 0; i < 9; i++)
        free(words[i]);
}

// A line for each check; the first that fails is told in full, so that the screen has room.
static void say_results(const Course *course, const Attempt *attempt, const Results *results)
{
    const Entry *entry = attempt->entry;
    bool told = false;
    for (int i = 0; i < entry->check_count; i++) {
        const Check *check = &entry->checks[i];
        const Outcome *outcome = &results->outcomes[i];
        bool passes = results->passes[i];
        say_verdict(check, passes ? "ok" : not_run(results, i) ? "not run" : "WRONG");
        if (passes && outcome->values && entry->kind == EXERCISE_MEASURE)
            printf("          %.7g (%s)\n", (double)outcome->values[0], outcome->text);
        if (passes || told)
            continue;
        told = true;
        if (!outcome->values) {
            say_failed_run(attempt, check, outcome);
            continue;
        }
        Comparison comparison =
            compare_values(outcome->values, results->wanted[i], check_values(check), check->tolerance);
        report_wrong(entry, check, outcome, results->wanted[i], &comparison);
        say_picture(course, attempt, check);
    }
    putchar('\n');
}

static void say_end(const Course *course, const Entry *entry, const Results *results)
{
    const Misconception *mistake = results->passing < entry->check_count
                                       ? recorded_mistake(course->data, entry, results->got, results->passes)
                                       : NULL;
    if (mistake) {
        say_wrapped(2, "", mistake->says);
        putchar('\n');
    }
    if (results->passing == entry->check_count) {
        const Entry *next = progress_next(course);
        printf("  %s is solved.", entry->id);
        if (access(course->solutions, F_OK) == 0)
            printf(" Ours, to compare: make solution EX=%s", entry->id);
        putchar('\n');
        if (next)
            printf("  Next: %s %s (make next)\n", next->id, next->title);
        else
            puts("  That was the last one: everything passes.");
    } else {
        printf("  %d of %d checks pass. Stuck? make hint EX=%s", results->passing, entry->check_count,
               entry->id);
        printf("   (%d of 3 read)\n", progress_hints(course, entry));
    }
}

int course_check(Course *course, const Entry *entry)
{
    printf("%s  %s\n\n", entry->id, entry->title);
    bool passes = false;
    if (files_there(course, entry)) {
        char *folder = text_format("%s/%s", course->work, entry->id);
        Attempt attempt = attempt_open(entry, course->tree, course->build, folder);
        free(folder);
        if (entry->kind == EXERCISE_MEASURE || build(&attempt)) {
            Results results = results_make(course, &attempt);
            passes = results.passing == entry->check_count;
            progress_set_flag(course, entry, "passes", passes);
            if (passes)
                progress_set_flag(course, entry, "solved", true);
            say_results(course, &attempt, &results);
            say_end(course, entry, &results);
            results_free(&results, entry);
        } else {
            progress_set_flag(course, entry, "passes", false);
        }
        attempt_close(&attempt);
    }
    progress_write(course);
    return passes ? 0 : 1;
}
