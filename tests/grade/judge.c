// judge: see judge.h.
#include "judge.h"
#include "judge_words.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

Judge judge_open(const Manifest *manifest, const char *build, uint64_t seed)
{
    Judge judge = {.manifest = manifest, .place = confine_scratch_open("grade"), .seed = seed};
    judge.scratch = judge.place.path;
    static const char *const made[] = {"libexercise.a", "exercise_commands"};
    for (size_t i = 0; i < sizeof made / sizeof *made; i++) {
        char *file = text_format("%s/%s", build, made[i]);
        confine_folder_copy(file, judge.scratch);
        free(file);
    }
    // What only references may see lies in a folder that is shut while anything else runs.
    char *reference = text_format("%s/reference", judge.scratch), *stubs = text_format("%s/stubs", build);
    char *solutions = text_format("%s/solutions", build), *kept = text_format("%s/solutions", reference);
    folder_make(reference);
    confine_folder_copy(solutions, kept);
    confine_folder_copy(stubs, judge.scratch);
    confine_folder_copy("common", judge.scratch);
    confine_folder_copy("shaders", judge.scratch);
    judge.trees = (Trees){text_format("%s/stubs", judge.scratch), kept};
    if (chmod(reference, 0700) != 0 || chdir(judge.scratch) != 0)
        fail_work("%s: %s", judge.scratch, strerror(errno));
    free(reference);
    free(solutions);
    free(stubs);
    return judge;
}

void judge_close(Judge *judge)
{
    (void)!chdir("/");
    confine_scratch_close(&judge->place);
    free((char *)judge->trees.stubs);
    free((char *)judge->trees.solutions);
    *judge = (Judge){0};
}

// --- references
static char *not_built(const ConfineResult *result)
{
    return result->end == CONFINE_EXIT && result->status == 0
               ? NULL
               : text_format("the solution does not compile: %.400s", result->text);
}

static char *not_wanted(const Outcome *outcome, const Check *check)
{
    if (!outcome->values)
        return text_format("the solution %s on %s: %.400s", outcome->why, check->name,
                           outcome->text ? outcome->text : "");
    for (size_t i = 0; i < check_values(check); i++)
        if (!isfinite(outcome->values[i]))
            return text_format("the solution's output for %s holds NaN or Inf", check->name);
    return NULL;
}

Reference reference_make(const Judge *judge, const Entry *entry)
{
    Reference reference = {.entry = entry};
    reference.values = memory_new((size_t)entry->check_count, sizeof *reference.values, "references");
    char *folder = text_format("%s/reference", judge->scratch),
         *place = text_format("%s/%s", folder, entry->program);
    chmod(folder, 0711);
    Attempt attempt = attempt_open(entry, judge->trees.solutions, judge->scratch, place);
    if (entry->kind != EXERCISE_MEASURE) {
        ConfineResult built = attempt_build(&attempt, judge->flags);
        reference.why = not_built(&built);
        free(built.text);
    }
    for (int i = 0; i < entry->check_count && !reference.why; i++) {
        Outcome outcome = attempt_run(&attempt, &entry->checks[i], judge->seed);
        reference.why = not_wanted(&outcome, &entry->checks[i]);
        reference.values[i] = outcome.values;
        outcome.values = NULL;
        outcome_free(&outcome);
    }
    attempt_close(&attempt);
    chmod(folder, 0700);
    free(place);
    free(folder);
    return reference;
}

void reference_free(Reference *reference)
{
    for (int i = 0; i < reference->entry->check_count; i++)
        free(reference->values[i]);
    free(reference->values);
    free(reference->why);
    *reference = (Reference){0};
}

// --- submissions
static void decide(Verdict *verdict, Grade grade, char *text)
{
    free(verdict->text);
    verdict->grade = grade;
    verdict->text = text;
}

// Nothing came of it: the submission's own failure where the solution still works here, the machine's where it does not.
static char *machine_failure(const Judge *judge, const Entry *entry)
{
    Reference again = reference_make(judge, entry);
    char *why = again.why;
    again.why = NULL;
    reference_free(&again);
    return why;
}

// Every check fails, by the same sentence, unless the machine is at fault.
static void fail_all(const Judge *judge, Verdicts *verdicts, const char *sentence)
{
    char *machine = machine_failure(judge, verdicts->entry);
    for (int i = 0; i < verdicts->entry->check_count; i++)
        decide(&verdicts->list[i], machine ? GRADE_NOT_GRADED : GRADE_FAILED,
               text_format("%s", machine ? machine : sentence));
    free(machine);
}

// The first file that was not handed in, or NULL.
static const char *missing_file(const Entry *entry, const char *tree)
{
    for (int i = 0; i < entry->file_count; i++) {
        char *path = text_format("%s/%s/%s", tree, entry->folder, entry->files[i]);
        bool there = access(path, F_OK) == 0;
        free(path);
        if (!there)
            return entry->files[i];
    }
    return NULL;
}

