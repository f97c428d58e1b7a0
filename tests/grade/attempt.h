// attempt: build one exercise from a tree of sources and run it on a check's input. The same for a student's exercises/, build/stubs, build/solutions
// and a submission: a tree holds FOLDER/FILE for each of an exercise's files. Compiler and program both run confined (confine.h).
#ifndef ATTEMPT_H
#define ATTEMPT_H

#include "confine.h"
#include "inputs.h"

typedef struct Attempt {
    const Entry *entry;
    char *root; // the project's folder, for common/ and shaders/; absolute, as all below
    char *tree;
    char *folder; // the one that the children may write; it belongs to the attempt
    char *given;  // FOLDER.given: the inputs, which they may read
    char *build;  // where make has put libexercise.a and exercise_commands
    char *
        kept; // where `given` is copied to at the end, if the attempt takes place in a scratch folder; else NULL
    ConfineScratch place; // that folder
} Attempt;

// --- attempt_place.c
// The working folder is the project's. `folder` is emptied. Where root's children could not read what they need (a clone below /root), the attempt
// takes place on copies in a scratch folder. Ends the program where there is no tree or no build.
Attempt attempt_open(const Entry *entry, const char *tree, const char *build, const char *folder);
void attempt_close(Attempt *attempt); // the folder stays
// Where inputs and program lie once the attempt is closed.
const char *attempt_kept(const Attempt *attempt);

// --- attempt.c

// Compile and link to FOLDER/program. `flags`: further words for the compiler (NULL ends; the pointer may be NULL). Not for measure exercises.
// The result's text is what the compiler said, file names relative to the working folder; CONFINE_EXIT with status 0 is success.
ConfineResult attempt_build(const Attempt *attempt, const char *const *flags);

// What came of one check: `values` (check_values() of them), or NULL and why there are none, as a clause ("ended by signal 11").
// Of a measure exercise the value is the answer that stands in its file.
typedef struct Outcome {
    float *values;
    char *why;           // NULL where there are values
    bool machine_failed; // `why` is not the program's fault: no process could be made
    char *text;          // what the program said; of a measure exercise: what was predicted
    double seconds;
    ConfineEnd end; // of the program; of a measure exercise CONFINE_EXIT
    Input input;    // what it was given
} Outcome;
Outcome attempt_run(const Attempt *attempt, const Check *check, uint64_t seed);
void outcome_free(Outcome *outcome);

#endif
