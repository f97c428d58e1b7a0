// How a submission is graded: what is taken from it, what it is worth, what the results say.
#include <criterion/criterion.h>

#include "grade/judge_words.h"
#include "grade/results.h"
#include "support_grade.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { SECONDS = 120 };

static void worth(const GradeCase *one, const char *id, double points, const char *said)
{
    Verdicts verdicts = grade_case_judge(one, id);
    cr_assert_eq(grade_points(&verdicts), points, "%s: %g points, not %g: %s", id, grade_points(&verdicts),
                 points, verdicts.list[0].text);
    char *all = text_format("%s%s", verdicts.notes, verdicts.list[0].text);
    cr_assert(strstr(all, said), "'%s' does not say '%s'", all, said);
    free(all);
    verdicts_free(&verdicts);
}

static void change(const GradeCase *one, const char *path, const char *from, const char *to)
{
    char *whole = text_format("%s/%s", one->submission, path), *text = file_read(whole, NULL);
    char *at = strstr(text, from);
    cr_assert(at, "%s holds no '%s'", path, from);
    char *changed = text_format("%.*s%s%s", (int)(at - text), text, to, at + strlen(from));
    grade_case_write(one, path, changed);
    free(changed);
    free(text);
    free(whole);
}

Test(grade, solutions_get_all, .timeout = SECONDS)
{
    GradeCase one;
    grade_case_open(&one, 7);
    worth(&one, "01.1", 5, "Right");
    worth(&one, "01.2", 4, "Right");
    worth(&one, "01.3", 1, "Right");
    grade_case_close(&one);
}

Test(grade, stubs_get_nothing, .timeout = SECONDS)
{
    GradeCase one;
    grade_case_open(&one, 7);
    char *submission = one.submission;
    one.submission = text_format("%s", one.judge.trees.stubs);
    worth(&one, "01.1", 0, "64 of 64 numbers are wrong");
    worth(&one, "01.2", 0, "64 of 64");
    worth(&one, "01.3", 0, "predicted order");
    free(one.submission);
    one.submission = submission;
    grade_case_close(&one);
}

Test(grade, one_mistake_costs_once, .timeout = SECONDS)
{
    // twice_words.h is 01.1's; 01.2 includes it and is given the reference's.
    GradeCase one;
    grade_case_open(&one, 7);
    change(&one, "twice_words.h", "2.0f", "2.5f");
    worth(&one, "01.1", 0, "wrong");
    worth(&one, "01.2", 4, "Right");
    grade_case_close(&one);
}

Test(grade, files_are_found_flat_or_in_folders, .timeout = SECONDS)
{
    GradeCase one;
    grade_case_open(&one, 7);
    char *command = text_format("cd %s && mkdir -p exercises/01_voxelization 01_voxelization && mv twice.c "
                                "exercises/01_voxelization && "
                                "mv twice_words.h 01_voxelization",
                                one.submission);
    cr_assert_eq(system(command), 0);
    free(command);
    worth(&one, "01.1", 5, "Right");
    grade_case_close(&one);
}

Test(grade, links_and_huge_files_are_not_taken, .timeout = SECONDS)
{
    GradeCase one;
    grade_case_open(&one, 7);
    char *command = text_format("cd %s && mv twice.c real.c && ln -s real.c twice.c", one.submission);
    cr_assert_eq(system(command), 0);
    worth(&one, "01.1", 0, "symbolic link");
    free(command);
    command = text_format("cd %s && rm twice.c && mkdir away && mv real.c away/twice.c && ln -s away "
                          "01_voxelization",
                          one.submission);
    cr_assert_eq(system(command), 0);
    worth(&one, "01.1", 0, "or behind one");
    free(command);
    command = text_format("cd %s && rm -rf 01_voxelization away && head -c 300000 /dev/zero > twice.c",
                          one.submission);
    cr_assert_eq(system(command), 0);
    worth(&one, "01.1", 0, "more than 256 kB");
    free(command);
    command = text_format("cd %s && rm twice.c && mkfifo twice.c", one.submission);
    cr_assert_eq(system(command), 0);
    worth(&one, "01.1", 0, "is not a file");
    free(command);
    grade_case_close(&one);
}

Test(grade, other_files_are_the_courses_own, .timeout = SECONDS)
{
    // A header of the course's name beside the exercise is no file that a student may edit.
    GradeCase one;
    grade_case_open(&one, 7);
    grade_case_write(&one, "exercise.h", "#error mine\n");
    grade_case_write(&one, "01_voxelization/exercise.h", "#error mine\n");
    worth(&one, "01.1", 5, "Right");
    grade_case_close(&one);
}

