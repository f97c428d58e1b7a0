// answers: the file of a `measure` exercise: lines "name = number" and, before it is measured, "predicted name = number". What follows // is comment.
#ifndef ANSWERS_H
#define ANSWERS_H

#include <stdbool.h>

// The number that stands for `name` in the file, exact float32 or not; false, and *why (free it) is a clause, where there is none.
bool answer_read(const char *file, const char *name, double *answer, char **why);

#endif
