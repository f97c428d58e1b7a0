// grade: grade one submission: grade DIR OUT [--seed N] [--exercises "02.2 02.3"]. See README.md beside this file.
#include "results.h"

#include <errno.h>
#include <getopt.h>
#include <stdlib.h>
#include <string.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

typedef struct Request {
    char *folder, *out;
    const char *exercises; // ids, blanks between; NULL: all that have points
    uint64_t seed;
} Request;

static char *absolute_folder(const char *path)
{
    struct stat about;
    char *real = realpath(path, NULL);
    if (!real || stat(real, &about) != 0 || !S_ISDIR(about.st_mode))
        fail_request("DIR=%s: a folder with a submission is needed: %s", path,
                     real ? "this is none" : strerror(errno));
    return real;
}

static uint64_t seed_of(const char *text)
{
    char *end;
    errno = 0;
    unsigned long long seed = strtoull(text, &end, 10);
    if (errno || end == text || *end || *text == '-')
        fail_request("SEED=%s: a whole number from 0 to 18446744073709551615 is needed", text);
    return seed;
}

static Request request_of(int argc, char **argv)
{
    static const struct option options[] = {
        {"seed", required_argument, NULL, 's'}, {"exercises", required_argument, NULL, 'e'}, {0}};
    Request request = {0};
    bool seeded = false;
    for (int option; (option = getopt_long(argc, argv, "", options, NULL)) != -1;) {
        if (option == 's' && *optarg)
            request.seed = seed_of(optarg), seeded = true;
        else if (option == 'e')
            request.exercises = *optarg ? optarg : NULL;
        else if (option == '?')
            exit(2);
    }
    if (argc - optind != 2 || !*argv[optind] || !*argv[optind + 1])
        fail_request("a submission and a folder for the results are needed: make grade DIR=submission "
                     "[OUT=folder] [SEED=n] [EX=\"02.2 02.3\"]");
    request.folder = absolute_folder(argv[optind]);
    folder_make(argv[optind + 1]);
    request.out = absolute_folder(argv[optind + 1]);
    // Nobody can know the inputs beforehand; the results name the seed, so that the same run can be had again.
    if (!seeded && getrandom(&request.seed, sizeof request.seed, 0) != (ssize_t)sizeof request.seed)
        fail_work("no random seed to be had: %s", strerror(errno));
    return request;
}

static bool wanted(const Request *request, const Entry *entry)
{
    if (!request->exercises)
        return entry_points(entry) > 0;
    char *all = text_format(" %s ", request->exercises), *one = text_format(" %s ", entry->id);
    bool found = strstr(all, one) != NULL;
    free(all);
    free(one);
    return found;
}

static void require_known(const Request *request, const Manifest *manifest)
{
    char *all = request->exercises ? text_format("%s", request->exercises) : NULL, *rest;
    for (char *id = all ? strtok_r(all, " ", &rest) : NULL; id; id = strtok_r(NULL, " ", &rest))
        if (!manifest_find(manifest, id))
            fail_request("EX=%s: there is no such exercise; make progress lists them", id);
    free(all);
}

static void print(const Verdicts *verdicts)
{
    static const char *const words[] = {"passed", "failed", "not graded"};
    for (int i = 0; i < verdicts->entry->check_count; i++) {
        const Verdict *verdict = &verdicts->list[i];
        printf("%s %-22s %-10s %4g of %g\n", verdicts->entry->id, verdict->check->name, words[verdict->grade],
               verdict->grade == GRADE_PASSED ? verdict->check->points : 0, verdict->check->points);
    }
}

int main(int argc, char **argv)
{
    umask(022); // children of root's are another user, who must read what is made here
    Request request = request_of(argc, argv);
    Manifest manifest = manifest_open("exercises/manifest.json", "tests/grade/manifest.schema.json");
    require_known(&request, &manifest);
    const char *build = getenv("BUILD");
    printf("confined by %s; seed %llu\n", confine_way(), (unsigned long long)request.seed);
    Judge judge = judge_open(&manifest, build && *build ? build : "build", request.seed);
    Verdicts *list = memory_new((size_t)manifest.count, sizeof *list, "verdicts");
    Results results = {.exercises = list, .seed = request.seed, .confined = confine_way()};
    for (int i = 0; i < manifest.count; i++) {
        if (!wanted(&request, &manifest.entries[i]))
            continue;
        Reference reference = reference_make(&judge, &manifest.entries[i]);
        list[results.count] = judge_submission(&judge, &reference, request.folder);
        print(&list[results.count++]);
        reference_free(&reference);
    }
    judge_close(&judge);
    if (!results.count)
        fail_request("no exercise here carries points yet; EX=\"01.1\" grades one without");
    results_write(&results, request.out);
    Total total = results_total(&results);
    if (total.not_graded)
        note("%d checks not graded, so there is no score: see %s/results.json", total.not_graded,
             request.out);
    else
        printf("%g of %g: %s/results.json\n", total.score, total.most, request.out);
    for (int i = 0; i < results.count; i++)
        verdicts_free(&list[i]);
    free(list);
    free(request.folder);
    free(request.out);
    manifest_close(&manifest);
    return total.not_graded ? 1 : 0;
}
