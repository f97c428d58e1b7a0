// measure: two techniques by their errors and run times: who is faster at an equal error, who is better in an equal time.
#include "measure.h"

#include <math.h>
#include <stdlib.h>

#include <gsl/gsl_rng.h>
#include <gsl/gsl_sort.h>
#include <gsl/gsl_statistics_double.h>

enum { RESAMPLES = 1000 }; // of a bootstrap: 25 of them lie beyond each end of the interval

// A corner of a technique's front: no other of its settings has both a smaller error and a shorter time.
typedef struct Corner {
    double ms, error;
} Corner;

static int by_time_then_error(const void *a, const void *b)
{
    const Corner *p = a, *q = b;
    return p->ms != q->ms ? (p->ms > q->ms) - (p->ms < q->ms) : (p->error > q->error) - (p->error < q->error);
}

// The front, cheapest first: times rise, errors fall. Medians are of the repeats as they are, or (random) as drawn from them with replacement.
static size_t front_of(const CurvePoint *points, size_t count, gsl_rng *random, double *scratch,
                       Corner *front)
{
    size_t corners = 0, kept = 0;
    for (size_t i = 0; i < count; i++) {
        const CurvePoint *p = &points[i];
        for (size_t r = 0; r < p->repeats; r++)
            scratch[r] = p->ms[random ? gsl_rng_uniform_int(random, p->repeats) : r];
        double ms = p->repeats ? gsl_stats_median(scratch, 1, p->repeats) : NAN;
        if (isfinite(ms) && ms > 0.0 && isfinite(p->error) && p->error >= 0.0)
            front[corners++] = (Corner){ms, p->error};
    }
    qsort(front, corners, sizeof *front, by_time_then_error);
    for (size_t i = 0; i < corners; i++)
        if (kept == 0 || front[i].error < front[kept - 1].error)
            front[kept++] = front[i];
    return kept;
}

// y at x on the straight line, in logarithms, through (x0, y0) and (x1, y1), all above 0.
static double log_between(double x0, double y0, double x1, double y1, double x)
{
    return y0 * pow(y1 / y0, log(x / x0) / log(x1 / x0));
}

static MeasureReach time_at(const Corner *front, size_t count, double error, double *ms)
{
    size_t i = 0;
    while (i < count && front[i].error > error)
        i++;
    *ms = i < count ? front[i].ms : NAN;
    if (i == count)
        return MEASURE_NOT_REACHED;
    if (front[i].error == error)
        return MEASURE_REACHED;
    if (i == 0 ||
        front[i].error <= 0.0) // a cheaper setting might do, but none was run; an error of 0 has no logarithm
        return MEASURE_BOUND;
    *ms = log_between(front[i - 1].error, front[i - 1].ms, front[i].error, front[i].ms, error);
    return MEASURE_REACHED;
}

static size_t most_repeats(const CurvePoint *points, size_t count, size_t most, bool *again)
{
    for (size_t i = 0; i < count; i++) {
        most = points[i].repeats > most ? points[i].repeats : most;
        *again &= points[i].repeats > 1;
    }
    return most;
}

Compared measure_speed_up(const CurvePoint *brute, size_t brute_count, const CurvePoint *other,
                          size_t other_count, double error)
{
    Compared compared = {MEASURE_NOT_REACHED, NAN, NAN, NAN};
    bool again = true;
    size_t repeats = most_repeats(other, other_count, most_repeats(brute, brute_count, 1, &again), &again);
    double *scratch = memory_new(repeats, sizeof *scratch, "speed-up");
    Corner *front = memory_new(brute_count + other_count + 1, sizeof *front, "speed-up");
    double *ratios = memory_new(RESAMPLES, sizeof *ratios, "speed-up"), slow, fast;
    gsl_rng *random =
        gsl_rng_alloc(gsl_rng_mt19937); // its default seed: the same rows give the same interval
    // Turn 0 takes the medians as they are, the others resample.
    for (int turn = 0; turn <= (again ? RESAMPLES : 0); turn++) {
        gsl_rng *draw = turn ? random : NULL;
        size_t corners = front_of(brute, brute_count, draw, scratch, front);
        MeasureReach reach_brute = time_at(front, corners, error, &slow);
        corners = front_of(other, other_count, draw, scratch, front);
        MeasureReach reach_other = time_at(front, corners, error, &fast);
        if (reach_brute == MEASURE_NOT_REACHED || reach_other == MEASURE_NOT_REACHED)
            break; // errors do not depend on the draw: no turn reaches it
        if (turn)
            ratios[turn - 1] = slow / fast;
        else
            compared = (Compared){reach_other, slow / fast, NAN, NAN};
    }
    if (compared.reach != MEASURE_NOT_REACHED && again) {
        gsl_sort(ratios, 1, RESAMPLES);
        compared.least = gsl_stats_quantile_from_sorted_data(ratios, 1, RESAMPLES, 0.025);
        compared.most = gsl_stats_quantile_from_sorted_data(ratios, 1, RESAMPLES, 0.975);
    }
    gsl_rng_free(random);
    free(ratios);
    free(front);
    free(scratch);
    return compared;
}

Compared measure_error_at(const CurvePoint *points, size_t count, double ms)
{
    bool again = true;
    size_t repeats = most_repeats(points, count, 1, &again), corners, i = 0;
    double *scratch = memory_new(repeats, sizeof *scratch, "equal time");
    Corner *front = memory_new(count + 1, sizeof *front, "equal time");
    Compared compared = {MEASURE_NOT_REACHED, NAN, NAN, NAN};
    corners = front_of(points, count, NULL, scratch, front);
    while (i < corners && front[i].ms <= ms)
        i++;
    if (i > 0) {
        const Corner *before = &front[i - 1], *after = &front[i < corners ? i : i - 1];
        bool exact = before->ms == ms, between = after != before && after->error > 0.0;
        compared.reach = exact || between ? MEASURE_REACHED : MEASURE_BOUND;
        compared.value = exact || !between
                             ? before->error
                             : log_between(before->ms, before->error, after->ms, after->error, ms);
    }
    free(front);
    free(scratch);
    return compared;
}
