// measure: work-precision diagrams, drawn by gnuplot as its own process from a script that holds the data.
#include "measure.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

// A gnuplot string: '' stands for ' and nothing else is special.
static void put_quoted(FILE *out, const char *text)
{
    fputc('\'', out);
    for (; *text; text++)
        fprintf(out, *text == '\'' ? "''" : "%c", iscntrl((unsigned char)*text) ? ' ' : *text);
    fputc('\'', out);
}

static void put_note(FILE *out, int line, char *text)
{
    fprintf(out, "set label at character 1.5, character %g ", 3.9 - 0.8 * line);
    put_quoted(out, text + (*text == ';' ? 2 : 0));
    fputs(" font ',8' textcolor rgb '#777777' noenhanced\n", out);
    free(text);
}

static int by_time_then_error(const void *a, const void *b)
{
    const FigurePoint *p = a, *q = b;
    return p->ms != q->ms ? (p->ms > q->ms) - (p->ms < q->ms) : (p->error > q->error) - (p->error < q->error);
}

// Most of a decade below the least positive value's own, so that what stands there is seen to stand apart.
static double axis_floor(double least_positive)
{
    return isfinite(least_positive) ? 0.3 * pow(10.0, floor(log10(least_positive))) : 1e-6;
}

// `points`: a block a curve (ms error least most hollow); `front`: the points that no other beats in both time and error;
// name[]: the curves' names.
static void put_data(FILE *out, FigurePoint *points, size_t count)
{
    const char **names = memory_new(count, sizeof *names, "figure");
    size_t curves = 0, hollow = 0, k;
    double least_ms = INFINITY, least_error = INFINITY, best = INFINITY;
    for (size_t i = 0; i < count; i++) {
        for (k = 0; k < curves && strcmp(names[k], points[i].technique) != 0; k++)
            ;
        names[k] = points[i].technique;
        curves += k == curves;
        least_ms = points[i].ms > 0.0 ? fmin(least_ms, points[i].ms) : least_ms;
        least_error = points[i].error > 0.0 ? fmin(least_error, points[i].error) : least_error;
    }
    double ms_floor = axis_floor(least_ms), error_floor = axis_floor(least_error);
    fprintf(out, "array name[%zu]\n$points << END_OF_POINTS\n", curves);
    for (k = 0; k < curves; k++, fputs("\n\n", out))
        for (size_t i = 0; i < count; i++)
            if (strcmp(names[k], points[i].technique) == 0) {
                FigurePoint *p = &points[i];
                bool low = !(p->ms > 0.0 && p->error > 0.0);
                hollow += low;
                p->ms = p->ms > 0.0 ? p->ms : ms_floor;
                p->error = p->error > 0.0 ? p->error : error_floor;
                fprintf(out, "%.9g %.9g %.9g %.9g %d\n", p->ms, p->error, fmax(p->ms_least, ms_floor),
                        fmax(p->ms_most, ms_floor), low);
            }
    fputs("END_OF_POINTS\n$front << END_OF_FRONT\n", out);
    qsort(points, count, sizeof *points, by_time_then_error);
    for (size_t i = 0; i < count; i++)
        if (points[i].error < best)
            fprintf(out, "%.9g %.9g\n", points[i].ms, best = points[i].error);
    fputs("END_OF_FRONT\n", out);
    for (k = 0; k < curves; k++) {
        fprintf(out, "name[%zu] = ", k + 1);
        put_quoted(out, names[k]);
        fputc('\n', out);
    }
    if (hollow)
        put_note(out, 3,
                 text_format("hollow: not above 0, drawn at the floor of its axis (error %g, time %g ms)",
                             error_floor, ms_floor));
    free(names);
}

static void run_gnuplot(FILE *script, const char *path)
{
    char said[4096], *command = text_format("gnuplot /dev/fd/%d 2>&1", fileno(script));
    FILE *gnuplot = !fflush(script) ? popen(command, "r") : NULL;
    said[gnuplot ? fread(said, 1, sizeof said - 1, gnuplot) : 0] = '\0';
    if (!gnuplot || pclose(gnuplot))
        fail_work("%s: cannot be drawn: gnuplot: %s", path, said);
    free(command);
}

// A script begun: terminal, title and output; what it draws goes to *temporary first.
static FILE *figure_begin(const char *path, const char *title, const char *metric, const char **temporary)
{
    const char *ending = strrchr(path, '.');
    bool svg = ending && strcmp(ending, ".svg") == 0;
    if (!svg && !(ending && strcmp(ending, ".png") == 0))
        fail_request("%s: a figure's name must end in .svg or .png", path);
    FILE *script = tmpfile();
    if (!script)
        fail_work("%s: cannot be drawn: %s", path, strerror(errno));
    *temporary = file_begin(path);
    fprintf(
        script,
        "set encoding utf8\nset terminal %s size 820,600 font 'sans,12' background rgb 'white'\nset output ",
        svg ? "svg" : "pngcairo");
    put_quoted(script, *temporary);
    fputs("\nset title ", script);
    put_quoted(script, title);
    fputs(" noenhanced\nset ylabel ", script);
    put_quoted(script, metric);
    fputs(" noenhanced\nset bmargin 9\nset key outside right top Left reverse samplen 2 noenhanced\n"
          // Okabe and Ito's colours, told apart by the colour-blind; shapes tell them apart in grey
          "colours = '#0072B2 #D55E00 #009E73 #CC79A7 #E69F00 #56B4E9 #000000'\n"
          "colour(k) = word(colours, k % 7 + 1)\nshape(k) = 5 + 2 * (k % 5)\n",
          script);
    return script;
}

