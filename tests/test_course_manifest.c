// exercises/manifest.json: that it is right as it stands, and that what is wrong with it is named. And the small parts below: schema, inputs, comparison,
// answers.
#include <criterion/criterion.h>

#include "failure.h"
#include "grade/answers.h"
#include "grade/compare.h"
#include "grade/inputs.h"
#include "grade/schema.h"
#include "support_course.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SCHEMA "tests/grade/manifest.schema.json"
TestSuite(course_manifest, .init = course_folder_make, .fini = course_folder_remove, .timeout = 60);

Test(course_manifest, the_course_s_own_is_right)
{
    Manifest manifest;
    char *error = manifest_load("exercises/manifest.json", SCHEMA, &manifest);
    cr_assert(!error, "%s", error);
    int graded = 0, practice = 0, measure = 0;
    for (int i = 0; i < manifest.count; i++) {
        const Entry *entry = &manifest.entries[i];
        graded += entry->kind == EXERCISE_GRADED;
        practice += entry->kind == EXERCISE_PRACTICE;
        measure += entry->kind == EXERCISE_MEASURE;
        if (entry->kind != EXERCISE_GRADED)
            continue;
        bool copied = false; // the nearest shipped function, pasted in
        for (int j = 0; j < entry->misconception_count; j++)
            copied = copied || !strcmp(entry->misconceptions[j].mutant, "copied");
        cr_expect(copied, "%s is graded and has no mutant `copied`", entry->id);
    }
    cr_expect(graded >= 2 && practice >= 1 && measure >= 1);
    manifest_close(&manifest);
}

// The course's manifest, changed by jq, must be refused with these words.
static void refused(const char *change, const char *says, const char *where)
{
    char *command = text_format("jq '%s' exercises/manifest.json >$T/manifest.json", change);
    course_says(0, command);
    char *file = text_format("%s/manifest.json", course_folder());
    Manifest manifest;
    char *error = manifest_load(file, SCHEMA, &manifest);
    cr_assert(error, "%s: not refused", change);
    cr_assert(strstr(error, says) && strstr(error, where), "%s: '%s' says neither '%s' nor '%s'", change,
              error, says, where);
    free(error);
    manifest_close(&manifest);
    free(file);
    free(command);
}

Test(course_manifest, what_the_schema_forbids)
{
    refused("del(.exercises[0].hints)", "has no \"hints\"", "exercises[0]");
    refused(".exercises[1].hints |= .[:2]", "2 items; should be at least 3", "exercises[1].hints");
    refused(".exercises[1].hints[2] = \"\"", "0 bytes", "exercises[1].hints[2]");
    refused("del(.exercises[0].checks[1].because)", "has no \"because\"", "exercises[0].checks[1]");
    refused(".exercises[0].kind = \"easy\"", "one of [\"practice\"", "exercises[0].kind");
    refused(".exercises[0].id = \"1.1\"", "should look like", "exercises[0].id");
    refused(".exercises[0].minutes = 2.5", "of type integer", "minutes");
    refused(".exercises[0].misconceptions |= .[:3]", "at least 4", "misconceptions");
    refused(".exercises[0].extra = 1", "\"extra\" is not known", "exercises[0]");
    refused(".exercises[0].checks[0].tolerance.relative = 0.7", "at most 0.5", "relative");
}

Test(course_manifest, what_no_schema_can_say)
{
    refused(".exercises[1].files = [\"dominant_axis.c\"]", "dominant_axis.c is 01.1's file, too", "01.2");
    refused(".exercises[0].checks[1].name = \"random\"", "two checks are called random", "01.1");
    refused(".exercises[0].checks[0].points = 1", "practice has none", "01.1");
    refused(".exercises[1].checks[0].points = 0", "more than 0", "01.2");
    refused(".exercises[0].checks[0].tolerance.absolute = 0", "the tolerance is 0", "01.1");
    refused(".exercises[0].checks[0].input = \"nowhere\"", "no generator", "nowhere");
    refused(".exercises[0].misconceptions[0].loses = [\"nothing\"]", "a check that does not exist",
            "sign_kept");
    refused(".exercises[0].misconceptions[0].loses = [\"ties\"]", "seen_in", "sign_kept");
    refused(".exercises[0].misconceptions[1].mutant = \"sign_kept\"", "two misconceptions", "sign_kept");
    refused(".exercises[0].builds_on = [\"01.2\"]", "no earlier exercise", "01.1");
    refused(".exercises |= [.[3], .[2]]", "ids ascend", "01.3");
    refused(".exercises[0].folder = \"02_shadow_maps\"", "another chapter", "01.1");
}

