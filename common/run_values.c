// run_values: the values of parameters, from text, to text, and for the chapter.
#include "run_internal.h"
#include <ctype.h>
#include <stdlib.h>
#include <string.h>

char *run_names_join(const void *items, size_t stride)
{
    char *all = NULL;
    size_t bytes = 0;
    FILE *to = open_memstream(&all, &bytes);
    for (const char *item = items; item && *(const char *const *)(const void *)item; item += stride)
        fprintf(to, " %s", *(const char *const *)(const void *)item);
    fclose(to);
    return all;
}

int run_word_find(const char *words, const char *wanted)
{
    int index = 0;
    for (words += strspn(words, " "); *words;
         words += strcspn(words, " "), words += strspn(words, " "), ++index)
        if (strcspn(words, " ") == strlen(wanted) && strncmp(words, wanted, strlen(wanted)) == 0)
            return index;
    return -1;
}

int run_parameter_find(const Run *run, const char *name)
{
    for (size_t i = 0; i < run->parameter_count; ++i)
        if (strcmp(run->parameters[i].name, name) == 0)
            return (int)i;
    return -1;
}

static double number_parse(const RunParameter *parameter, const char *option, const char *text,
                           const char *part, size_t length)
{
    char *end = NULL;
    double value = length && !isspace((unsigned char)*part) ? strtod(part, &end) : 0;
    const char *unit = parameter->unit ? parameter->unit : "";
    bool whole = parameter->kind == RUN_INTEGER;
    if (end != part + length || !isfinite(value) || (whole && value != rint(value)))
        fail_request("%s %s=%s: a %snumber from %g to %g%s%s is needed where '%.*s' stands", option,
                     parameter->name, text, whole ? "whole " : "", parameter->least, parameter->most,
                     *unit ? " " : "", unit, (int)length, part);
    if (value < parameter->least || value > parameter->most)
        fail_request("%s %s=%s: out of range, %g to %g%s%s", option, parameter->name, text, parameter->least,
                     parameter->most, *unit ? " " : "", unit);
    return value;
}

void run_value_parse(const Run *run, RunValue *values, const char *option, const char *key, const char *text)
{
    int index = run_parameter_find(run, key);
    if (index < 0)
        fail_request("%s %s=%s: no such parameter; there are:%s", option, key, text,
                     run_names_join(run->parameters, sizeof *run->parameters));
    const RunParameter *parameter = &run->parameters[index];
    RunValue value = {.given = true};
    if (parameter->kind == RUN_CHOICE) {
        value.choice = run_word_find(parameter->choices, text);
        if (value.choice < 0)
            fail_request("%s %s=%s: not one of: %s", option, key, text, parameter->choices);
    } else {
        const char *part = text;
        int wanted = parameter->kind == RUN_VECTOR ? 3 : 1, commas = 0;
        for (const char *c = text; *c; ++c)
            commas += *c == ',';
        if (commas != wanted - 1)
            fail_request("%s %s=%s: %s", option, key, text,
                         wanted == 3 ? "three numbers are needed, as 1,2,3" : "one number is needed");
        for (int i = 0; i < wanted; ++i, part += strcspn(part, ",") + 1)
            value.number[i] = number_parse(parameter, option, text, part, strcspn(part, ","));
    }
    values[index] = value;
}

static const char *choice_text(const Run *run, size_t parameter, int choice)
{
    const char *word = run->words[parameter];
    while (choice-- > 0)
        word += strlen(word) + 1;
    return word;
}

char *run_value_text(const Run *run, size_t parameter, const RunValue *value)
{
    const RunParameter *of = &run->parameters[parameter];
    const double *number = value->number;
    if (of->kind == RUN_VECTOR)
        return text_format("%.9g,%.9g,%.9g", number[0], number[1], number[2]);
    if (of->kind != RUN_CHOICE)
        return text_format("%.15g", number[0]);
    return text_format("%s", choice_text(run, parameter, value->choice));
}

static size_t find(const Run *run, const char *name)
{
    int index = run_parameter_find(run, name);
    if (index < 0)
        fail_work("parameter '%s' is not among this chapter's", name);
    return (size_t)index;
}

vec3 run_vector(const Run *run, const char *name)
{
    const double *number = run->values[find(run, name)].number;
    return vec3_make((float)number[0], (float)number[1], (float)number[2]);
}

bool run_chosen(const Run *run, const char *name, const char *choice)
{
    size_t index = find(run, name);
    int wanted = run_word_find(run->parameters[index].choices, choice);
    if (wanted < 0)
        fail_work("parameter '%s' has no choice '%s'", name, choice);
    return run->values[index].choice == wanted;
}

// clang-format off
double run_number(const Run *run, const char *name) { return run->values[find(run, name)].number[0]; }
int run_integer(const Run *run, const char *name) { return (int)run_number(run, name); }
const char *run_choice(const Run *run, const char *name) { return choice_text(run, find(run, name), run->values[find(run, name)].choice); }
const Scene *run_scene(const Run *run) { return run->scene; }
int run_width(const Run *run) { return run->width; }
int run_height(const Run *run) { return run->height; }
float run_aspect(const Run *run) { return (float)run->width / (float)run->height; }
int run_frame_number(const Run *run) { return run->frame < 0 ? 0 : run->frame; }
bool run_everything(const Run *run) { return run->everything; }
uint64_t run_seed(const Run *run) { return run->seed; }
bool run_deforming(const Run *run) { return run->path == RUN_DEFORM; }
const char *run_case(const Run *run) { return run->setting && run->setting->row ? run->setting->row->name : NULL; }
bool run_measuring_error(const Run *run) { return run->setting->task == RUN_SWEEP; }
bool run_checking(const Run *run) { return run->setting->task == RUN_STABILITY; }
bool run_picture_needed(const Run *run) { return run->setting->task == RUN_PICTURE || (run_measuring_error(run) && run->path); }
// clang-format on
