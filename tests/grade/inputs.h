// inputs: what an exercise's program is given, drawn from a seed. A generator makes the same numbers on every machine: integers and dyadic
// fractions, no library function that may round differently. Seed 0 is the public one, which `make check` uses and tests/data/ID records.
#ifndef INPUTS_H
#define INPUTS_H

#include "manifest.h"

typedef struct Input {
    float *values;
    size_t count, capacity;
    // Where the numbers of item i of the output begin: head + stride · i, for telling which input was wrong; stride 0: all items share all numbers.
    size_t head, stride;
} Input;

typedef struct Generator {
    const char *name;
    void (*make)(Input *input, const Shape *shape, uint64_t *random);
} Generator;
// By chapter, each ends with a NULL name.
extern const Generator inputs_01[], inputs_01_winding[], inputs_02[], inputs_04[], inputs_06[],
    inputs_06_ball[];

bool input_known(const char *generator);
// Of one check; a check whose input is NULL has an empty one. Checks of one seed draw from streams of their own: adding a check changes no other.
Input input_make(const Entry *entry, const Check *check, uint64_t seed);
void input_free(Input *input);
// Raw float32; written whole or not at all.
void input_write(const Input *input, const char *path);

// For generators.
void input_add(Input *input, double value); // ends the program where float32 does not hold it exactly
uint64_t input_next(uint64_t *random);      // splitmix64
int input_between(uint64_t *random, int low, int high); // low and high included

#endif
