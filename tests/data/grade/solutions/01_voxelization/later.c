// For the graders' own tests: a later stage, which uses what an earlier one has written. OUTPUT 1 number a triangle: four times its first coordinate.
#include "exercise.h"
#include "twice_words.h"

int main(int argc, char **argv)
{
    Exercise exercise = exercise_open(argc, argv);
    float output[64];
    for (int i = 0; i < 64; i++)
#ifdef SOLUTION
        output[i] = TWICE * TWICE * exercise.input[9 * i];
#else
        output[i] = 1000;
#endif
    return exercise_close(&exercise, output, 64);
}
