// report: what went wrong in one check, for the one who wrote the program.
#ifndef REPORT_H
#define REPORT_H

#include "attempt.h"
#include "compare.h"

// "triangle 7", "pixel (3, 4)", "voxel (1, 2, 3), channel red": where the number at `place` belongs. Free it.
char *report_where(const Shape *shape, size_t place);

// What came, what was wanted, where, by how much and why that tolerance; a map where the output is a grid or picture. `got` has the check's number of values.
void report_wrong(const Entry *entry, const Check *check, const Outcome *outcome, const float *wanted,
                  const Comparison *comparison);

#endif
