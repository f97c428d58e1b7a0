// measure: statistics and orders against closed forms, CSV files that come back as written, figures that are drawn whole or not at all.
#include "measure.h"
#include "csv.h"
#include "failure.h"

#include <criterion/criterion.h>
#include <math.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <time.h>

static char folder[] = "/tmp/test_measure_XXXXXX";
static char *path;
static const Machine machine = {
    {(char *)"renderer: none, GL 4.5", (char *)"cpu: it's one", NULL, (char *)"commit: 1234567"}};

static void in_folder(const char *name)
{
    if (!path)
        cr_assert(mkdtemp(folder), "a folder to test in");
    path = text_format("%s/%s", folder, name);
}
static void clean(void)
{
    char *command = text_format("rm -rf '%s'", folder);
    cr_assert_eq(system(command), 0, "the folder is removed");
}
static void expect(void (*function)(void), int status, const char *text)
{
    Failure failure = failure_of(function);
    cr_assert(failure.status == status && failure_says(&failure, text), "status %d: %s", failure.status,
              failure.message);
}

Test(measure, statistics_of_odd_and_even_counts)
{
    const double odd[] = {5, 1, 100}, even[] = {4, 1, 3, 2}, one[] = {7};
    Statistics s = measure_statistics(odd, 3);
    cr_assert(s.median == 5 && s.least == 1 && s.most == 100, "odd");
    cr_assert(odd[0] == 5 && odd[1] == 1 && odd[2] == 100, "the input is not changed");
    cr_assert_eq(measure_statistics(even, 4).median, 2.5, "even: the mean of the two in the middle");
    s = measure_statistics(one, 1);
    cr_assert(s.median == 7 && s.least == 7 && s.most == 7, "one");
}

Test(measure, order_of_powers_is_their_exponent)
{
    double x[6], square[6], inverse[6];
    for (int i = 0; i < 6; i++) {
        x[i] = ldexp(1, i);
        square[i] = 3 * x[i] * x[i];
        inverse[i] = 0.5 / x[i];
    }
    const double tolerance = 1e-12; // logs of numbers near 1 in double
    cr_assert_float_eq(measure_order(x, square, 6), 2, tolerance, "y = 3 x²");
    cr_assert_float_eq(measure_order(x, inverse, 6), -1, tolerance, "y = 1 / (2 x)");
    square[2] = 0, square[3] = NAN, x[5] = -1;
    cr_assert_float_eq(measure_order(x, square, 6), 2, tolerance, "what has no logarithm is left out");
    cr_assert(isnan(measure_order(x, square, 1)), "one point has no slope");
    cr_assert(isnan(measure_order((double[]){2, 2}, (double[]){1, 2}, 2)), "nor have two at one x");
}

Test(measure, clock_runs_forward_and_memory_is_counted)
{
    double before = measure_now_ms();
    struct timespec pause = {.tv_nsec = 20000000};
    nanosleep(&pause, NULL);
    cr_assert_geq(measure_now_ms() - before, 20,
                  "nanosleep never sleeps less than it was asked, in milliseconds");
    size_t bytes = (size_t)64 << 20, peak = measure_peak_bytes();
    char *memory = memory_new(bytes, 1, "test");
    for (size_t i = 0; i < bytes; i += 4096)
        ((volatile char *)memory)[i] = 1;
    cr_assert_geq(measure_peak_bytes(), peak + bytes / 2,
                  "64 MiB touched raise the peak (some were free before)");
}

Test(measure, machine_line_says_what_ran)
{
    setenv("LP_NUM_THREADS", "2", 1);
    char *arguments[] = {(char *)"build/01", (char *)"--set", (char *)"a=1", (char *)"two words\nand a line",
                         NULL};
    Machine m = measure_machine("llvmpipe (LLVM 15)", "4.5 Mesa", 4, arguments);
    cr_assert_str_eq(m.lines[0], "renderer: llvmpipe (LLVM 15), GL 4.5 Mesa", "renderer");
    cr_assert(strncmp(m.lines[1], "cpu: ", 5) == 0 && strlen(m.lines[1]) > 5, "%s", m.lines[1]);
    cr_assert(strstr(m.lines[2], "cores usable, LP_NUM_THREADS 2"), "%s", m.lines[2]);
    cr_assert(strncmp(m.lines[3], "commit: ", 8) == 0 && strlen(m.lines[3]) > 8, "%s", m.lines[3]);
    cr_assert_str_eq(m.lines[4], "command: build/01 --set a=1 'two words and a line'", "on one line");
    cr_assert(strncmp(m.lines[5], "date: 20", 8) == 0, "%s", m.lines[5]);
    measure_machine_free(&m);
    cr_assert_null(m.lines[0], "freed");
}

static const char *const fields[] = {"plain", "with, comma", "a \"quoted\" word",   "two\nlines",
                                     "",      "\"",          "steps=64;dither=blue"};
enum { FIELDS = sizeof fields / sizeof *fields };

static void write_table(void)
{
    Csv *csv = csv_open(path, &machine, "a,b,c,d,e,f,g");
    csv_row(csv, fields, FIELDS);
    csv_row(csv, fields, FIELDS);
    csv_close(csv);
}

Test(measure, csv_comes_back_as_written)
{
    in_folder("a.csv");
    write_table();
    CsvTable table = csv_table_read(path);
    cr_assert(table.rows == 3 && table.columns == FIELDS, "%zu rows of %zu", table.rows, table.columns);
    cr_assert(table.comment_count == 3, "a comment for each line known");
    cr_assert_str_eq(table.comments[2], "commit: 1234567", "comments in order");
    for (size_t i = 0; i < FIELDS; i++) {
        const char header[] = {(char)('a' + i), '\0'};
        cr_assert_str_eq(csv_table_field(&table, 2, header), fields[i], "field %s", header);
    }
    csv_table_free(&table);
    clean();
}

