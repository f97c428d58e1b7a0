// judge_words: a comparison as sentences for the one who wrote the program.
#ifndef JUDGE_WORDS_H
#define JUDGE_WORDS_H

#include "compare.h"

// How many numbers are wrong and where the first one is, what came, what was wanted, what tolerance and why. The caller frees it.
char *judge_words(const Check *check, const Comparison *comparison, const float *got, const float *wanted);

#endif
