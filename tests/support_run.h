// support_run: a chapter made up for testing run. Each command is a process of its own in an empty folder, as a user's would be;
// what the chapter met on its way is in `trace`.
#ifndef SUPPORT_RUN_H
#define SUPPORT_RUN_H

#include <stdbool.h>
#include <stddef.h>

typedef struct Outcome {
    int status;
    char *out, *error, *trace;
} Outcome;

// For TestSuite(…, .init, .fini): a new folder with the chapter's shaders, without a display; and out of it.
void fake_folder_enter(void);
void fake_folder_leave(void);
// Run the chapter with these words; fake_done: it must end with 0; fake_expect: it must end so and say just this on stderr.
Outcome fake_command(const char *line);
Outcome fake_done(const char *line);
void fake_expect(const char *line, int status, const char *error);
// What its stability table checks (expected, got; tolerance 0.1), and whether it gives a truth.
extern double fake_checked[4][2];
extern long fake_nonfinite;
extern bool fake_offers_truth;

void file_put(const char *path, const char *text);
bool there(const char *path);
int files_written(void); // in the folder, beside those that every command makes
size_t count_of(const char *text, const char *part);

#endif
