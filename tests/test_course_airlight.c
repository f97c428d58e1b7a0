// Chapter 04's exercises against their own words: what is recorded as right is what the exercise defines, integrated in double without any closed form;
// and what is recorded of each known mistake is not.
#include <criterion/criterion.h>

#include "support_course.h"

#include <math.h>
#include <stdlib.h>

TestSuite(course_airlight, .timeout = 60);

typedef double (*Integrand)(double at, const double *given);

// Simpson's rule over panels that double, beginning at `from` (which may lie after `to`) with `width`: for what varies most at its beginning.
static double integral(Integrand f, const double *given, double from, double to, double width)
{
    enum { INTERVALS = 64 };
    double sum = 0, sign = from < to ? 1 : -1, a = from;
    while (a != to) {
        double b = fabs(to - a) <= width ? to : a + sign * width, step = (b - a) / INTERVALS, panel = 0;
        for (int i = 0; i <= INTERVALS; i++)
            panel += (i == 0 || i == INTERVALS ? 1 : i % 2 ? 4 : 2) * f(a + i * step, given);
        sum += sign * panel * step / 3;
        a = b;
        width *= 2;
    }
    return sum;
}

// --- what one item should be
// 04.1: the angle goes evenly. h, foot, radius, from, to, x
static double place(const float *in, double x)
{
    double d = fmax((double)in[0], (double)in[2]), foot = (double)in[1];
    double first = atan2((double)in[3] - foot, d), last = atan2((double)in[4] - foot, d);
    return foot + d * tan(first + x * (last - first));
}

static void equal_angles(const float *in, const float *got, double *wanted)
{
    (void)got;
    const double x = (double)in[5], step = 1e-4;
    wanted[0] = place(in, x);
    wanted[1] = (place(in, x + step) - place(in, x - step)) / (2 * step);
}

// 04.2: sigma, a, b, w0, w1
static double faded(double t, const double *given)
{
    double share = (t - given[1]) / (given[2] - given[1]);
    return (given[3] + share * (given[4] - given[3])) * exp(-given[0] * t);
}

static void fading(const float *in, const float *got, double *wanted)
{
    (void)got;
    double given[5];
    for (int i = 0; i < 5; i++)
        given[i] = (double)in[i];
    wanted[0] = integral(faded, given, given[1], given[2], 1 / fmax(given[0], 1e-3));
}

// 04.3: g, ξ. A square gives the angle, from ahead or from behind; over so much of the sphere the share must be ξ, or the rest. What the share is off tells by
// Newton's step what the square is off. We ask from the side where square and share are small: from the other both hide in what is nearly 1.
static double scattered(double angle, const double *given)
{
    double g = given[0]; // the textbook's form, of the angle from ahead (sign 1) or from behind
    return 0.5 * (1 - g * g) * sin(angle) / pow(1 + g * g - 2 * g * cos(angle), 1.5);
}

static void turned(const float *in, const float *got, double *wanted)
{
    double g = (double)in[0], xi = (double)in[1];
    const double shares[2] = {xi, 1 - xi};
    int least = (double)got[0] * shares[0] < (double)got[1] * shares[1] ? 0 : 1;
    double from_end = least == 0 ? g : -g, square = (double)got[least];
    double angle = 2 * asin(sqrt(fmin(fmax(square, 0), 1)));
    double share = integral(scattered, &from_end, 0, angle, 1 - fabs(g));
    double slope = scattered(angle, &from_end) / (0.5 * sin(angle)); // dξ/dθ by d sin²(θ/2)/dθ
    wanted[least] = square + (shares[least] - share) / slope;
    wanted[1 - least] = 1 - wanted[least];
}

// 04.4: h, foot, end, six shadows
static double towards_lamp(double t, const double *given)
{
    return 1 / (given[0] * given[0] + (t - given[1]) * (t - given[1]));
}

// Of what is lit from a to b, between two borders: away from the foot.
static double between(const double *given, double a, double b)
{
    bool before = a + b < 2 * given[1];
    double nearer = before ? b : a, width = hypot(given[0], nearer - given[1]);
    return before ? integral(towards_lamp, given, b, a, width) : integral(towards_lamp, given, a, b, width);
}

static int ascending(const void *a, const void *b)
{
    double difference = *(const double *)a - *(const double *)b;
    return (difference > 0) - (difference < 0);
}

static void lit(const float *in, const float *got, double *wanted)
{
    enum { SHADOWS = 6, BORDERS = 2 * SHADOWS + 3 };
    (void)got;
    const double given[2] = {(double)in[0], (double)in[1]}, end = (double)in[2];
    double borders[BORDERS] = {0, end, fmin(fmax(given[1], 0), end)};
    for (int i = 0; i < 2 * SHADOWS; i++)
        borders[3 + i] = fmin(fmax((double)in[3 + i], 0), end);
    qsort(borders, BORDERS, sizeof *borders, ascending);
    wanted[0] = 0;
    for (int i = 0; i + 1 < BORDERS; i++) {
        double middle = 0.5 * (borders[i] + borders[i + 1]);
        bool dark = borders[i] == borders[i + 1];
        for (int k = 0; k < SHADOWS; k++)
            dark = dark || ((double)in[3 + 2 * k] < middle && middle < (double)in[4 + 2 * k]);
        wanted[0] += dark ? 0 : between(given, borders[i], borders[i + 1]);
    }
}

Test(course_airlight, equal_angles_are_equal)
{
    course_judge("04.1", equal_angles);
}

Test(course_airlight, a_fading_stretch_is_its_integral)
{
    course_judge("04.2", fading);
}

Test(course_airlight, an_angle_holds_its_share_of_the_light)
{
    course_judge("04.3", turned);
}

Test(course_airlight, lit_stretches_are_what_no_shadow_covers)
{
    course_judge("04.4", lit);
}
