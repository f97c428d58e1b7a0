// results: verdicts as files: results.json in Gradescope's schema and score.txt, each written whole or not at all.
#ifndef RESULTS_H
#define RESULTS_H

#include "judge.h"

typedef struct Results {
    int count; // exercises
    const Verdicts *exercises;
    uint64_t seed;
    const char *confined; // confine_way()
} Results;

typedef struct Total {
    double score, most;
    int not_graded; // checks
} Total;
Total results_total(const Results *results);

// Into `folder`, which is made. Where a check is not graded no number stands in either file: a sum without it would be a zero for it.
void results_write(const Results *results, const char *folder);

#endif
