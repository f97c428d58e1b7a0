// manifest: exercises/manifest.json as C. The file is checked against manifest.schema.json, then by what no schema can say: ids ascending and
// unique, check names unique in an exercise, base names unique in the course, builds_on earlier, tolerances above zero, points where they
// belong, generators that exist, misconceptions that name a check.
//
// An exercise is the program build/exercises/NN_M, made of the .c files of its `files`, called as
//     PROGRAM INPUT OUTPUT
// once for each check. INPUT and OUTPUT are raw float32 in the machine's order; OUTPUT has exactly check_values() of them. A `measure` exercise is
// no program but a text file with a line "name = number" for each check (answers.h).
#ifndef MANIFEST_H
#define MANIFEST_H

#include "base.h"

#include <jansson.h>

typedef enum ExerciseKind { EXERCISE_PRACTICE, EXERCISE_GRADED, EXERCISE_MEASURE } ExerciseKind;

// What an output's numbers are: `size` items in x (fastest), y, z, each with `channels` numbers, the fastest of all.
typedef struct Shape {
    const char *of;          // "triangle", "voxel", "pixel": what one item is
    int dimensions, size[3]; // sizes beyond `dimensions` are 1
    int channels;
    const char *channel_names[4]; // NULL where there is one channel without a name
    const char *unit;             // NULL: a plain number
} Shape;

// A number passes where |got - wanted| <= absolute + relative · |wanted|.
typedef struct Tolerance {
    double absolute, relative;
} Tolerance;

typedef struct Check {
    const char *name, *asks; // "random", "the axis of 64 random triangles"
    double points;           // 0 in practice exercises
    const char *input;       // generator of inputs.h; NULL in measure exercises
    Shape shape;
    Tolerance tolerance;
    const char *because; // why this tolerance
} Check;

// A wrong solution that people really write: the diff tests/mutants/exercises/ID/MUTANT.diff against solutions/.
typedef struct Misconception {
    const char *mutant, *says; // the sentence that it earns
    const Check *seen_in;      // the check by whose output it is recognised: tests/data/ID/CHECK.MUTANT.f32
    int loses_count;
    const Check **loses; // these checks and no others
} Misconception;

typedef struct Entry {
    const char *id; // "01.2"
    char *program;  // "01_2": the id as a file name
    ExerciseKind kind;
    const char *title, *goal, *folder; // folder below exercises/ and solutions/, named as the chapter
    int minutes;
    int read_count, file_count, builds_on_count, check_count, misconception_count;
    const char **read, **files, **builds_on;
    Check *checks;
    const char *hints[3]; // nudge, idea, outline
    Misconception *misconceptions;
} Entry;

typedef struct Manifest {
    json_t *root; // owns every text above
    int count;
    Entry *entries; // in the order in which they are met
} Manifest;

// Ends the program (status 1) with one line that names file, place and what would be right.
Manifest manifest_open(const char *file, const char *schema_file);
void manifest_close(Manifest *manifest);
// The same as a question: NULL, or (free it) what is wrong with the manifest. *manifest must be closed either way.
char *manifest_load(const char *file, const char *schema_file, Manifest *manifest);

// NULL where there is none of that id.
const Entry *manifest_find(const Manifest *manifest, const char *id);
const Check *entry_check(const Entry *entry, const char *name);
const char *entry_kind_name(const Entry *entry);
double entry_points(const Entry *entry);
// Numbers in a check's output.
size_t check_values(const Check *check);

#endif
