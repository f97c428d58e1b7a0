// judge: what an exercise's checks are worth: the outputs of a submission's program against those that the solution makes in the same run, on the
// same inputs, under the same limits. No code of a submission is ever part of this process.
#ifndef JUDGE_H
#define JUDGE_H

#include "attempt.h"
#include "compare.h"
#include "submission.h"

// A run of the grader: a scratch folder with copies of all that a program needs. judge_open changes the working folder to it.
typedef struct Judge {
    const Manifest *manifest;
    Trees trees;
    ConfineScratch place;
    const char *scratch; // its path
    uint64_t seed;
    const char *const *flags; // for the compiler, as attempt_build takes them
} Judge;
// `build`: where make has put libexercise.a, exercise_commands, stubs/ and solutions/. Called in the project's folder.
Judge judge_open(const Manifest *manifest, const char *build, uint64_t seed);
void judge_close(Judge *judge);

// What the solution puts out for each check; `why` says why that could not be had: the machine (or the course) has failed, and nobody's work can be
// graded on it.
typedef struct Reference {
    const Entry *entry;
    float **values; // of each check
    char *why;      // NULL where all is well
} Reference;
Reference reference_make(const Judge *judge, const Entry *entry);
void reference_free(Reference *reference);

typedef enum Grade { GRADE_PASSED, GRADE_FAILED, GRADE_NOT_GRADED } Grade;

typedef struct Verdict {
    const Check *check;
    Grade grade;
    char *text;    // sentences for the student
    double ratio;  // of the worst error to its tolerance, infinite for none to be had
    float *values; // what came, or NULL
} Verdict;

typedef struct Verdicts {
    const Entry *entry;
    Verdict *list; // one a check
    char *notes;   // what of the submission was not taken
} Verdicts;
// A file that is missing, does not compile, does not end … fails every check that it should have met. Where there is no output the reference is made
// once more: if that cannot be had either, the machine is at fault and the check is not graded.
Verdicts judge_submission(const Judge *judge, const Reference *reference, const char *folder);
void verdicts_free(Verdicts *verdicts);

#endif
