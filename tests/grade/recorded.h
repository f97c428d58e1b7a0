// recorded: the outputs of the public seed 0 in tests/data/ID/: CHECK.f32 of the solution, CHECK.MUTANT.f32 of a known mistake. With them a
// student's work is judged in a tree without solutions.
#ifndef RECORDED_H
#define RECORDED_H

#include "manifest.h"

// `mutant` NULL: the solution's. The caller frees both.
char *recorded_path(const char *data, const Entry *entry, const Check *check, const char *mutant);
// check_values() numbers. Ends the program (status 1) where the file is missing or of another size: make record writes it.
float *recorded_read(const char *data, const Entry *entry, const Check *check, const char *mutant);

// The known mistake that these outputs are: its table loses just the checks that fail here, and the output of its `seen_in` is this one. NULL: none
// that we know. `got` holds NULL for a check without output; all in the entry's order.
const Misconception *recorded_mistake(const char *data, const Entry *entry, float *const *got,
                                      const bool *passes);

#endif
