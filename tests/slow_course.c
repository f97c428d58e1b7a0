// Every exercise: its stub and its solution are built as a student's work is and judged by the recorded outputs, which must be those of the solution as it is
// now; and what a measure exercise records is measured again.
#include <criterion/criterion.h>

#include "grade/attempt.h"
#include "grade/compare.h"
#include "grade/recorded.h"
#include "support_course.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SECONDS = 600 };
TestSuite(course_slow, .init = course_folder_make, .fini = course_folder_remove, .timeout = SECONDS);

Test(course_slow, solutions_pass_as_recorded_and_stubs_pass_nothing)
{
    Manifest manifest = manifest_open("exercises/manifest.json", "tests/grade/manifest.schema.json");
    const char *named = getenv("BUILD"), *build = named && *named ? named : "build";
    for (int i = 0; i < 2 * manifest.count; i++) {
        const Entry *entry = &manifest.entries[i / 2];
        bool solved = i % 2;
        char *tree = text_format("%s/%s", build, solved ? "solutions" : "stubs");
        char *folder = text_format("%s/attempt", course_folder());
        Attempt attempt = attempt_open(entry, tree, build, folder);
        if (entry->kind != EXERCISE_MEASURE) {
            ConfineResult built = attempt_build(&attempt, (const char *const[]){"-Werror", NULL});
            cr_assert(built.end == CONFINE_EXIT && built.status == 0, "%s of %s: %s", entry->id, tree,
                      built.text);
            free(built.text);
        }
        for (int c = 0; c < entry->check_count; c++) {
            const Check *check = &entry->checks[c];
            Outcome outcome = attempt_run(&attempt, check, 0);
            float *wanted = recorded_read("tests/data", entry, check, NULL);
            bool passes =
                outcome.values &&
                !compare_values(outcome.values, wanted, check_values(check), check->tolerance).wrong;
            cr_expect_eq(passes, solved, "%s of %s: check %s %s %s", entry->id, tree, check->name,
                         passes ? "passes" : "does not pass", outcome.why ? outcome.why : "");
            // a program that gives nothing is no stub: it has a wrong answer
            cr_expect(outcome.values || entry->kind == EXERCISE_MEASURE, "%s of %s: %s", entry->id, tree,
                      outcome.why);
            free(wanted);
            outcome_free(&outcome);
        }
        attempt_close(&attempt);
        free(folder);
        free(tree);
    }
    manifest_close(&manifest);
}

// A solution's answers follow the commands that measure them: lines "// measure: COMMAND", each for the next "name = number".
Test(course_slow, measured_answers_are_measured_again)
{
    Manifest manifest = manifest_open("exercises/manifest.json", "tests/grade/manifest.schema.json");
    int measured = 0;
    for (const Entry *entry = manifest.entries; entry < manifest.entries + manifest.count; entry++) {
        char *program = text_format("test -x $B/%s", entry->folder);
        int status = 0;
        if (entry->kind == EXERCISE_MEASURE)
            course_shell(&status, program);
        free(program);
        if (entry->kind != EXERCISE_MEASURE || status != 0) // a chapter that is not here cannot be measured
            continue;
        for (int c = 0; c < entry->check_count; c++) {
            const Check *check = &entry->checks[c];
            char *command = text_format(
                "awk -v name=%s '/^.. measure: / { sub(/^.. measure: /, \"\"); command = $0 } $1 == name && "
                "$2 == \"=\" { print "
                "command; exit }' solutions/%s/%s | sed \"s,build/,$B/,g\" >$T/command; sh $T/command "
                "2>$T/notes",
                check->name, entry->folder, entry->files[0]);
            const char *said = course_says(0, command);
            float *wanted = recorded_read("tests/data", entry, check, NULL);
            double again = atof(said), room = tolerance_at(check->tolerance, (double)wanted[0]);
            // a third of the tolerance: what we record is to be well within what we accept
            cr_expect(*said && fabs(again - (double)wanted[0]) <= room / 3, "%s: %s is %g, measured again %s",
                      entry->id, check->name, (double)wanted[0], said);
            measured++;
            free(wanted);
            free(command);
        }
    }
    cr_expect(measured > 0);
    manifest_close(&manifest);
}
