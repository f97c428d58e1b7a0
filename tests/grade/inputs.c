// inputs: see inputs.h.
#include "inputs.h"

#include <stdlib.h>
#include <string.h>

static const Generator *find(const char *name)
{
    static const Generator *const chapters[] = {inputs_01, inputs_01_winding, inputs_02,
                                                inputs_04, inputs_06,         inputs_06_ball};
    for (size_t i = 0; i < sizeof chapters / sizeof chapters[0]; i++)
        for (const Generator *generator = chapters[i]; generator->name; generator++)
            if (!strcmp(generator->name, name))
                return generator;
    return NULL;
}

bool input_known(const char *generator)
{
    return find(generator);
}

Input input_make(const Entry *entry, const Check *check, uint64_t seed)
{
    Input input = {0};
    if (!check->input)
        return input;
    uint64_t random = hash_bytes(HASH_START, entry->id, strlen(entry->id));
    random = hash_bytes(random, check->name, strlen(check->name));
    random = hash_bytes(random, &seed, sizeof seed);
    find(check->input)->make(&input, &check->shape, &random);
    return input;
}

void input_free(Input *input)
{
    free(input->values);
    *input = (Input){0};
}

void input_write(const Input *input, const char *path)
{
    const char *temporary = file_begin(path);
    FILE *file = fopen(temporary, "wb");
    bool written = file && fwrite(input->values, sizeof(float), input->count, file) == input->count;
    if (!file || fclose(file) || !written)
        fail_work("%s: cannot be written", path);
    file_commit(temporary);
}

void input_add(Input *input, double value)
{
    if (input->count == input->capacity) {
        input->capacity = 2 * input->capacity + 256;
        input->values = memory_grow(input->values, input->capacity, sizeof(float), "input");
    }
    float held = (float)value;
    if ((double)held != value)
        fail_work("input %zu: %.17g is no float32: it would be another number elsewhere", input->count,
                  value);
    input->values[input->count++] = held;
}

// Steele, Lea and Flood (2014), SplitMix64: integers alone, so the same everywhere.
uint64_t input_next(uint64_t *random)
{
    uint64_t z = *random += UINT64_C(0x9e3779b97f4a7c15);
    z = (z ^ z >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ z >> 27) * UINT64_C(0x94d049bb133111eb);
    return z ^ z >> 31;
}

int input_between(uint64_t *random, int low, int high)
{
    return low + (int)(input_next(random) % (uint64_t)(high - low + 1));
}