static void killed_between_rows(void)
{
    Csv *csv = csv_open(path, &machine, "a,b,c,d,e,f,g");
    csv_row(csv, fields, FIELDS);
    raise(SIGKILL);
}
static void failed_between_rows(void)
{
    Csv *csv = csv_open(path, &machine, "a,b,c,d,e,f,g");
    csv_row(csv, fields, FIELDS);
    fail_work("something else");
}
static void write_on_full_disk(void)
{
    signal(SIGXFSZ, SIG_IGN); // a write past the limit then fails as on a full disk
    setrlimit(RLIMIT_FSIZE, &(struct rlimit){100, 100});
    write_table();
}

Test(measure, csv_is_written_whole_or_not_at_all)
{
    void (*const ways[])(void) = {killed_between_rows, failed_between_rows, write_on_full_disk};
    const int status[] = {-SIGKILL, 1, 1};
    in_folder("a.csv");
    for (int i = 0; i < 3; i++) {
        FILE *file = fopen(path, "w");
        cr_assert(file && fputs("the old one\n", file) >= 0 && fclose(file) == 0, "an old file");
        cr_assert_eq(failure_of(ways[i]).status, status[i], "way %d ends as it should", i);
        char *text = file_read(path, NULL);
        cr_assert_str_eq(text, "the old one\n", "way %d leaves the old file", i);
    }
    char *rows = text_format("grep -l 'steps=64' '%s'/.a.csv.* | wc -l | grep -qx 1", folder);
    cr_assert_eq(system(rows), 0, "the killed one's row is in its temporary file, the others' are gone");
    in_folder("link.csv");
    cr_assert_eq(symlink("/dev/full", path), 0, "a link to the full device");
    expect(write_table, 1, "No space left");
    in_folder("nowhere/a.csv");
    expect(write_table, 1, "No such file or directory");
    clean();
}

static FigurePoint points[] = {
    {"brute_force", 10, 9, 12, 0.1},
    {"brute_force", 40, 38, 60, 0.03},
    {"it's <new> & fast", 4, 4, 5, 0.06},
    {"it's <new> & fast", 8, 7, 9, 0},
    {"broken", 1, 1, 1, NAN},
};
static size_t point_count = 5;

static void draw(void)
{
    measure_figure(path, "a 'title' of_this", "nrmse", points, point_count, &machine);
}
static void draw_without_gnuplot(void)
{
    setenv("PATH", folder, 1);
    draw();
}
static void draw_on_full_disk(void)
{
    signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &(struct rlimit){8192, 8192}); // the script fits, the drawing does not
    draw();
}

Test(measure, figure_shows_every_curve_and_says_what_it_moved)
{
    in_folder("a.svg");
    draw();
    char *svg = file_read(path, NULL);
    const char *const wanted[] = {
        "a 'title' of_this", "brute_force", "it's &lt;new> &amp; fast", "Pareto front",
        "renderer: none, GL 4.5; cpu: it's one", "commit: 1234567",
        // a floor of 0.3 of the decade of the least positive error, 0.03, and time, 4 ms
        "drawn at the floor of its axis (error 0.003, time 0.3 ms)", "1 points are not finite and left out"};
    for (size_t i = 0; i < sizeof wanted / sizeof *wanted; i++)
        cr_assert(svg && strstr(svg, wanted[i]), "the figure says: %s", wanted[i]);
    cr_assert(!strstr(svg, "broken"), "a curve without points is not named");
    in_folder("a.png");
    draw();
    Image image = image_read(path);
    cr_assert(image.width == 820 && image.height == 600, "a PNG of the stated size");
    long white = 0;
    for (int i = 0; i < 820 * 600; i++)
        white += image.pixels[i * image.channels + 1] > 0.99f;
    cr_assert(white > 820 * 600 / 2 && white < 820 * 600 * 99 / 100, "ink on paper: %ld white pixels", white);
    clean();
}

Test(measure, figure_draws_the_points_that_none_beats)
{
    in_folder("gnuplot"); // keeps its script, then draws
    FILE *gnuplot = fopen(path, "w");
    cr_assert(gnuplot &&
                  fprintf(gnuplot, "#!/bin/sh\nPATH=${PATH#*:}\ncp \"$1\" '%s/script'\nexec gnuplot \"$1\"\n",
                          folder) > 0 &&
                  fchmod(fileno(gnuplot), 0700) == 0 && fclose(gnuplot) == 0,
              "a gnuplot of our own");
    char *search = text_format("%s:%s", folder, getenv("PATH"));
    setenv("PATH", search, 1);
    in_folder("a.svg");
    draw();
    in_folder("script");
    char *script = file_read(path, NULL);
    // By time: (4, 0.06), (8, the floor 0.003); (10, 0.1) and (40, 0.03) are beaten by it, though 0.03 is less than the 0.1 before it.
    cr_assert(script && strstr(script, "<< END_OF_FRONT\n4 0.06\n8 0.003\nEND_OF_FRONT\n"), "%s", script);
    clean();
}

Test(measure, figure_is_drawn_whole_or_not_at_all)
{
    in_folder("a.svg");
    expect(draw_without_gnuplot, 1, "gnuplot");
    expect(draw_on_full_disk, 1, "a.svg");
    in_folder("a.jpg");
    expect(draw, 2, "must end in .svg or .png");
    in_folder("nowhere/a.svg");
    expect(draw, 1, "No such file or directory");
    in_folder("b.svg");
    point_count = 0;
    expect(draw, 1, "none of 0 points");
    char *empty = text_format("test -z \"$(ls -A '%s')\"", folder);
    cr_assert_eq(system(empty), 0, "nothing is left behind");
    clean();
}
