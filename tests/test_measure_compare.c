// measure: comparisons of techniques against closed forms: exact power laws, stated distributions, and every way of not reaching.
#include "measure.h"

#include <criterion/criterion.h>
#include <math.h>

enum { POINTS = 5, REPEATS = 7 };

// A technique whose error is `scale` · ms^−order, its repeats spread by `spread` about the median.
typedef struct Law {
    CurvePoint points[POINTS];
    double ms[POINTS][REPEATS];
} Law;

static void law_make(Law *law, double first_ms, double scale, double order, double spread)
{
    for (int i = 0; i < POINTS; i++) {
        double ms = ldexp(first_ms, i);
        for (int r = 0; r < REPEATS; r++)
            law->ms[i][r] =
                ms * (1 + spread * ((r * 3 % REPEATS) - 3)); // −3 … 3 in some order: the median is ms
        law->points[i] = (CurvePoint){scale * pow(ms, -order), law->ms[i], REPEATS};
    }
}

// Logs of numbers near 1, in double.
static const double ROUNDING = 1e-12;

Test(measure_compare, speed_up_of_two_power_laws_is_their_ratio)
{
    Law brute, other;
    law_make(&brute, 1, 1, 1, 0);      // error 1/t: 1 … 1/16
    law_make(&other, 0.1, 0.01, 1, 0); // error 0.01/t: 0.1 … 0.00625
    // error e takes 1/e and 0.01/e: 100 times, at corners and between them
    const double errors[] = {0.0625, 0.07, 0.09};
    for (int i = 0; i < 3; i++) {
        Compared got = measure_speed_up(brute.points, POINTS, other.points, POINTS, errors[i]);
        cr_assert(got.reach == MEASURE_REACHED, "error %g is inside both", errors[i]);
        cr_assert_float_eq(got.value, 100, 100 * ROUNDING, "error %g: %.17g", errors[i], got.value);
        cr_assert_float_eq(got.least, 100, 100 * ROUNDING, "repeats that agree leave no doubt");
        cr_assert_float_eq(got.most, 100, 100 * ROUNDING, "repeats that agree leave no doubt");
    }
    law_make(&other, 0.125, 0.01, 2, 0); // error 0.01/t²: takes 0.1/√e
    double e = 0.1, expected = (1 / e) / (0.1 / sqrt(e));
    Compared got = measure_speed_up(brute.points, POINTS, other.points, POINTS, e);
    cr_assert_float_eq(got.value, expected, expected * ROUNDING, "orders 1 and 2: %g", got.value);
    got = measure_speed_up(brute.points, POINTS, brute.points, POINTS, e);
    cr_assert_float_eq(got.value, 1, ROUNDING, "nobody is faster than itself: %g", got.value);
}

Test(measure_compare, what_is_not_reached_or_only_bounded_is_said)
{
    Law brute, other;
    law_make(&brute, 1, 1, 1, 0);
    law_make(&other, 1, 2, 0, 0); // never better than 2
    Compared got = measure_speed_up(brute.points, POINTS, other.points, POINTS, 0.5);
    cr_assert(got.reach == MEASURE_NOT_REACHED && isnan(got.value) && isnan(got.least),
              "the other is never so good");
    got = measure_speed_up(other.points, POINTS, brute.points, POINTS, 0.5);
    cr_assert(got.reach == MEASURE_NOT_REACHED, "brute force is never so good");
    law_make(&other, 0.5, 0.001, 1, 0); // its worst error is 0.002
    got = measure_speed_up(brute.points, POINTS, other.points, POINTS, 0.1);
    cr_assert(got.reach == MEASURE_BOUND, "its cheapest setting is better than asked");
    cr_assert_float_eq(got.value, 10 / 0.5, 20 * ROUNDING, "at least 10 ms over 0.5 ms: %g", got.value);
    double one[] = {2};
    CurvePoint perfect = {0, one, 1};
    got = measure_speed_up(brute.points, POINTS, &perfect, 1, 0.25);
    cr_assert(got.reach == MEASURE_BOUND && got.value == 4 / 2.0, "an error of 0 has no logarithm: %g",
              got.value);
    cr_assert(isnan(got.least) && isnan(got.most), "one repeat tells nothing of its spread");
    got = measure_speed_up(brute.points, POINTS, NULL, 0, 0.25);
    cr_assert(got.reach == MEASURE_NOT_REACHED, "a technique without points");
    CurvePoint broken[] = {{NAN, one, 1}, {0.1, (double[]){0}, 1}, {-1, one, 1}, {0.1, NULL, 0}};
    got = measure_speed_up(brute.points, POINTS, broken, 4, 0.5);
    cr_assert(got.reach == MEASURE_NOT_REACHED, "points that count for nothing");
}

Test(measure_compare, points_that_others_beat_do_not_count)
{
    Law brute, other;
    law_make(&brute, 1, 1, 1, 0);
    law_make(&other, 1, 1, 1, 0);
    Compared before = measure_speed_up(brute.points, POINTS, other.points, POINTS, 0.2);
    other.points[1].error = 3; // slower and worse than its first point
    Compared after = measure_speed_up(brute.points, POINTS, other.points, POINTS, 0.2);
    // without the corner the line runs from the first point to the third, which the same law holds
    cr_assert_float_eq(after.value, before.value, ROUNDING, "%g, %g", before.value, after.value);
}

