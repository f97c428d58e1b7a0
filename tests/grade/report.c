// report: see report.h.
#include "report.h"
#include "course.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { INDENT = 10, MAP_MOST = 40, INPUT_MOST = 18 };

static size_t item_of(const Shape *shape, size_t place)
{
    return place / (size_t)shape->channels;
}

char *report_where(const Shape *shape, size_t place)
{
    size_t item = item_of(shape, place), channel = place % (size_t)shape->channels;
    int width = shape->size[0], height = shape->size[1];
    int x = (int)(item % (size_t)width), y = (int)(item / (size_t)width % (size_t)height);
    char *at = shape->dimensions == 1   ? text_format("%s %zu", shape->of, item)
               : shape->dimensions == 2 ? text_format("%s (%d, %d)", shape->of, x, y)
                                        : text_format("%s (%d, %d, %d)", shape->of, x, y,
                                                      (int)(item / (size_t)width / (size_t)height));
    if (!shape->channel_names[channel])
        return at;
    char *whole = text_format("%s, %s", at, shape->channel_names[channel]);
    free(at);
    return whole;
}

// The numbers of the input that belong to the output's item, in threes.
static void say_input(const Input *input, size_t item)
{
    if (!input->stride || input->head + input->stride * (item + 1) > input->count)
        return;
    const float *values = input->values + input->head + input->stride * item;
    size_t shown = input->stride < INPUT_MOST ? input->stride : INPUT_MOST, group = shown % 3 ? shown : 3;
    char *text = NULL;
    size_t bytes = 0;
    FILE *out = open_memstream(&text, &bytes);
    fputs("its input:", out);
    for (size_t i = 0; i < shown; i++)
        fprintf(out, " %s%.7g%s", i % group == 0 ? "(" : "", (double)values[i],
                i % group == group - 1 || i == shown - 1 ? ")" : ",");
    fputs(shown < input->stride ? " …" : "", out);
    fclose(out);
    say_wrapped(INDENT, "", text);
    free(text);
}

// --- the map: a letter an item

static char letter(const Check *check, const float *got, const float *wanted, size_t item, bool used[128])
{
    size_t channels = (size_t)check->shape.channels;
    Comparison here =
        compare_values(got + item * channels, wanted + item * channels, channels, check->tolerance);
    bool have = got[item * channels] != 0, want = wanted[item * channels] != 0;
    char c = !here.wrong     ? (want ? '#' : '.')
             : channels > 1  ? 'x'
             : have && !want ? '+'
             : want && !have ? '-'
                             : 'x';
    used[(int)c] = true;
    return c;
}

// Of a grid, the slice that holds the most wrong items.
static int worst_slice(const Check *check, const float *got, const float *wanted)
{
    const Shape *shape = &check->shape;
    size_t values = (size_t)shape->size[0] * (size_t)shape->size[1] * (size_t)shape->channels, most = 0;
    int worst = 0;
    for (int z = 0; z < shape->size[2]; z++) {
        size_t begin = (size_t)z * values;
        size_t wrong = compare_values(got + begin, wanted + begin, values, check->tolerance).wrong;
        if (wrong > most) {
            most = wrong;
            worst = z;
        }
    }
    return worst;
}

static void say_map(const Check *check, const float *got, const float *wanted)
{
    static const char *const meaning[] = {"# right", ". right, 0", "+ too much", "- missing", "x wrong"};
    const Shape *shape = &check->shape;
    if (shape->dimensions == 1 || shape->size[0] > MAP_MOST || shape->size[1] > MAP_MOST / 2)
        return;
    int slice = worst_slice(check, got, wanted);
    bool used[128] = {false};
    putchar('\n');
    for (int row = shape->size[1] - 1; row >= 0; row--) {
        // pictures have their first row at the top, grids grow upwards
        int y = shape->dimensions == 2 ? shape->size[1] - 1 - row : row;
        printf("%*sy=%-3d ", INDENT, "", y);
        for (int x = 0; x < shape->size[0]; x++)
            putchar(letter(check, got, wanted,
                           ((size_t)slice * (size_t)shape->size[1] + (size_t)y) * (size_t)shape->size[0] +
                               (size_t)x,
                           used));
        putchar('\n');
    }
    printf("%*s", INDENT, "");
    if (shape->dimensions == 3)
        printf("the layer z = %d (most is wrong there), x to the right", slice);
    else
        printf("x to the right");
    for (size_t i = 0; i < sizeof meaning / sizeof *meaning; i++)
        if (used[(int)meaning[i][0]])
            printf(";  %s", meaning[i]);
    puts("\n");
}

// --- one check

static void say_number(const Check *check, double got, double wanted)
{
    double error = fabs(got - wanted), room = tolerance_at(check->tolerance, wanted);
    const char *unit = check->shape.unit ? check->shape.unit : "";
    printf("%*sgot %.7g, wanted %.7g", INDENT, "", got, wanted);
    if (isfinite(got))
        printf(": off by %.3g%s%s, allowed are %.3g", error, *unit ? " " : "", unit, room);
    putchar('\n');
}

void report_wrong(const Entry *entry, const Check *check, const Outcome *outcome, const float *wanted,
                  const Comparison *comparison)
{
    const float *got = outcome->values;
    if (entry->kind == EXERCISE_MEASURE) { // what it should be is to be measured, not read here
        printf("%*s%.7g is not what the measurement gives (%s)\n", INDENT, "", (double)got[0], outcome->text);
        say_wrapped(INDENT, "", check->because);
        return;
    }
    printf("%*s%zu of %zu numbers %s wrong", INDENT, "", comparison->wrong, comparison->count,
           comparison->wrong > 1 ? "are" : "is");
    if (comparison->nonfinite)
        printf(", %zu of them NaN or infinite", comparison->nonfinite);
    char *where = report_where(&check->shape, comparison->worst);
    printf("; %s %s:\n", comparison->wrong > 1 ? "the worst at" : "at", where);
    free(where);
    say_number(check, (double)got[comparison->worst], (double)wanted[comparison->worst]);
    say_input(&outcome->input, item_of(&check->shape, comparison->worst));
    say_wrapped(INDENT, "because", check->because);
    say_map(check, got, wanted);
}
