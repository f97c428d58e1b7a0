// measure: clock, statistics (GSL), the machine line, CSV files. Figures are in measure_figure.c.
#include "measure.h"

#include <errno.h>
#include <math.h>
#include <sched.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <time.h>

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_fit.h>
#include <gsl/gsl_statistics_double.h>

double measure_now_ms(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec * 1e3 + (double)now.tv_nsec * 1e-6;
}

Statistics measure_statistics(const double *values, size_t count)
{
    double *copy = memory_new(count, sizeof *copy, "statistics"); // the median reorders what it is given
    memcpy(copy, values, count * sizeof *copy);
    double least, most;
    gsl_stats_minmax(&least, &most, copy, 1, count);
    Statistics statistics = {.median = gsl_stats_median(copy, 1, count), .least = least, .most = most};
    free(copy);
    return statistics;
}

OrderFit measure_order_fit(const double *x, const double *y, size_t count)
{
    double *logs = memory_new(2 * count + 1, sizeof *logs, "order"), *log_y = logs + count;
    OrderFit fit = {NAN, NAN, NAN, 0};
    bool different = false;
    for (size_t i = 0; i < count; i++)
        if (x[i] > 0.0 && y[i] > 0.0 && isfinite(x[i]) && isfinite(y[i])) {
            logs[fit.used] = log(x[i]);
            log_y[fit.used] = log(y[i]);
            different |= logs[fit.used] != logs[0];
            fit.used++;
        }
    double constant, covariance[3], residual;
    if (different)
        gsl_fit_linear(logs, 1, log_y, 1, fit.used, &constant, &fit.slope, &covariance[0], &covariance[1],
                       &covariance[2], &residual);
    if (different && fit.used > 2) {
        double half = gsl_cdf_tdist_Pinv(0.975, (double)fit.used - 2.0) * sqrt(covariance[2]);
        fit.least = fit.slope - half;
        fit.most = fit.slope + half;
    }
    free(logs);
    return fit;
}

double measure_order(const double *x, const double *y, size_t count)
{
    return measure_order_fit(x, y, count).slope;
}

size_t measure_peak_bytes(void)
{
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    return (size_t)usage.ru_maxrss * 1024;
}

static char *git_commit(void)
{
    // popen's shell finds this program through its parent's number, so that no path needs quoting
    FILE *git = popen("git -C \"$(dirname \"$(readlink /proc/$PPID/exe)\")\" "
                      "describe --always --exclude='*' --dirty=+changes 2>/dev/null",
                      "r");
    char said[128] = "";
    bool known = git && fgets(said, sizeof said, git);
    known = git && pclose(git) == 0 && known;
    said[strcspn(said, "\n")] = '\0';
    return text_format("commit: %s", known ? said : "unknown");
}

// One line; an argument with a character that a shell would read as its own is quoted.
static char *command_line(int argc, char *const *argv)
{
    char *line = text_format("command:");
    for (int i = 0; i < argc; i++) {
        bool plain = argv[i][0] && !argv[i][strcspn(argv[i], " \t\n'\"\\$`*?[]{}()<>|&;#!~")];
        char *longer = text_format(plain ? "%s %s" : "%s '%s'", line, argv[i]);
        free(line);
        line = longer;
    }
    for (char *c = line; *c; c++)
        *c = *c == '\n' ? ' ' : *c; // a comment of a CSV file ends with its line
    return line;
}

Machine measure_machine(const char *gl_renderer, const char *gl_version, int argc, char *const *argv)
{
    cpu_set_t usable;
    int cores = sched_getaffinity(0, sizeof usable, &usable) ? 0 : CPU_COUNT(&usable);
    const char *threads = getenv("LP_NUM_THREADS");
    char *cpu_info = file_read("/proc/cpuinfo", NULL);
    const char *cpu = cpu_info ? strstr(cpu_info, "model name") : NULL;
    cpu = cpu ? cpu + strcspn(cpu, ":") : ": unknown\n";
    char date[32];
    time_t now = time(NULL);
    struct tm utc;
    strftime(date, sizeof date, "%Y-%m-%d %H:%M UTC", gmtime_r(&now, &utc));
    Machine machine = {{
        text_format("renderer: %s, GL %s", gl_renderer, gl_version),
        text_format("cpu%.*s", (int)strcspn(cpu, "\n"), cpu),
        text_format("threads: %d cores usable, LP_NUM_THREADS %s", cores, threads ? threads : "not set"),
        git_commit(),
        command_line(argc, argv),
        text_format("date: %s", date),
    }};
    free(cpu_info);
    return machine;
}

void measure_machine_free(Machine *machine)
{
    for (int i = 0; i < MACHINE_LINES; i++)
        free(machine->lines[i]);
    *machine = (Machine){0};
}

struct Csv {
    FILE *file;
    const char *temporary;
    char *path;
};

static void csv_flush(const Csv *csv)
{
    if (fflush(csv->file) || ferror(csv->file))
        fail_work("%s: cannot be written: %s", csv->path, strerror(errno));
}

Csv *csv_open(const char *path, const Machine *machine, const char *header)
{
    Csv *csv = memory_new(1, sizeof *csv, "csv");
    csv->path = text_format("%s", path);
    csv->temporary = file_begin(path);
    csv->file = fopen(csv->temporary, "w");
    if (!csv->file)
        fail_work("%s: cannot be written: %s", path, strerror(errno));
    for (int i = 0; i < MACHINE_LINES; i++)
        if (machine->lines[i])
            fprintf(csv->file, "# %s\n", machine->lines[i]);
    fprintf(csv->file, "%s\n", header);
    csv_flush(csv);
    return csv;
}

void csv_row(Csv *csv, const char *const *fields, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        bool quoted = fields[i][strcspn(fields[i], ",\"\r\n")];
        fputs(i ? "," : "", csv->file);
        fputs(quoted ? "\"" : "", csv->file);
        for (const char *c = fields[i]; *c; c++) {
            if (*c == '"')
                fputc('"', csv->file);
            fputc(*c, csv->file);
        }
        fputs(quoted ? "\"" : "", csv->file);
    }
    fputc('\n', csv->file);
    csv_flush(csv);
}

void csv_close(Csv *csv)
{
    if (fclose(csv->file))
        fail_work("%s: cannot be written: %s", csv->path, strerror(errno));
    file_commit(csv->temporary);
    free(csv->path);
    free(csv);
}
