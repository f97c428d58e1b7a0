// support_grade: see support_grade.h.
#include "support_grade.h"
#include "support_course.h"

#include <criterion/criterion.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static void shell(const char *format, const char *a, const char *b)
{
    char *command = text_format(format, a, b);
    cr_assert_eq(system(command), 0, "%s", command);
    free(command);
}

char *grade_data(const char *name)
{
    char *path = text_format("tests/data/grade/%s", name), *text = file_read(path, NULL);
    cr_assert(text, "%s", path);
    free(path);
    return text;
}

void grade_case_open(GradeCase *one, uint64_t seed)
{
    const char *named = getenv("BUILD"), *build = named && *named ? named : "build";
    *one = (GradeCase){.folder = "/tmp/test_grade_XXXXXX"};
    cr_assert(mkdtemp(one->folder));
    // A build folder whose stubs and solutions are these exercises'.
    char *mine = text_format("%s/build", one->folder);
    folder_make(mine);
    for (const char *const *name = (const char *const[]){"libexercise.a", "exercise_commands", NULL}; *name;
         name++) {
        char *from = text_format("%s/%s", build, *name);
        shell("ln -s \"$(realpath %s)\" %s/", from, mine);
        free(from);
    }
    shell("sh tests/tools/exercises.sh stubs %s/stubs %s", mine, "tests/data/grade/solutions");
    shell("sh tests/tools/exercises.sh solutions %s/solutions %s", mine, "tests/data/grade/solutions");
    one->submission = text_format("%s/submission", one->folder);
    shell("cp -R %s/solutions/01_voxelization %s", mine, one->submission);
    one->manifest = manifest_open("tests/data/grade/manifest.json", "tests/grade/manifest.schema.json");
    one->judge = judge_open(&one->manifest, mine, seed);
    free(mine);
}

void grade_case_close(GradeCase *one)
{
    judge_close(&one->judge);
    manifest_close(&one->manifest);
    confine_folder_remove(one->folder);
    free(one->submission);
}

void grade_case_write(const GradeCase *one, const char *path, const char *text)
{
    char *whole = text_format("%s/%s", one->submission, path);
    unlink(whole); // it may be a link
    course_write_at(whole, text);
    free(whole);
}

Verdicts grade_case_judge(const GradeCase *one, const char *id)
{
    Reference reference = reference_make(&one->judge, manifest_find(&one->manifest, id));
    Verdicts verdicts = judge_submission(&one->judge, &reference, one->submission);
    reference_free(&reference);
    return verdicts;
}

double grade_points(const Verdicts *verdicts)
{
    double points = 0;
    for (int i = 0; i < verdicts->entry->check_count; i++)
        points += verdicts->list[i].grade == GRADE_PASSED ? verdicts->list[i].check->points : 0;
    return points;
}
