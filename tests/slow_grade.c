// Hostile submissions: each is worth nothing for the exercise that it is handed in for, the other exercise of the same submission is worth all,
// and nothing outside is harmed.
#include <criterion/criterion.h>

#include "grade/results.h"
#include "support_grade.h"

#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

// Name, what the student is told. Where an attack ends depends on which limit it meets first.
#define ATTACKS(attack)                                                                                      \
    attack(FORK_BOMB, "did not end|time|memory|missing") attack(THREAD_BOMB,                                 \
                                                                "did not end|time|memory|signal")            \
        attack(NEVER_ENDS, "did not end|processor time") attack(SLEEPS, "did not end")                       \
            attack(WRITES_GIGABYTES, "wrote more than") attack(MANY_FILES, "wrote more than")                \
                attack(ALL_MEMORY, "memory") attack(ALL_MEMORY_TOGETHER, "memory")                           \
                    attack(SHARED_MEMORY, "memory") attack(PRINTS_WITHOUT_END, "printed more than")          \
                        attack(READS_SOLUTIONS, "exit status|missing|wrong")                                 \
                            attack(WRITES_RESULTS, "missing|exit status") attack(DELETES_FILES, "missing")   \
                                attack(FAKES_RESULTS, "missing") attack(ENDS_EARLY, "missing")               \
                                    attack(LINKS_OUTPUT, "symbolic link")                                    \
                                        attack(LINKS_INPUT_HARD, "another name|missing") attack(             \
                                            PIPE_OUTPUT, "is not a file") attack(NOT_A_NUMBER, "not finite") \
                                            attack(INFINITE, "not finite") attack(ALL_ZERO, "wrong")         \
                                                attack(TOO_LONG, "has 260 bytes, not 256")                   \
                                                    attack(TOO_SHORT, "has 252 bytes, not 256")              \
                                                        attack(KILLS_EVERYONE, "missing|signal")             \
                                                            attack(OUTLIVES, "missing")                      \
                                                                attack(ASKS_THE_NETWORK, "exit status")      \
                                                                    attack(LEAVES_BEFORE_MAIN, "missing")

static bool says_one_of(const char *text, const char *parts)
{
    for (const char *part = parts; *part;
         part += part[strcspn(part, "|")] == '|' ? strcspn(part, "|") + 1 : strcspn(part, "|")) {
        char *one = text_format("%.*s", (int)strcspn(part, "|"), part);
        bool found = strstr(text, one) != NULL;
        free(one);
        if (found)
            return true;
    }
    return false;
}

static void withstand(const char *name, const char *said)
{
    char *hostile = grade_data("hostile.c"), *kept = grade_data("solutions/01_voxelization/twice.c");
    GradeCase one;
    grade_case_open(&one, 7);
    char *source = text_format("#define %s\n%s", name, hostile);
    grade_case_write(&one, "twice.c", source);
    Verdicts attacked = grade_case_judge(&one, "01.1"), other = grade_case_judge(&one, "01.2");
    cr_expect_eq(grade_points(&attacked), 0, "%s gets %g points", name, grade_points(&attacked));
    cr_expect_eq(grade_points(&other), 4, "the other exercise loses points to %s: %s", name,
                 other.list[0].text);
    for (int i = 0; i < attacked.entry->check_count; i++) {
        cr_expect_eq(attacked.list[i].grade, GRADE_FAILED, "%s is not graded: %s", name,
                     attacked.list[i].text);
        cr_expect(says_one_of(attacked.list[i].text, said), "%s is told: %.300s", name,
                  attacked.list[i].text);
    }
    // Unharmed: the sources that this was made from, and the submission itself.
    char *submitted = text_format("%s/twice.c", one.submission), *still = file_read(submitted, NULL);
    cr_expect(still && strcmp(still, source) == 0, "the submission is changed");
    cr_expect_eq(waitpid(-1, NULL, WNOHANG), -1, "a process is left");
    results_write(&(Results){.count = 1, .exercises = &attacked, .seed = 7, .confined = confine_way()},
                  one.folder);
    verdicts_free(&attacked);
    verdicts_free(&other);
    grade_case_close(&one);
    free(submitted);
    free(still);
    free(source);
    free(hostile);
    free(kept);
}

#define WRAPPED(name, said)                                                                                  \
    Test(slow_grade, wrapped_##name, .timeout = 240)                                                         \
    {                                                                                                        \
        if (!confine_wrapped())                                                                              \
            cr_skip_test("bubblewrap does not work here");                                                   \
        withstand(#name, said);                                                                              \
    }
ATTACKS(WRAPPED)

// With limits alone: what does not rest on bubblewrap's view of files and processes. Only as root, whose children have a user of their own:
// KILLS_EVERYONE would else kill whoever runs this.
#define ALONE(name, said)                                                                                    \
    Test(slow_grade, alone_##name, .timeout = 240)                                                           \
    {                                                                                                        \
        if (geteuid() != 0)                                                                                  \
            cr_skip_test("only root's children have a user of their own");                                   \
        confine_without_bubblewrap();                                                                        \
        withstand(#name, said);                                                                              \
    }
ATTACKS(ALONE)
