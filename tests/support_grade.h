// support_grade: submissions to the exercises of tests/data/grade, made and judged. For Criterion tests.
#ifndef SUPPORT_GRADE_H
#define SUPPORT_GRADE_H

#include "grade/judge.h"

typedef struct GradeCase {
    char folder[40];  // a new one in /tmp: submission/, out/ and more may be made in it
    char *submission; // FOLDER/submission, a whole and right one
    Manifest manifest;
    Judge judge;
} GradeCase;
// Changes the working folder, as judge_open does.
void grade_case_open(GradeCase *one, uint64_t seed);
void grade_case_close(GradeCase *one);

// Write or replace a file of the submission (a path in it).
void grade_case_write(const GradeCase *one, const char *path, const char *text);
// A file of tests/data/grade, NUL-terminated; the caller frees it. Before grade_case_open alone.
char *grade_data(const char *name);
// The verdicts on "01.1", "01.2" or "01.3"; the caller frees them.
Verdicts grade_case_judge(const GradeCase *one, const char *id);
// How many points they are worth.
double grade_points(const Verdicts *verdicts);

#endif
