// measure: the clock around glFinish is run's; here are the statistics of repeats, CSV files, gnuplot figures, the machine line.
#ifndef MEASURE_H
#define MEASURE_H

#include "image.h"

// Monotonic, milliseconds.
double measure_now_ms(void);

// Of n ≥ 1 values (GSL; the input is not changed).
typedef struct Statistics {
    double median, least, most;
} Statistics;
Statistics measure_statistics(const double *values, size_t count);
// Slope of log(y) over log(x) by least squares (GSL), for orders of convergence and growth. Only pairs of positive finite numbers count;
// NaN for fewer than two different x among them.
double measure_order(const double *x, const double *y, size_t count);
// The same slope with the interval that holds the true one in 95 of 100 fits (Student's t, so that the scatter about the line is what counts).
// Two different x give a slope and no interval: least and most are NaN.
typedef struct OrderFit {
    double slope, least, most;
    size_t used; // pairs that counted
} OrderFit;
OrderFit measure_order_fit(const double *x, const double *y, size_t count);

// One setting of a technique: its error and the milliseconds of its repeats, whose median counts. A point whose error is not finite or below 0, or
// whose median is not above 0, counts for nothing.
typedef struct CurvePoint {
    double error;
    const double *ms;
    size_t repeats;
} CurvePoint;
// Both questions go to the settings that no other of the same technique beats (its front), straight lines between them in log-log.
// BOUND: the technique's cheapest or best measured setting is better than what was asked, or its error is 0: the true speed-up is at least, the
// true error at most `value`.
typedef enum MeasureReach { MEASURE_REACHED, MEASURE_BOUND, MEASURE_NOT_REACHED } MeasureReach;
typedef struct Compared {
    MeasureReach reach;
    double value, least, most; // NaN: not reached; not known
} Compared;
// At an equal error: brute force's time over the other's, with the 2.5 and 97.5 percentiles of 1000 bootstrap resamples (the repeats of every
// point drawn anew with replacement; fixed seed). Not known where a point has one repeat. Drift from one run to the next is not in it.
Compared measure_speed_up(const CurvePoint *brute, size_t brute_count, const CurvePoint *other,
                          size_t other_count, double error);
// In an equal time: the error; least and most are not known.
Compared measure_error_at(const CurvePoint *points, size_t count, double ms);

// What a figure is measured on: CPU, cores, threads, Mesa and LLVM as in GL's renderer string, commit, command. One line each, for CSV comments.
enum { MACHINE_LINES = 6 };
typedef struct Machine {
    char *lines
        [MACHINE_LINES]; // "renderer: …", "cpu: …", "threads: …", "commit: …", "command: …", "date: …"; NULL: not known
} Machine;
// The commit is that of the repository in which the running program lies, with +changes where tracked files differ from it.
Machine measure_machine(const char *gl_renderer, const char *gl_version, int argc, char *const *argv);
void measure_machine_free(Machine *machine);

// A CSV file, whole or not at all: comments first, then the header, then rows; a field with a comma, quote or line break is quoted (RFC 4180).
// Flushed a row at a time into the temporary name, so that a kill loses nothing but the rename.
typedef struct Csv Csv;
Csv *csv_open(const char *path, const Machine *machine, const char *header);
void csv_row(Csv *csv, const char *const *fields, size_t count);
void csv_close(Csv *csv); // renames it to its path

// Largest resident set of this process so far, bytes.
size_t measure_peak_bytes(void);

// Error over run time, log-log, one curve a technique (in the order of its points), the Pareto front in grey, from a sweep's rows (gnuplot; SVG
// or PNG by the path's ending). An error or time of 0 has no place on a log axis: it is drawn, hollow, at a floor that the figure states; what is
// not finite is left out and counted there. Ends the program where gnuplot is missing or fails or no point can be drawn.
typedef struct FigurePoint {
    const char *technique;
    double ms, ms_least, ms_most, error;
} FigurePoint;
void measure_figure(const char *path, const char *title, const char *metric, const FigurePoint *points,
                    size_t count, const Machine *machine);

// Bars of parts, one on the other, each part in its own colour. values: bar_count × part_count, none below 0. A bar's name may have two lines.
typedef struct FigureBars {
    const char *const *bars, *const *parts;
    size_t bar_count, part_count;
    const double *values;
} FigureBars;
void measure_bars(const char *path, const char *title, const char *metric, const FigureBars *bars,
                  const Machine *machine);

#endif