Test(course_manifest, broken_json_is_named_by_its_line)
{
    course_write("broken.json", "{\n  \"exercises\": [\n}\n");
    char *file = text_format("%s/broken.json", course_folder());
    Manifest manifest;
    char *error = manifest_load(file, SCHEMA, &manifest);
    cr_assert(error && strstr(error, "broken.json:3:"), "%s", error);
    free(error);
    manifest_close(&manifest);
    free(file);
}

Test(course_manifest, a_schema_is_read_to_its_last_keyword)
{
    json_t *schema = json_pack("{s:s, s:i}", "type", "number", "multipleOf", 2), *four = json_integer(4);
    char *error = schema_error(schema, four, "x");
    cr_assert(error && strstr(error, "multipleOf"), "%s", error);
    free(error);
    json_decref(schema);
    json_decref(four);
}

Test(course_manifest, inputs_depend_on_seed_and_check_alone)
{
    Manifest manifest = manifest_open("exercises/manifest.json", SCHEMA);
    for (int i = 0; i < manifest.count; i++)
        for (int c = 0; c < manifest.entries[i].check_count; c++) {
            const Entry *entry = &manifest.entries[i];
            const Check *check = &entry->checks[c];
            Input one = input_make(entry, check, 3), same = input_make(entry, check, 3),
                  other = input_make(entry, check, 4);
            cr_expect(one.count == same.count &&
                          (!one.count || !memcmp(one.values, same.values, one.count * sizeof(float))),
                      "%s %s: seed 3 is not seed 3", entry->id, check->name);
            cr_expect(!check->input || one.count != other.count ||
                          memcmp(one.values, other.values, one.count * sizeof(float)),
                      "%s %s: seed 4 is seed 3", entry->id, check->name);
            for (size_t v = 0; v < one.count; v++)
                cr_assert(isfinite(one.values[v]), "%s %s: input %zu", entry->id, check->name, v);
            input_free(&one);
            input_free(&same);
            input_free(&other);
        }
    manifest_close(&manifest);
}

static void add_a_third(void)
{
    Input input = {0};
    input_add(&input, 1.0 / 3);
}

Test(course_manifest, an_input_is_a_float32)
{
    Failure failure = failure_of(add_a_third);
    cr_assert(failure.status == 1 && failure_says(&failure, "is no float32"), "%s", failure.message);
}

Test(course_manifest, comparison_counts_what_is_beyond_its_tolerance)
{
    const float wanted[] = {10, 10, -10, 0, 1, 1}, got[] = {11, 11.25f, -8.5f, 0.5f, NAN, INFINITY};
    Comparison all = compare_values(got, wanted, 6, (Tolerance){0.5, 0.05}); // 1 at 10, 0.5 at 0, 0.55 at 1
    cr_expect_eq(all.wrong, 4);
    cr_expect_eq(all.nonfinite, 2);
    cr_expect_eq(all.first, 1);
    cr_expect_eq(all.worst, 4);
    Comparison finite = compare_values(got, wanted, 4, (Tolerance){0.5, 0.05});
    cr_expect(finite.wrong == 2 && finite.worst == 2 && finite.ratio == 1.5);
    Comparison none = compare_values(wanted, wanted, 6, (Tolerance){0, 0.1});
    cr_expect(none.wrong == 0 && none.ratio == 0 && none.worst == 6);
}

Test(course_manifest, answers_are_read_or_refused)
{
    course_write("a.txt", "// width = 7\nwidth = 1.5e-2 // m\n  height=-3\nwidth_2 = 8\ndepth = deep\nempty "
                          "= // soon\ntwice = 1\ntwice = 2\n");
    char *file = text_format("%s/a.txt", course_folder()), *why;
    double answer = 0;
    cr_expect(answer_read(file, "width", &answer, &why) && answer == 1.5e-2);
    cr_expect(answer_read(file, "height", &answer, &why) && answer == -3);
    static const char *const wrong[][2] = {{"depth", "a.txt:5: \"depth = deep\" is no number"},
                                           {"empty", "a.txt:6: \"empty =\" has no number yet"},
                                           {"twice", "more than one line"},
                                           {"lost", "no line \"lost = number\""}};
    for (int i = 0; i < 4; i++) {
        cr_expect(!answer_read(file, wrong[i][0], &answer, &why) && strstr(why, wrong[i][1]), "%s: %s",
                  wrong[i][0], why);
        free(why);
    }
    free(file);
}
