// support_course: commands of the exercises, run in a folder of their own that is removed again.
#ifndef SUPPORT_COURSE_H
#define SUPPORT_COURSE_H

#include <stdbool.h>

// For TestSuite(…, .init, .fini).
void course_folder_make(void);
void course_folder_remove(void);
const char *course_folder(void);

// What a shell's command prints (stdout and stderr), $T the folder, $B the build; its exit status goes to *status. Kept until the folder is removed.
const char *course_shell(int *status, const char *command);
// The same, which must end with this status.
const char *course_says(int status, const char *command);
// course in that folder: its tree $T/tree, progress $T/progress. `made` is the tree to begin with: stubs or solutions.
void course_tree(const char *made);
#define COURSE "$B/course --tree $T/tree --build $B --out $T/out --work $T/work --progress $T/progress "

void course_write(const char *name, const char *text);    // a file of the folder
void course_write_at(const char *path, const char *text); // any file; its folder is made
// Every word list ends with NULL: all must stand in the text, none of them.
bool course_has(const char *text, const char *const *words);

// What one item of the output should be by an exercise's own words: up to four channels. `got` is what is recorded.
typedef void (*CourseDefinition)(const float *in, const float *got, double *wanted);
// Exercise `id`: what is recorded as right is what is defined, to a tenth of the tolerance; what is recorded of each known mistake is not.
void course_judge(const char *id, CourseDefinition definition);

#endif
