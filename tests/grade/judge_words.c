// judge_words: see judge_words.h.
#include "judge_words.h"

#include "report.h"

#include <stdlib.h>

char *judge_words(const Check *check, const Comparison *comparison, const float *got, const float *wanted)
{
    const char *unit = check->shape.unit ? check->shape.unit : "", *space = *unit ? " " : "";
    if (!comparison->wrong)
        return text_format("Right: %s.", check->asks);
    if (!check->input) // an answer that is told need not be measured
        return text_format(
            "Asked for: %s. %g is farther from what we measured than %.3g, which is allowed since %s.",
            check->asks, (double)got[0], tolerance_at(check->tolerance, (double)wanted[0]), check->because);
    size_t i = comparison->first;
    char *where = report_where(&check->shape, i);
    const char *are = comparison->count > 1 ? "numbers are" : "number is";
    char *text;
    if (comparison->nonfinite)
        text = text_format("Asked for: %s. %zu of %zu numbers are not finite (NaN or infinite). The first "
                           "wrong one is %s: got %g, wanted "
                           "%g%s%s.",
                           check->asks, comparison->nonfinite, comparison->count, where, (double)got[i],
                           (double)wanted[i], space, unit);
    else
        text = text_format("Asked for: %s. %zu of %zu %s wrong. The first is %s: got %g, wanted %g%s%s. "
                           "Allowed: %.3g (%s); the worst is %.3g "
                           "times that.",
                           check->asks, comparison->wrong, comparison->count, are, where, (double)got[i],
                           (double)wanted[i], space, unit, tolerance_at(check->tolerance, (double)wanted[i]),
                           check->because, comparison->ratio);
    free(where);
    return text;
}
