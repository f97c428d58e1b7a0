// compare: an output's numbers against the wanted ones.
#ifndef COMPARE_H
#define COMPARE_H

#include "manifest.h"

typedef struct Comparison {
    size_t count, wrong, nonfinite; // NaN and Inf are wrong, too
    size_t first, worst; // places of the first wrong number and of the worst; count where none is wrong
    double ratio; // of the worst: |got - wanted| / tolerance; infinite for NaN or Inf. At most 1 passes
} Comparison;
Comparison compare_values(const float *got, const float *wanted, size_t count, Tolerance tolerance);
// What the tolerance amounts to at a wanted value.
double tolerance_at(Tolerance tolerance, double wanted);

// Raw float32 of exactly `count` numbers in new memory; else NULL, and *error (free it) says what the file is: missing, of another size.
float *values_read(const char *path, size_t count, char **error);

#endif
