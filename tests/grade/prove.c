// prove: whether the graders see what they should: prove [ID…]. Each solution gets every point, each stub none, each known mistake loses the checks
// that its table names and only those, and earns its sentence; a graded exercise's mistakes hold one called `copied`, the nearest function that
// the course prints, pasted in.
#include "judge.h"
#include "recorded.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

// The public seed, by which sentences are recognised, and another, by which nothing is recorded.
static const uint64_t SEEDS[] = {0, 20240229};
enum { SEED_COUNT = 2 };

typedef struct Proof {
    const char *data, *wrong; // folders: tests/data, build/wrong
    int asked, missed;
} Proof;

static void say(Proof *proof, const Entry *entry, const char *work, bool good, const char *what)
{
    proof->asked++;
    proof->missed += !good;
    printf("prove: %s %-32s %s%s\n", entry->id, work, good ? "" : "FAILED: ", what);
}

static bool loses(const Misconception *mistake, const Check *check)
{
    for (int i = 0; i < mistake->loses_count; i++)
        if (mistake->loses[i] == check)
            return true;
    return false;
}

// Lines for each check whose verdict is not the wanted one. The caller frees them.
static char *differences(const Verdicts *verdicts, const Misconception *mistake, bool stub)
{
    char *text = text_format("%s", "");
    for (int i = 0; i < verdicts->entry->check_count; i++) {
        const Verdict *verdict = &verdicts->list[i];
        bool passes = mistake ? !loses(mistake, verdict->check) : !stub;
        if (verdict->grade == (passes ? GRADE_PASSED : GRADE_FAILED))
            continue;
        char *more = text_format("%s\n    %s should %s: %.300s", text, verdict->check->name,
                                 passes ? "pass" : "fail", verdict->text);
        free(text);
        text = more;
    }
    return text;
}

static bool earns_sentence(const Proof *proof, const Verdicts *verdicts, const Misconception *mistake)
{
    const Entry *entry = verdicts->entry;
    float **got = memory_new((size_t)entry->check_count, sizeof *got, "outputs");
    bool *passes = memory_new((size_t)entry->check_count, sizeof *passes, "verdicts");
    for (int i = 0; i < entry->check_count; i++) {
        got[i] = verdicts->list[i].values;
        passes[i] = verdicts->list[i].grade == GRADE_PASSED;
    }
    bool earned = recorded_mistake(proof->data, entry, got, passes) == mistake;
    free(passes);
    free(got);
    return earned;
}

static void prove_one(Proof *proof, const Judge *judge, const Reference *reference, const char *folder,
                      const Misconception *mistake, const char *work)
{
    const Entry *entry = reference->entry;
    Verdicts verdicts = judge_submission(judge, reference, folder);
    char *text = differences(&verdicts, mistake, strcmp(work, "stub") == 0);
    if (!*text && mistake && judge->seed == 0 && !earns_sentence(proof, &verdicts, mistake)) {
        free(text);
        text =
            text_format("does not earn its sentence; make record EX=%s records what it puts out", entry->id);
    }
    char *what = *text ? text_format("with seed %llu: %s", (unsigned long long)judge->seed, text)
                       : text_format("as it should be");
    say(proof, entry, work, !*text, what);
    free(what);
    free(text);
    verdicts_free(&verdicts);
}

static void prove_mistakes(Proof *proof, const Judge *judge, const Reference *reference)
{
    const Entry *entry = reference->entry;
    bool copied = entry->kind != EXERCISE_GRADED;
    for (int i = 0; i < entry->misconception_count; i++) {
        const Misconception *mistake = &entry->misconceptions[i];
        char *tree = text_format("%s/%s/%s", proof->wrong, entry->id, mistake->mutant);
        copied = copied || strcmp(mistake->mutant, "copied") == 0;
        if (access(tree, F_OK) == 0)
            prove_one(proof, judge, reference, tree, mistake, mistake->mutant);
        else
            say(proof, entry, mistake->mutant, false, "its diff is missing from tests/mutants/exercises");
        free(tree);
    }
    if (!copied)
        say(proof, entry, "copied", false,
            "a graded exercise needs the mistake of pasting in the nearest function that the course prints");
}

static void prove_entry(Proof *proof, Judge *judge, const Entry *entry)
{
    for (int k = 0; k < (entry->kind == EXERCISE_MEASURE ? 1 : SEED_COUNT); k++) {
        judge->seed = SEEDS[k];
        Reference reference = reference_make(judge, entry);
        if (reference.why) {
            say(proof, entry, "solution", false, reference.why);
        } else {
            prove_one(proof, judge, &reference, judge->trees.stubs, NULL, "stub");
            chmod("reference", 0711); // here nothing is secret
            prove_one(proof, judge, &reference, judge->trees.solutions, NULL, "solution");
            prove_mistakes(proof, judge, &reference);
        }
        reference_free(&reference);
    }
}

static bool wanted(int argc, char **argv, const Entry *entry)
{
    for (int i = 1; i < argc; i++)
        if (strcmp(argv[i], entry->id) == 0)
            return true;
    return argc == 1;
}

static char *absolute(const char *folder)
{
    char *path = realpath(folder, NULL);
    if (!path)
        fail_work("%s: is not there; make writes it", folder);
    return path;
}

int main(int argc, char **argv)
{
    const char *named = getenv("BUILD"), *build = named && *named ? named : "build";
    Manifest manifest = manifest_open("exercises/manifest.json", "tests/grade/manifest.schema.json");
    char *wrong = text_format("%s/wrong", build);
    Proof proof = {.data = absolute("tests/data"), .wrong = absolute(wrong)};
    setvbuf(stdout, NULL, _IOLBF, 0);
    Judge judge = judge_open(&manifest, build, 0);
    for (int i = 0; i < manifest.count; i++)
        if (wanted(argc, argv, &manifest.entries[i]))
            prove_entry(&proof, &judge, &manifest.entries[i]);
    judge_close(&judge);
    printf("prove: %d of %d as they should be, confined by %s\n", proof.asked - proof.missed, proof.asked,
           confine_way());
    free((char *)proof.data);
    free((char *)proof.wrong);
    free(wrong);
    manifest_close(&manifest);
    return proof.asked == 0 || proof.missed > 0;
}
