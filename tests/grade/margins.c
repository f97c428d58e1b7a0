// margins: how far from its tolerance each check keeps: margins [ID…]. The worst error of the solution, over compilers, optimization, GL platforms and
// threads, is to be at most a third of the tolerance (LP_NUM_THREADS, HEADLESS: what the wanted numbers were recorded with is one of them); every known
// mistake that loses the check is to miss it by three times the tolerance at least.
#include "judge.h"
#include "recorded.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const double SOLUTION_MOST = 1.0 / 3, MISTAKE_LEAST = 3;

typedef struct Configuration {
    const char *compiler, *optimization, *headless, *threads;
} Configuration;

// Every compiler with every optimization; GL platforms and threads, which the compiler does not touch, with one of them.
static const Configuration CONFIGURATIONS[] = {
    {"gcc", "-O2", "osmesa", "2"},   {"gcc", "-O2", "osmesa", "1"}, {"gcc", "-O2", "egl", "2"},
    {"gcc", "-O2", "egl", "1"},      {"gcc", "-O0", "osmesa", "2"}, {"clang", "-O2", "osmesa", "2"},
    {"clang", "-O0", "osmesa", "2"},
};

// The first word of exercise_commands is the compiler.
static void set_compiler(const char *commands, const char *compiler)
{
    const char *rest = strchr(commands, '\n');
    FILE *file = fopen("exercise_commands", "w");
    bool written = file && fprintf(file, "%s%s", compiler, rest ? rest : "") > 0;
    if (!file || fclose(file) != 0 || !written)
        fail_work("exercise_commands: %s", strerror(errno));
}

// The worst ratio of each check so far, of one submission against the recorded outputs.
static void measure(const Judge *judge, const Entry *entry, const char *tree, float *const *wanted,
                    double *ratios)
{
    char *place = text_format("%s/measured", judge->scratch);
    Attempt attempt = attempt_open(entry, tree, judge->scratch, place);
    ConfineResult built = {0};
    if (entry->kind != EXERCISE_MEASURE)
        built = attempt_build(&attempt, judge->flags);
    for (int i = 0; i < entry->check_count; i++) {
        const Check *check = &entry->checks[i];
        Outcome outcome = {0};
        if (built.status == 0 && built.end == CONFINE_EXIT)
            outcome = attempt_run(&attempt, check, judge->seed);
        double ratio = INFINITY;
        if (outcome.values)
            ratio = compare_values(outcome.values, wanted[i], check_values(check), check->tolerance).ratio;
        ratios[i] = fmax(ratios[i], ratio);
        outcome_free(&outcome);
    }
    free(built.text);
    attempt_close(&attempt);
    free(place);
}

static void measure_solution(Judge *judge, const Entry *entry, const char *commands, float *const *wanted,
                             double *ratios)
{
    for (size_t k = 0; k < sizeof CONFIGURATIONS / sizeof *CONFIGURATIONS; k++) {
        const Configuration *one = &CONFIGURATIONS[k];
        set_compiler(commands, one->compiler);
        judge->flags = (const char *const[]){one->optimization, NULL};
        setenv("HEADLESS", one->headless, 1);
        setenv("LP_NUM_THREADS", one->threads, 1);
        measure(judge, entry, judge->trees.solutions, wanted, ratios);
    }
    set_compiler(commands, CONFIGURATIONS[0].compiler);
    judge->flags = NULL;
    setenv("HEADLESS", CONFIGURATIONS[0].headless, 1);
    setenv("LP_NUM_THREADS", CONFIGURATIONS[0].threads, 1);
}

// The nearest mistake that loses each check; its name in names[].
static void measure_mistakes(const Judge *judge, const Entry *entry, const char *wrong, float *const *wanted,
                             double *nearest, const char **names)
{
    double *ratios = memory_new((size_t)entry->check_count, sizeof *ratios, "ratios");
    for (int m = 0; m < entry->misconception_count; m++) {
        const Misconception *mistake = &entry->misconceptions[m];
        char *tree = text_format("%s/%s/%s", wrong, entry->id, mistake->mutant);
        memset(ratios, 0, (size_t)entry->check_count * sizeof *ratios);
        measure(judge, entry, tree, wanted, ratios);
        for (int k = 0; k < mistake->loses_count; k++) {
            size_t i = (size_t)(mistake->loses[k] - entry->checks);
            if (!names[i] || ratios[i] < nearest[i]) {
                nearest[i] = ratios[i];
                names[i] = mistake->mutant;
            }
        }
        free(tree);
    }
    free(ratios);
}

// Prints a row a check; returns how many keep too near.
static int margins_of(Judge *judge, const Entry *entry, const char *commands, const char *wrong,
                      const char *data)
{
    size_t count = (size_t)entry->check_count;
    float **wanted = memory_new(count, sizeof *wanted, "wanted");
    double *own = memory_new(count, sizeof *own, "margins"),
           *nearest = memory_new(count, sizeof *nearest, "margins");
    const char **names = memory_new(count, sizeof *names, "names");
    int near = 0;
    for (size_t i = 0; i < count; i++)
        wanted[i] = recorded_read(data, entry, &entry->checks[i], NULL);
    measure_solution(judge, entry, commands, wanted, own);
    measure_mistakes(judge, entry, wrong, wanted, nearest, names);
    for (size_t i = 0; i < count; i++) {
        bool good = own[i] <= SOLUTION_MOST && (!names[i] || nearest[i] >= MISTAKE_LEAST);
        near += !good;
        printf("%-6s %-24s %12.3g   %12.3g  %-28s %s\n", entry->id, entry->checks[i].name, own[i], nearest[i],
               names[i] ? names[i] : "(no mistake loses it)", good ? "" : "TOO NEAR");
        free(wanted[i]);
    }
    free(wanted);
    free(own);
    free(nearest);
    free(names);
    return near;
}

static bool chosen(int argc, char **argv, const Entry *entry)
{
    for (int i = 1; i < argc; i++)
        if (strcmp(argv[i], entry->id) == 0)
            return true;
    return argc == 1;
}

int main(int argc, char **argv)
{
    const char *named = getenv("BUILD"), *build = named && *named ? named : "build";
    Manifest manifest = manifest_open("exercises/manifest.json", "tests/grade/manifest.schema.json");
    char *place = text_format("%s/wrong", build), *wrong = realpath(place, NULL),
         *data = realpath("tests/data", NULL);
    if (!wrong || !data)
        fail_work("%s or tests/data is not there; make margins writes it", place);
    setvbuf(stdout, NULL, _IOLBF, 0);
    Judge judge = judge_open(&manifest, build, 0);
    char *commands = file_read("exercise_commands", NULL);
    chmod("reference", 0711); // here nothing is secret
    printf("Worst error over tolerance: the solution's, in %zu configurations (at most 1/3); the nearest "
           "mistake's (at least 3).\n",
           sizeof CONFIGURATIONS / sizeof *CONFIGURATIONS);
    printf("%-6s %-24s %12s   %12s  %s\n", "", "check", "solution", "mistake", "nearest mistake");
    int near = 0, asked = 0;
    for (int i = 0; i < manifest.count; i++)
        if (chosen(argc, argv, &manifest.entries[i])) {
            near += margins_of(&judge, &manifest.entries[i], commands, wrong, data);
            asked++;
        }
    free(commands);
    judge_close(&judge);
    printf("margins: %d checks keep too near\n", near);
    free(place);
    free(wrong);
    free(data);
    manifest_close(&manifest);
    return near > 0 || asked == 0;
}