// Files by the names that the student knows them by.
static void drop_folder(char *text, const char *folder)
{
    for (char *at; (at = strstr(text, folder));)
        memmove(at, at + strlen(folder), strlen(at + strlen(folder)) + 1);
}

static bool builds(const Judge *judge, const Attempt *attempt, const char *tree, Verdicts *verdicts)
{
    const Entry *entry = attempt->entry;
    const char *missing = missing_file(entry, tree);
    char *sentence = NULL;
    if (missing) {
        sentence = text_format("%s is missing from what was handed in.", missing);
        for (int i = 0; i < entry->check_count; i++)
            decide(&verdicts->list[i], GRADE_FAILED, text_format("%s", sentence));
    } else if (entry->kind != EXERCISE_MEASURE) {
        ConfineResult built = attempt_build(attempt, judge->flags);
        drop_folder(built.text, "submitted/");
        if (built.end != CONFINE_EXIT)
            sentence =
                text_format("The compiler was stopped: something in your file keeps it busy without end.");
        else if (built.status != 0)
            sentence = text_format("It does not compile:\n%.2000s", built.text);
        if (built.end == CONFINE_NOT_RUN)
            for (int i = 0; i < entry->check_count; i++)
                decide(&verdicts->list[i], GRADE_NOT_GRADED,
                       text_format("the compiler could not be run: %s", built.text));
        else if (sentence)
            fail_all(judge, verdicts, sentence);
        free(built.text);
    }
    bool good = !sentence;
    free(sentence);
    return good;
}

// Why there is no output: the program's failure or the answer file's.
static char *no_output(const Entry *entry, const Outcome *outcome)
{
    drop_folder(outcome->why, "submitted/");
    if (entry->kind == EXERCISE_MEASURE)
        return text_format("%s.", outcome->why);
    bool printed = outcome->text && *outcome->text;
    return text_format("Your program %s.%s%.1000s", outcome->why, printed ? " It printed:\n" : "",
                       printed ? outcome->text : "");
}

static void judge_check(const Judge *judge, const Attempt *attempt, const Reference *reference, int i,
                        Verdict *verdict)
{
    Outcome outcome = attempt_run(attempt, verdict->check, judge->seed);
    if (outcome.values) {
        const float *wanted = reference->values[i];
        Comparison comparison =
            compare_values(outcome.values, wanted, check_values(verdict->check), verdict->check->tolerance);
        verdict->ratio = comparison.ratio;
        decide(verdict, comparison.wrong ? GRADE_FAILED : GRADE_PASSED,
               judge_words(verdict->check, &comparison, outcome.values, wanted));
    } else {
        char *machine = outcome.machine_failed ? text_format("your program %s", outcome.why)
                                               : machine_failure(judge, attempt->entry);
        decide(verdict, machine ? GRADE_NOT_GRADED : GRADE_FAILED,
               machine ? machine : no_output(attempt->entry, &outcome));
    }
    verdict->values = outcome.values;
    outcome.values = NULL;
    outcome_free(&outcome);
}

Verdicts judge_submission(const Judge *judge, const Reference *reference, const char *folder)
{
    const Entry *entry = reference->entry;
    Verdicts verdicts = {.entry = entry};
    verdicts.list = memory_new((size_t)entry->check_count, sizeof *verdicts.list, "verdicts");
    for (int i = 0; i < entry->check_count; i++)
        verdicts.list[i] = (Verdict){.check = &entry->checks[i],
                                     .ratio = INFINITY,
                                     .grade = GRADE_NOT_GRADED,
                                     .text = text_format("%s", reference->why ? reference->why : "")};
    if (reference->why) {
        verdicts.notes = text_format("%s", "");
        return verdicts;
    }
    char *tree = text_format("%s/submitted", judge->scratch),
         *place = text_format("%s/attempt", judge->scratch);
    confine_folder_remove(tree);
    Submission submission = {.folder = folder};
    submission_lay(&submission, judge->manifest, entry, judge->trees, tree);
    verdicts.notes = submission.notes;
    Attempt attempt = attempt_open(entry, tree, judge->scratch, place);
    if (builds(judge, &attempt, tree, &verdicts))
        for (int i = 0; i < entry->check_count; i++)
            judge_check(judge, &attempt, reference, i, &verdicts.list[i]);
    attempt_close(&attempt);
    free(place);
    free(tree);
    return verdicts;
}

void verdicts_free(Verdicts *verdicts)
{
    for (int i = 0; i < verdicts->entry->check_count; i++) {
        free(verdicts->list[i].text);
        free(verdicts->list[i].values);
    }
    free(verdicts->list);
    free(verdicts->notes);
    *verdicts = (Verdicts){0};
}