// Repeats drawn from a known law around known medians: the interval must hold the true ratio about 95 times in 100.
Test(measure_compare, bootstrap_interval_covers_the_truth)
{
    uint64_t state = 7;
    int held = 0;
    const int trials = 200;
    double width = 0;
    for (int t = 0; t < trials; t++) {
        double ms[2][REPEATS];
        for (int r = 0; r < 2 * REPEATS; r++) {
            state = state * 6364136223846793005u + 1442695040888963407u; // Knuth's MMIX
            double uniform = (double)(state >> 11) / 9007199254740992.0;
            ms[r % 2][r / 2] = (r % 2 ? 2.0 : 6.0) * (0.9 + 0.2 * uniform); // medians 6 and 2
        }
        CurvePoint slow = {0.5, ms[0], REPEATS}, fast = {0.5, ms[1], REPEATS};
        Compared got = measure_speed_up(&slow, 1, &fast, 1, 0.5);
        cr_assert(got.least <= got.value && got.value <= got.most, "%g in %g … %g", got.value, got.least,
                  got.most);
        held += got.least <= 3 && 3 <= got.most;
        width += (got.most - got.least) / trials;
    }
    // A percentile bootstrap of two medians of 7: 95 % by name, 200 trials scatter by 1.5 %; a median of so few is a little conservative.
    cr_assert(held >= 0.90 * trials, "the interval held the truth in %d of %d", held, trials);
    // ±10 % uniform: medians of 7 scatter by 3.3 % each, so intervals are about 4 · 4.7 % · 3 = 0.57 wide; one that is always wide proves nothing.
    cr_assert(width > 0.2 && width < 0.9, "mean width %g", width);
}

Test(measure_compare, error_in_an_equal_time_follows_the_law)
{
    Law law;
    law_make(&law, 1, 1, 1.5, 0);
    Compared got = measure_error_at(law.points, POINTS, 3);
    cr_assert(got.reach == MEASURE_REACHED, "inside");
    cr_assert_float_eq(got.value, pow(3, -1.5), ROUNDING, "between two corners: %g", got.value);
    got = measure_error_at(law.points, POINTS, 4);
    cr_assert_float_eq(got.value, 0.125, ROUNDING, "at a corner: %g", got.value);
    cr_assert_eq(measure_error_at(law.points, POINTS, 0.99).reach, MEASURE_NOT_REACHED,
                 "its cheapest takes longer");
    got = measure_error_at(law.points, POINTS, 1000);
    cr_assert(got.reach == MEASURE_BOUND, "more time than it was ever given");
    cr_assert_float_eq(got.value, 1.0 / 64, ROUNDING, "at most its best: %g", got.value);
    cr_assert_eq(measure_error_at(law.points, 1, 1).value, 1, "one point");
    cr_assert_eq(measure_error_at(NULL, 0, 1).reach, MEASURE_NOT_REACHED, "no point");
}

Test(measure_compare, order_of_an_exact_power_has_no_width_and_noise_has)
{
    double n[6], exact[6], noisy[6];
    for (int i = 0; i < 6; i++) {
        n[i] = ldexp(1, i);
        exact[i] = 5 / (n[i] * n[i]);
        noisy[i] = exact[i] * (i % 2 ? 1.25 : 0.8); // +-0.3219 in log2
    }
    OrderFit fit = measure_order_fit(n, exact, 6);
    cr_assert_float_eq(fit.slope, -2, ROUNDING, "slope %g", fit.slope);
    cr_assert(fit.used == 6 && fit.most - fit.least < 1e-6, "no scatter, no width: %g … %g", fit.least,
              fit.most);
    fit = measure_order_fit(n, noisy, 6);
    // By hand, in log2: x = 0…5 about 2.5, noise d = (−,+,−,+,−,+)·0.321928; Sxx = 17.5, Σx·d = 3·0.321928 → slope −2 + 0.055188;
    // residuals: Σd² − (Σx·d)²/Sxx = 6·0.103638 − 0.932740/17.5 = 0.568526; s² = /4 = 0.142132; half = 2.776445·√(s²/17.5) = 0.250216
    cr_assert_float_eq(fit.slope, -2 + 0.055188, 1e-5, "slope %.9g", fit.slope);
    cr_assert_float_eq(fit.most - fit.slope, 0.250216, 1e-5, "Student's t of 4 degrees of freedom: %.9g",
                       fit.most - fit.slope);
    cr_assert_float_eq(fit.slope - fit.least, 0.250216, 1e-5, "alike below");
    fit = measure_order_fit(n, exact, 2);
    cr_assert(fit.used == 2 && isnan(fit.least) && isnan(fit.most),
              "two points have a slope and no interval");
    cr_assert_float_eq(fit.slope, -2, ROUNDING, "slope %g", fit.slope);
    fit = measure_order_fit(n, exact, 1);
    cr_assert(fit.used == 1 && isnan(fit.slope), "one point has none");
    cr_assert_eq(measure_order_fit(n, (double[]){0, 0}, 2).used, 0, "errors of 0 have no logarithm");
}
