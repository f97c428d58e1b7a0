// course: what the learner's commands share: where things are, what is solved, how text is printed.
#ifndef COURSE_H
#define COURSE_H

#include "manifest.h"

typedef struct Course {
    Manifest manifest;
    const char *tree, *build, *data, *out; // exercises/, build/, tests/data/, out/
    const char *work;                      // build/check: where programs are built and run
    const char *solutions;                 // solutions/; a handout has none
    const char *progress_file;             // .progress
    json_t *progress;                      // {"01.2": {"solved": true, "passes": true, "hints": 1}, …}
} Course;

// --- progress.c. A progress file that is no JSON ends the program: it is the student's, and not to be overwritten.
void progress_read(Course *course);
void progress_write(const Course *course);
bool progress_flag(const Course *course, const Entry *entry, const char *flag);
void progress_set_flag(Course *course, const Entry *entry, const char *flag, bool value);
int progress_hints(const Course *course, const Entry *entry);
void progress_set_hints(Course *course, const Entry *entry, int hints);
// The first one that does not pass, or NULL.
const Entry *progress_next(const Course *course);

// --- say.c: one screen of text, 80 columns wide.
// Words of `text`, wrapped, after `label` in a column of its own.
void say_wrapped(int indent, const char *label, const char *text);
// [#####-----] of `of`.
void say_bar(int done, int of);
// The file's path from the working folder; free it.
char *course_path(const Course *course, const Entry *entry, int file);

// --- learn.c: each returns the exit status.
int course_next(const Course *course);
int course_progress(const Course *course);
int course_hint(Course *course, const Entry *entry);
int course_solution(const Course *course, const Entry *entry);

// --- check.c: 0 where every check passes, else 1.
int course_check(Course *course, const Entry *entry);
// --- watch.c: check on every save, until interrupted.
int course_watch(Course *course, const Entry *entry);
// --- record.c: tests/data/ID/ from the solutions and the mutants in `trees`: solutions/ and mutants/ID/NAME/ of build.
int course_record(const Course *course, const Entry *entry);

#endif
