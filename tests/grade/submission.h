// submission: what a student hands in, taken over file by file: never a link, never more than a file can sensibly be, only what the manifest says
// that a student may edit. Everything else comes from the course's own trees.
#ifndef SUBMISSION_H
#define SUBMISSION_H

#include "manifest.h"

// The trees that a submission is laid over: what each exercise begins with and how it ends, cut from solutions/ (tests/tools/exercises.sh).
typedef struct Trees {
    const char *stubs, *solutions;
} Trees;

typedef struct Submission {
    const char *folder; // holds exercises/NN_name/FILE, NN_name/FILE or FILE
    char *notes;        // what was not taken and why, a line each; "" where all is well; the caller frees it
    int found;          // files taken
} Submission;

// Make `tree`, new, for one exercise: its own files as handed in (one that is missing is missing), those of the exercises that it builds on as they
// should be, so that one mistake costs once, all others as stubs. A file that holds answer and stub side by side (one of solutions/) gives its
// answer; unifdef leaves every other file as it is. Ends the program where the machine fails.
void submission_lay(Submission *submission, const Manifest *manifest, const Entry *entry, Trees trees,
                    const char *tree);

#endif
