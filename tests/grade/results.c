// results: see results.h. The schema: https://gradescope-autograders.readthedocs.io/en/latest/specs/#output-format
#include "results.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

Total results_total(const Results *results)
{
    Total total = {0};
    for (int i = 0; i < results->count; i++)
        for (int k = 0; k < results->exercises[i].entry->check_count; k++) {
            const Verdict *verdict = &results->exercises[i].list[k];
            total.most += verdict->check->points;
            total.score += verdict->grade == GRADE_PASSED ? verdict->check->points : 0;
            total.not_graded += verdict->grade == GRADE_NOT_GRADED;
        }
    return total;
}

static void write_text(const char *folder, const char *name, const char *text)
{
    char *path = text_format("%s/%s", folder, name);
    const char *temporary = file_begin(path);
    FILE *file = fopen(temporary, "w");
    bool written = file && fputs(text, file) >= 0;
    if (!file || fclose(file) != 0 || !written)
        fail_work("%s: cannot be written: %s", path, strerror(errno));
    file_commit(temporary);
    free(path);
}

// A student's program may print any bytes; JSON holds UTF-8 alone.
static json_t *string_of(const char *text)
{
    char *clean = text_format("%s", text);
    json_t *string = json_string(clean);
    if (!string) {
        for (char *c = clean; *c; c++)
            if ((unsigned char)*c >= 0x80)
                *c = '?';
        string = json_string(clean);
    }
    free(clean);
    return string;
}

// `numbers`: whether scores are to be told at all.
static json_t *test_of(const Entry *entry, const Verdict *verdict, int number, bool numbers)
{
    json_t *test = json_object();
    char *name = text_format("%s %s: %s", entry->id, entry->title, verdict->check->asks);
    char *place = text_format("%s.%d", entry->id, number);
    bool graded = verdict->grade != GRADE_NOT_GRADED;
    if (numbers) {
        json_object_set_new(test, "score",
                            json_real(verdict->grade == GRADE_PASSED ? verdict->check->points : 0));
        json_object_set_new(test, "max_score", json_real(verdict->check->points));
    }
    if (graded)
        json_object_set_new(test, "status",
                            json_string(verdict->grade == GRADE_PASSED ? "passed" : "failed"));
    json_object_set_new(test, "name", json_string(name));
    json_object_set_new(test, "number", json_string(place));
    char *text = text_format("%s%s", graded ? "" : "Not graded, by no fault of yours: ", verdict->text);
    json_object_set_new(test, "output", string_of(text));
    json_object_set_new(test, "visibility", json_string("visible"));
    free(text);
    free(place);
    free(name);
    return test;
}

void results_write(const Results *results, const char *folder)
{
    Total total = results_total(results);
    bool numbers = total.not_graded == 0;
    json_t *root = json_object(), *tests = json_array();
    char *notes = text_format("%s", ""), *score;
    for (int i = 0; i < results->count; i++) {
        const Verdicts *verdicts = &results->exercises[i];
        for (int k = 0; k < verdicts->entry->check_count; k++)
            json_array_append_new(tests, test_of(verdicts->entry, &verdicts->list[k], k + 1, numbers));
        char *more = text_format("%s%s", notes, verdicts->notes);
        free(notes);
        notes = more;
    }
    score = numbers ? text_format("%g of %g\n", total.score, total.most)
                    : text_format("not graded: %d checks could not be run here; see results.json\n",
                                  total.not_graded);
    char *output = text_format("%s%s", notes, score),
         *seed = text_format("%llu", (unsigned long long)results->seed);
    if (numbers)
        json_object_set_new(root, "score", json_real(total.score));
    json_object_set_new(root, "output", string_of(output));
    json_object_set_new(root, "visibility", json_string("visible"));
    json_object_set_new(root, "tests", tests);
    json_object_set_new(root, "extra_data",
                        json_pack("{s:s, s:s}", "seed", seed, "confined_by", results->confined));
    char *dumped = json_dumps(root, JSON_INDENT(2) | JSON_REAL_PRECISION(9));
    if (!dumped)
        fail_work("results.json: out of memory");
    char *text = text_format("%s\n", dumped);
    folder_make(folder);
    write_text(folder, "results.json", text);
    write_text(folder, "score.txt", score);
    free(dumped);
    free(text);
    free(seed);
    free(output);
    free(score);
    free(notes);
    json_decref(root);
}
