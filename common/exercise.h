// exercise: what the program of an exercise is given and gives back: PROGRAM INPUT OUTPUT, both files of raw float32 numbers.
// `make check EX=NN.M` writes the input, runs the program and compares its output with the wanted one.
#ifndef EXERCISE_H
#define EXERCISE_H

#include "base.h"

typedef struct Exercise {
    float *input; // all numbers of INPUT; what they mean is said in each exercise
    size_t count;
    const char *output_file;
} Exercise;

// Reads INPUT. A wrong request (status 2) where the arguments are not two; ends the program (status 1) where INPUT cannot be read.
Exercise exercise_open(int argc, char **argv);
// Writes OUTPUT, whole or not at all, and ends the exercise. Give it to return from main: the exit status, 0.
int exercise_close(Exercise *exercise, const float *output, size_t count);

// The folder of a source file: give it __FILE__ to find the shaders beside it. Kept until the next call.
const char *exercise_folder(const char *source_file);

#endif
