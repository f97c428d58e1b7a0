// compare: see compare.h.
#include "compare.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

double tolerance_at(Tolerance tolerance, double wanted)
{
    return tolerance.absolute + tolerance.relative * fabs(wanted);
}

Comparison compare_values(const float *got, const float *wanted, size_t count, Tolerance tolerance)
{
    Comparison comparison = {.count = count, .first = count, .worst = count};
    for (size_t i = 0; i < count; i++) {
        double room = tolerance_at(tolerance, (double)wanted[i]);
        double error = fabs((double)got[i] - (double)wanted[i]);
        bool finite = isfinite(got[i]) && isfinite(wanted[i]);
        // no room at a wanted 0: any error is beyond it
        double ratio = !finite ? INFINITY : error == 0 ? 0 : room > 0 ? error / room : INFINITY;
        comparison.nonfinite += !finite;
        if (ratio > comparison.ratio) {
            comparison.ratio = ratio;
            comparison.worst = i;
        }
        if (ratio > 1) {
            comparison.wrong++;
            if (comparison.first == count)
                comparison.first = i;
        }
    }
    if (!comparison.wrong)
        comparison.worst = count;
    return comparison;
}

float *values_read(const char *path, size_t count, char **error)
{
    *error = NULL;
    size_t bytes = 0;
    char *data = file_read(path, &bytes);
    if (!data) {
        *error = text_format("%s: %s", path, strerror(errno));
        return NULL;
    }
    if (bytes != count * sizeof(float)) {
        *error = text_format("%s: %zu bytes; %zu numbers of float32 are %zu", path, bytes, count,
                             count * sizeof(float));
        free(data);
        return NULL;
    }
    float *values = memory_new(count, sizeof *values, path);
    memcpy(values, data, bytes);
    free(data);
    return values;
}
