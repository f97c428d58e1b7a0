// recorded: see recorded.h.
#include "recorded.h"
#include "compare.h"

#include <math.h>
#include <stdlib.h>

char *recorded_path(const char *data, const Entry *entry, const Check *check, const char *mutant)
{
    return text_format("%s/%s/%s%s%s.f32", data, entry->id, check->name, mutant ? "." : "",
                       mutant ? mutant : "");
}

float *recorded_read(const char *data, const Entry *entry, const Check *check, const char *mutant)
{
    char *path = recorded_path(data, entry, check, mutant), *error = NULL;
    float *values = values_read(path, check_values(check), &error);
    if (!values)
        fail_work("%s (make record EX=%s writes it from the solution)", error, entry->id);
    free(path);
    return values;
}

// Whether its table loses exactly the checks that fail.
static bool loses_these(const Misconception *misconception, const Entry *entry, const bool *passes)
{
    for (int i = 0; i < entry->check_count; i++) {
        bool loses = false;
        for (int j = 0; j < misconception->loses_count; j++)
            loses = loses || misconception->loses[j] == &entry->checks[i];
        if (loses == passes[i])
            return false;
    }
    return true;
}

static bool is_output_of(const Misconception *misconception, const char *data, const Entry *entry,
                         const float *got)
{
    const Check *check = misconception->seen_in;
    float *known = recorded_read(data, entry, check, misconception->mutant);
    bool same = true;
    for (size_t i = 0; same && i < check_values(check); i++) // a mistake may well be to give NaN
        same = (isnan(got[i]) && isnan(known[i])) || got[i] == known[i] ||
               fabs((double)got[i] - (double)known[i]) <= tolerance_at(check->tolerance, (double)known[i]);
    free(known);
    return same;
}

const Misconception *recorded_mistake(const char *data, const Entry *entry, float *const *got,
                                      const bool *passes)
{
    for (int i = 0; i < entry->misconception_count; i++) {
        const Misconception *one = &entry->misconceptions[i];
        int check = (int)(one->seen_in - entry->checks);
        if (!passes[check] && got[check] && loses_these(one, entry, passes) &&
            is_output_of(one, data, entry, got[check]))
            return one;
    }
    return NULL;
}