Test(grade, a_file_of_solutions_gives_its_answer, .timeout = SECONDS)
{
    char *both = grade_data("solutions/01_voxelization/twice.c"),
         *words = grade_data("solutions/01_voxelization/twice_words.h");
    GradeCase one;
    grade_case_open(&one, 7);
    grade_case_write(&one, "twice.c", both);
    grade_case_write(&one, "twice_words.h", words);
    worth(&one, "01.1", 5, "Right");
    free(both);
    free(words);
    grade_case_close(&one);
}

Test(grade, what_is_missing_has_failed, .timeout = SECONDS)
{
    GradeCase one;
    grade_case_open(&one, 7);
    char *file = text_format("%s/twice.c", one.submission);
    unlink(file);
    worth(&one, "01.1", 0, "twice.c is missing from what was handed in");
    worth(&one, "01.2", 4, "Right");
    free(file);
    grade_case_close(&one);
}

Test(grade, a_compiler_error_is_shown_at_the_students_line, .timeout = SECONDS)
{
    GradeCase one;
    grade_case_open(&one, 7);
    change(&one, "twice.c", "float output[64];", "float output[many]");
    worth(&one, "01.1", 0, "\n01_voxelization/twice.c:8:18: error");
    grade_case_close(&one);
}

Test(grade, what_the_machine_cannot_do_is_not_graded, .timeout = SECONDS)
{
    GradeCase one;
    grade_case_open(&one, 7);
    unlink(
        "libexercise.a"); // in the scratch folder: neither the solution's program nor anyone's can be linked
    Verdicts verdicts = grade_case_judge(&one, "01.1");
    cr_assert_eq(verdicts.list[0].grade, GRADE_NOT_GRADED);
    cr_assert_eq(verdicts.list[1].grade, GRADE_NOT_GRADED);
    verdicts_free(&verdicts);
    grade_case_close(&one);
}

Test(grade, a_machine_that_fails_midway_is_not_the_students_fault, .timeout = SECONDS)
{
    GradeCase one;
    grade_case_open(&one, 7);
    Reference reference = reference_make(&one.judge, manifest_find(&one.manifest, "01.1"));
    cr_assert_null(reference.why, "%s", reference.why);
    unlink("libexercise.a");
    Verdicts verdicts = judge_submission(&one.judge, &reference, one.submission);
    cr_assert_eq(verdicts.list[1].grade, GRADE_NOT_GRADED, "%s", verdicts.list[1].text);
    verdicts_free(&verdicts);
    reference_free(&reference);
    grade_case_close(&one);
}

Test(grade, the_seed_decides_the_inputs, .timeout = SECONDS)
{
    GradeCase one;
    grade_case_open(&one, 7);
    const Entry *entry = manifest_find(&one.manifest, "01.1");
    Reference seven = reference_make(&one.judge, entry), again = reference_make(&one.judge, entry);
    one.judge.seed = 8;
    Reference eight = reference_make(&one.judge, entry);
    cr_assert_eq(memcmp(seven.values[0], again.values[0], 64 * sizeof(float)), 0);
    cr_assert_neq(memcmp(seven.values[0], eight.values[0], 64 * sizeof(float)), 0);
    reference_free(&seven);
    reference_free(&again);
    reference_free(&eight);
    grade_case_close(&one);
}

// --- words and results, from verdicts made by hand

Test(grade, words_say_what_where_and_how_far)
{
    Manifest manifest = manifest_open("tests/data/grade/manifest.json", "tests/grade/manifest.schema.json");
    const Check *check = &manifest.entries[0].checks[0];
    float wanted[64] = {0}, got[64] = {0};
    got[5] = 1;
    Comparison comparison = compare_values(got, wanted, 64, check->tolerance);
    char *words = judge_words(check, &comparison, got, wanted);
    cr_assert(strstr(words, "1 of 64") && strstr(words, "triangle 5: got 1, wanted 0") &&
                  strstr(words, "1e+06 times"),
              "%s", words);
    free(words);
    got[9] = NAN;
    comparison = compare_values(got, wanted, 64, check->tolerance);
    words = judge_words(check, &comparison, got, wanted);
    cr_assert(strstr(words, "1 of 64 numbers are not finite (NaN or infinite)"), "%s", words);
    free(words);
    manifest_close(&manifest);
}