static void put_machine(FILE *script, const Machine *machine)
{
    const char *const *line = (const char *const *)machine->lines;
#define LINE(i) (line[i] ? "; " : ""), (line[i] ? line[i] : "")
    put_note(script, 0, text_format("%s%s%s%s", LINE(0), LINE(1)));
    put_note(script, 1, text_format("%s%s%s%s%s%s", LINE(2), LINE(3), LINE(5)));
    put_note(script, 2, text_format("%s%s", LINE(4)));
}

static void figure_end(FILE *script, const char *path, const char *temporary)
{
    fputs("set output\n", script);
    run_gnuplot(script, path);
    fclose(script);
    size_t bytes = 0; // gnuplot does not notice a full disk: look for the file's own end
    char *drawing = file_read(temporary, &bytes);
    const char *end = strcmp(strrchr(path, '.'), ".svg") == 0 ? "</svg>" : "IEND";
    if (!drawing || bytes < 16 || !memmem(drawing + bytes - 16, 16, end, strlen(end)))
        fail_work("%s: cannot be written: the drawing is not whole (is the disk full?)", path);
    free(drawing);
    file_commit(temporary);
}

void measure_figure(const char *path, const char *title, const char *metric, const FigurePoint *points,
                    size_t count, const Machine *machine)
{
    FigurePoint *finite = memory_new(count, sizeof *finite, "figure");
    size_t drawn = 0;
    for (size_t i = 0; i < count; i++)
        if (isfinite(points[i].ms) && isfinite(points[i].error))
            finite[drawn++] = points[i];
    if (!drawn)
        fail_work("%s: cannot be drawn: none of %zu points has a finite time and error", path, count);

    const char *temporary;
    FILE *script = figure_begin(path, title, metric, &temporary);
    fputs("set xlabel 'run time of the technique, ms (median; bars: least to most)'\n"
          "set logscale xy\nset format x '%g'\nset format y '10^{%L}'\nset errorbars small\n"
          "set grid xtics ytics mxtics mytics lt 1 lc rgb '#cccccc', lt 1 lc rgb '#eeeeee'\n",
          script);
    put_data(script, finite, drawn);
    put_machine(script, machine);
    if (drawn < count)
        put_note(script, 4, text_format("%zu points are not finite and left out", count - drawn));
    fputs("plot $front with linespoints lw 7 pt 7 ps 2.2 lc rgb '#d0d0d0' title 'Pareto front', "
          "for [k=0:|name|-1] $points index k using 1:2 with lines lw 1.5 lc rgb colour(k) notitle, "
          "for [k=0:|name|-1] $points index k using 1:2:3:4 with xerrorbars pt 0 lc rgb colour(k) notitle, "
          "for [k=0:|name|-1] $points index k using 1:($5 > 0 ? NaN : $2) with points pt shape(k) lc rgb "
          "colour(k) title name[k+1], "
          "for [k=0:|name|-1] $points index k using 1:($5 > 0 ? $2 : NaN) with points pt shape(k)-1 lc rgb "
          "colour(k) notitle\n",
          script);
    free(finite);
    figure_end(script, path, temporary);
}

void measure_bars(const char *path, const char *title, const char *metric, const FigureBars *bars,
                  const Machine *machine)
{
    const char *temporary;
    FILE *script = figure_begin(path, title, metric, &temporary);
    fputs(
        "set style data histograms\nset style histogram rowstacked\nset style fill solid 0.85 border lc rgb "
        "'white'\nset boxwidth 0.6\nset yrange [0:*]\nset grid ytics lt 1 lc rgb '#cccccc'\nset xtics font "
        "',9' "
        "noenhanced\n"
        "$bars << END_OF_BARS\n",
        script);
    for (size_t i = 0; i < bars->bar_count; i++) {
        fputc('"', script); // as put_quoted, but a data block's quotes are double and cannot be escaped
        for (const char *c = bars->bars[i]; *c; c++)
            if (*c == '\n')
                fputs("\\n", script);
            else
                fputc(iscntrl((unsigned char)*c) || *c == '"' || *c == '\\' ? ' ' : *c, script);
        fputc('"', script);
        for (size_t part = 0; part < bars->part_count; part++)
            fprintf(script, " %.9g", bars->values[i * bars->part_count + part]);
        fputc('\n', script);
    }
    fputs("END_OF_BARS\n", script);
    put_machine(script, machine);
    for (size_t part = 0; part < bars->part_count; part++) {
        fprintf(script, "%s$bars using %zu:xtic(1) lc rgb colour(%zu) title ", part ? ", " : "plot ",
                part + 2, part);
        put_quoted(script, bars->parts[part]);
    }
    fputc('\n', script);
    figure_end(script, path, temporary);
}