static json_t *results_of(Grade first, const char *text, const char *folder)
{
    Manifest manifest = manifest_open("tests/data/grade/manifest.json", "tests/grade/manifest.schema.json");
    Entry *entry = &manifest.entries[0];
    Verdict list[] = {{.check = &entry->checks[0], .grade = first, .text = text_format("%s", text)},
                      {.check = &entry->checks[1], .grade = GRADE_PASSED, .text = text_format("Right.")}};
    Verdicts verdicts = {.entry = entry, .list = list, .notes = text_format("%s", "")};
    results_write(&(Results){.count = 1, .exercises = &verdicts, .seed = 7, .confined = "nothing"}, folder);
    char *path = text_format("%s/results.json", folder);
    json_t *root = json_load_file(path, 0, NULL);
    cr_assert(root, "%s", path);
    free(path);
    free(list[0].text);
    free(list[1].text);
    free(verdicts.notes);
    manifest_close(&manifest);
    return root;
}

static double number_at(json_t *object, const char *key)
{
    json_t *number = json_object_get(object, key);
    cr_assert(json_is_number(number), "%s", key);
    return json_number_value(number);
}

Test(grade, results_follow_gradescopes_schema)
{
    char folder[] = "/tmp/test_results_XXXXXX";
    cr_assert(mkdtemp(folder));
    json_t *root = results_of(GRADE_FAILED, "It said \xff \"quoted\"\n.", folder);
    json_t *tests = json_object_get(root, "tests"), *test = json_array_get(tests, 0);
    cr_assert_eq(number_at(root, "score"), 3);
    cr_assert_eq(json_array_size(tests), 2);
    cr_assert_eq(number_at(test, "score"), 0);
    cr_assert_eq(number_at(test, "max_score"), 2);
    cr_assert_str_eq(json_string_value(json_object_get(test, "status")), "failed");
    cr_assert_str_eq(json_string_value(json_object_get(test, "visibility")), "visible");
    cr_assert_str_eq(json_string_value(json_object_get(test, "output")), "It said ? \"quoted\"\n.");
    cr_assert_str_eq(json_string_value(json_object_get(json_array_get(tests, 1), "status")), "passed");
    json_decref(root);
    char *path = text_format("%s/score.txt", folder), *score = file_read(path, NULL);
    cr_assert_str_eq(score, "3 of 5\n");
    free(score);
    free(path);
    confine_folder_remove(folder);
}

Test(grade, no_number_stands_where_a_check_was_not_graded)
{
    char folder[] = "/tmp/test_results_XXXXXX";
    cr_assert(mkdtemp(folder));
    json_t *root = results_of(GRADE_NOT_GRADED, "no GL", folder);
    cr_assert_null(json_object_get(root, "score"));
    for (size_t i = 0; i < 2; i++) {
        json_t *test = json_array_get(json_object_get(root, "tests"), i);
        cr_assert_null(json_object_get(test, "score"));
        cr_assert_eq(json_object_get(test, "status") == NULL, i == 0);
    }
    json_decref(root);
    char *path = text_format("%s/score.txt", folder), *score = file_read(path, NULL);
    cr_assert_eq(strncmp(score, "not graded", 10), 0, "%s", score);
    free(score);
    free(path);
    confine_folder_remove(folder);
}

// A grader that is killed, or that fails on its way, cannot remove its scratch folder: the next one does; but none that is in use, new or not its own.
Test(grade, what_a_killed_grader_left_is_removed, .timeout = SECONDS)
{
    char folder[] = "/tmp/test_scratch_XXXXXX", found[256];
    cr_assert(mkdtemp(folder) && setenv("TMPDIR", folder, 1) == 0);
    cr_assert_eq(system("cd $TMPDIR && mkdir -p grade_killed/sub grade_recent grade_longer_name other_killed "
                        "&& chmod 0 grade_killed/sub"),
                 0);
    ConfineScratch used = confine_scratch_open("grade");
    cr_assert_eq(system("cd $TMPDIR && touch -d '1 hour ago' * && touch grade_recent"), 0);
    ConfineScratch next = confine_scratch_open("grade");
    FILE *list = popen("cd $TMPDIR && echo *killed* *longer* *recent*", "r");
    cr_assert(fgets(found, sizeof found, list));
    pclose(list);
    cr_expect_str_eq(found, "other_killed grade_longer_name grade_recent\n");
    cr_expect(access(used.path, F_OK) == 0 && access(next.path, F_OK) == 0);
    confine_scratch_close(&next);
    confine_scratch_close(&used);
    confine_folder_remove(folder);
}
