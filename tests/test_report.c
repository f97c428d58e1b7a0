// make report: numbers of the page against closed forms, from tables made up here; and its driver, which loses nothing when it is killed.
#include "image.h"
#include "report_files.h"

#include <math.h>
#include <signal.h>
#include <sys/stat.h>

#define SWEEP_HEADER                                                                                         \
    "# renderer: none\n# cpu: one\n# command: made up\n"                                                     \
    "chapter,technique,scene,width,height,settings,ms_technique,ms_min,ms_max,ms_frame,reference,metric,"    \
    "error,ms_repeats\n"

static void sweep_row(FILE *to, const char *technique, const char *settings, double ms, double error)
{
    fprintf(to, "01_a,%s,box,8,8,%s,%.4f,%.4f,%.4f,%.4f,truth,nrmse,%.9g,%.4f %.4f %.4f\n", technique,
            settings, ms, ms, ms, ms, error, ms, ms, ms);
}

// brute: error 1/ms. fast: 1/(100 ms²), so error e takes 0.1/√e. never: no better than 2.
static void sweep_make(FILE *to)
{
    fputs(SWEEP_HEADER, to);
    for (int n = 1; n <= 16; n *= 2) {
        char *steps = text_format("method=x;steps=%d", n);
        sweep_row(to, "brute", steps, n, 1.0 / n);
        sweep_row(to, "fast", steps, 0.125 * n, 1 / (100 * 0.125 * n * 0.125 * n));
        sweep_row(to, "never", steps, n, 2);
        free(steps);
    }
    sweep_row(to, "brute", "method=x;steps=4;oracle=map", 4, 0.2); // E² = 1/16: the map's part is 1/16 − 1/25
    sweep_row(to, "brute", "method=x;steps=4;oracle=grid", 4, 0.25); // and the grid's is nothing
    sweep_row(to, "single", "method=y", 2, 0.5);
}

static void tables_make(void)
{
    cr_assert_eq(shell("mkdir -p $T/out/01_a $T/out/02_b $T/chapters/01_a $T/chapters/02_b"), 0, "folders");
    char *path = path_of("out/01_a/sweep.csv");
    FILE *to = fopen(path, "w");
    sweep_make(to);
    fclose(to);
    free(path);
    file_put("out/01_a/list.txt", "chapter\t01_a\tLaws & <powers>\n");
    file_put("chapters/01_a/report.txt",
             "# a "
             "comment\nfamily\tlaws\nbrute\tbrute\norder\tfast\tnrmse\t2\norder\tbrute\tnrmse\t9\t-"
             "\ttruth\norder\tbrute\tnrmse\t1\tbox\tconverged\n");
    file_put("chapters/02_b/report.txt", "family\tlaws\n");
    file_put("out/01_a/status.txt", "failed\tsweep of doom\tstatus 1: no\n");
    file_put("out/01_a/stability.csv",
             "# cpu: one\nchapter,case,quantity,expected,got,error,tolerance,nonfinite,verdict\n"
             "01_a,calm,q,1,1,0,0.1,0,pass\n01_a,stiff,q,1,2,1,0.1,0,fail\n");
    file_put("out/01_a/plan.csv",
             "scene,options,everything,pass,ran,ms,skipped,of,counts,reason\n"
             "box,,no,map,false,0,0,0,,no light\nbox,,no,march,true,3,2,8,fetches=10,\n"
             "box,,no,same,true,1,0,0,fetches=4,\n"
             "box,,yes,map,true,2.5,0,0,fragments=64,no light\nbox,,yes,march,true,4,0,8,fetches=50,\n"
             "box,,yes,same,true,1,0,0,fetches=4,\n");
    Image image = image_make(2, 1, 3);
    image.pixels[0] = image.pixels[3] = 1;
    path = path_of("out/01_a/one.exr");
    image_write(path, &image, 0);
    free(path);
    image.pixels[3] = 3; // (1, 3) against (1, 1): squares 0, 4 over 6 values, mean 1/3
    path = path_of("out/01_a/three.exr");
    image_write(path, &image, 0);
    free(path);
    image_free(&image);
    file_put("out/01_a/limits.txt", "one\tone.exr\tsteps=1\nthree\tthree.exr\tsteps=3\n");
}

Test(report, numbers_are_those_of_the_laws)
{
    tables_make();
    cr_assert_eq(shell("$B/report $T/out $T/chapters 01_a 02_b >$T/log 2>&1"), 0, "%s", text_of("log"));

    CsvTable table = table_of("out/01_a/01_a-box-8x8-nrmse.equal_error.csv");
    size_t fast = 0;
    for (size_t row = 1; row < table.rows; row++) {
        const char *technique = csv_table_field(&table, row, "technique");
        double error = atof(csv_table_field(&table, row, "brute_error")),
               got = atof(csv_table_field(&table, row, "speed_up")), expected = 10 / sqrt(error);
        const char *reach = csv_table_field(&table, row, "reach");
        if (strcmp(technique, "never") == 0)
            cr_assert_str_eq(reach, "not reached", "error %g", error);
        if (strcmp(technique, "fast") != 0)
            continue;
        fast++;
        // its cheapest setting has error 0.64, so 1 is only bounded
        cr_assert_str_eq(reach, error < 0.64 ? "reached" : "bound", "error %g", error);
        expected = error < 0.64 ? expected : 1 / 0.125;
        cr_assert_float_eq(got, expected, expected * ROUNDING, "error %g: %g, not %g", error, got, expected);
        cr_assert_float_eq(atof(csv_table_field(&table, row, "least")), got, got * ROUNDING, "equal repeats");
    }
    cr_assert_eq(fast, 5, "a row a setting of brute force, none of the oracle's");
    csv_table_free(&table);

    table = table_of("out/01_a/01_a-box-8x8-nrmse.equal_time.csv");
    cr_assert_str_eq(field_where(&table, "technique", "fast", "reach"), "reached", "1 ms");
    cr_assert_float_eq(atof(field_where(&table, "technique", "fast", "error")), 0.01, 0.01 * ROUNDING,
                       "in 1 ms");
    csv_table_free(&table);

    table = table_of("out/01_a/orders.csv");
    cr_assert_float_eq(atof(field_where(&table, "technique", "fast", "order")), 2, 1e-3, "three digits");
    cr_assert_str_eq(field_where(&table, "technique", "fast", "over"), "steps", "what varies");
    cr_assert_str_eq(field_where(&table, "technique", "fast", "expected"), "2", "as report.txt says");
    cr_assert_str_eq(field_where(&table, "technique", "brute", "verdict"), "outside", "1 is not 9");
    cr_assert_str_eq(field_where(&table, "technique", "brute", "rows"), "5 of 5", "no row of an oracle");
    for (size_t row = 1; row < table.rows; row++)
        cr_assert_str_neq(csv_table_field(&table, row, "technique"), "single", "one point has no order");
    csv_table_free(&table);

    table = table_of("out/01_a/01_a-budget-box-8x8-nrmse.csv");
    cr_assert_eq(table.rows, 1 + 3, "one bar of two stages and the rest");
    double part = 0.25 * (1 / 16.0 - 1 / 25.0) * 16;
    cr_assert_float_eq(atof(field_where(&table, "stage", "map", "part")), part, part * ROUNDING,
                       "the map's part");
    cr_assert_eq(atof(field_where(&table, "stage", "grid", "part")), 0, "the grid's");
    cr_assert_float_eq(atof(field_where(&table, "stage", "rest", "part")), 0.25 - part, ROUNDING, "the rest");
    csv_table_free(&table);

    table = table_of("out/01_a/saved.csv");
    cr_assert_eq(table.rows, 1 + 2, "the pass that is the same is not told");
    cr_assert_str_eq(field_where(&table, "pass", "map", "left_out"), "the pass", "map");
    cr_assert_str_eq(field_where(&table, "pass", "map", "ms_saved"), "2.500", "map");
    cr_assert_str_eq(field_where(&table, "pass", "map", "counts_saved"), "fragments 64", "map");
    cr_assert_str_eq(field_where(&table, "pass", "march", "left_out"), "2 of 8", "march");
    cr_assert_str_eq(field_where(&table, "pass", "march", "counts_saved"), "fetches 40", "march");
    csv_table_free(&table);

    table = table_of("out/01_a/consistency.csv");
    cr_assert_str_eq(field_where(&table, "limit", "one", "one"), "0", "itself");
    double nrmse = sqrt(4 / 6.0) / (2 / 6.0); // against `one`, whose mean is 2/6
    cr_assert_float_eq(atof(field_where(&table, "limit", "three", "one")), nrmse, 0.005 * nrmse,
                       "three digits");
    csv_table_free(&table);
}

Test(report, techniques_are_compared_on_the_same_problem)
{
    tables_make();
    file_put("chapters/01_a/report.txt", "brute\tbrute\nsame\tsteps\n");
    cr_assert_eq(shell("$B/report $T/out $T/chapters 01_a >$T/log 2>&1"), 0, "%s", text_of("log"));
    CsvTable table = table_of("out/01_a/01_a-box-8x8-nrmse.equal_error.csv");
    for (size_t row = 1; row < table.rows; row++)
        if (strcmp(csv_table_field(&table, row, "technique"), "fast") == 0) {
            // one point each: error 1/n in n ms against 0.64/n² in n/8 ms
            cr_assert_str_eq(csv_table_field(&table, row, "reach"), "bound", "row %zu", row);
            cr_assert_float_eq(atof(csv_table_field(&table, row, "speed_up")), 8, 8 * ROUNDING, "row %zu",
                               row);
        }
    csv_table_free(&table);
    table = table_of("out/01_a/orders.csv");
    cr_assert_eq(table.rows, 1, "no order over what poses another problem");
    csv_table_free(&table);
}

Test(report, page_says_what_there_is_and_what_is_not)
{
    tables_make();
    cr_assert_eq(shell("$B/report $T/out $T/chapters 01_a 02_b >$T/log 2>&1"), 0, "%s", text_of("log"));
    char *page = text_of("out/index.html");
    const char *const said[] = {"01_a: Laws &amp; &lt;powers&gt;",
                                "1 of 2 rows pass, 1 fail",
                                "sweep of doom",
                                "Of the family &quot;laws&quot; there is one chapter, 01_a",
                                "02_b: ",
                                "renderer: none; cpu: one",
                                "not reached"};
    for (size_t i = 0; i < sizeof said / sizeof *said; i++)
        cr_assert(strstr(page, said[i]), "the page does not say: %s", said[i]);
    cr_assert(strstr(page, "<td>stiff</td>") < strstr(page, "<td>calm</td>"), "what fails stands first");
    cr_assert(!strstr(page, "<script") && count_of(page, "data:image/svg+xml;base64,") == 2,
              "a diagram and a budget, inside the page");
    char *drawing = text_of("out/01_a/01_a-box-8x8-nrmse.svg");
    cr_assert(drawing && strstr(drawing, "brute (brute force)") && strstr(drawing, "Pareto front"),
              "the diagram");
    cr_assert_eq(shell("test -s $T/out/01_a/01_a-box-8x8-nrmse.png"), 0, "and as PNG");
    // The drawing comes back from the page byte for byte.
    cr_assert_eq(
        shell("sed -n 's/.*base64,\\([^\"]*\\)\".*/\\1/p' $T/out/index.html | head -n 1 | base64 -d | "
              "cmp - $T/out/01_a/01_a-box-8x8-nrmse.svg"),
        0, "base64");
}

Test(report, a_family_of_two_chapters_shares_its_diagram)
{
    tables_make();
    cr_assert_eq(shell("cd $T/out && rm 01_a/plan.csv 01_a/stability.csv && "
                       "echo 'one\tone.exr\tsteps=1' >01_a/limits.txt && mv 01_a/three.exr 02_b && "
                       "echo 'three\tthree.exr\tsteps=3' >02_b/limits.txt && "
                       "sed '/oracle\\|brute/d; s/01_a/02_b/' 01_a/sweep.csv >02_b/sweep.csv && "
                       "$B/report $T/out $T/chapters 01_a 02_b >$T/log 2>&1"),
                 0, "%s", text_of("log"));
    CsvTable table = table_of("out/family-laws/laws-box-8x8-nrmse.equal_error.csv");
    cr_assert_str_eq(field_where(&table, "technique", "02 fast", "reach"), "bound",
                     "against the other's brute force");
    csv_table_free(&table);
    table = table_of("out/family-laws/consistency.csv");
    const double nrmse = sqrt(4 / 6.0) / (2 / 6.0); // as above, across the two chapters
    cr_assert_float_eq(atof(field_where(&table, "limit", "02 three", "01 one")), nrmse, 0.005 * nrmse,
                       "of both");
    csv_table_free(&table);
    cr_assert(strstr(text_of("out/index.html"), "02_b-box-8x8-nrmse: no row of brute force"),
              "alone it has nothing to be compared with, and the page says so");
}

Test(report, one_point_without_repeats_and_no_finite_point_are_told)
{
    tables_make();
    file_put("out/01_a/sweep.csv",
             "chapter,technique,scene,width,height,settings,ms_technique,ms_min,ms_max,ms_frame,"
             "reference,metric,error\n01_a,brute,box,8,8,,1,1,1,1,truth,nrmse,0.5\n"
             "01_a,other,box,8,8,,2,2,2,2,truth,nrmse,0.5\n"
             "01_a,other,box,8,8,,2,2,2,2,truth,blown,inf\n");
    cr_assert_eq(shell("$B/report $T/out $T/chapters 01_a >$T/log 2>&1"), 0, "%s", text_of("log"));
    char *page = text_of("out/index.html");
    cr_assert(strstr(page, "0.5× (no interval: one repeat)"), "one point is reached exactly");
    cr_assert(strstr(page, "blown: none of 1 points has a finite time and error"), "nothing to draw");
    file_put("out/01_a/sweep.csv", "chapter,technique,sce");
    cr_assert_eq(shell("$B/report $T/out $T/chapters 01_a >$T/log 2>&1"), 1, "a table that is cut off");
    cr_assert(strstr(text_of("log"), "cut off"), "%s", text_of("log"));
}

// --- the driver --------------------------------------------------------------------------------------------------------------

// A chapter of four rows, two of them on two scenes, and a case: it notes each run, waits at row 3 while $T/hold is there, fails at row 2 while $T/bad is there.
static const char fake[] =
    "#!/bin/sh\n"
    "row= file= kind= scene=lit\n"
    "while [ $# -gt 0 ]; do case $1 in\n"
    "  --list) printf 'chapter\\t99_fake\\tFake\\ndefault\\tlit\\ndefault\\tdark\\n'\n"
    "    for n in 1 2 3; do printf 'sweep\\t%d\\tbrute\\t-\\tsteps=%d\\t-\\n' $n $n; done\n"
    "    printf 'sweep\\t4\\tours\\tlit\\t-\\t-\\nstability\\t1\\tstiff\\t-\\t-\\t-\\n'; exit ;;\n"
    "  --row) row=$2; shift ;; --scene) scene=$2; shift ;; --sweep|--stability) kind=$1 file=$2; shift ;;\n"
    "  --plan) kind=--plan ;; esac; shift; done\n"
    "echo \"$kind $scene $row\" >>\"$T/runs\"\n"
    "[ $kind = --plan ] && { echo '{\"scene\": \"lit\", \"passes\": [{\"name\": \"p\", \"ran\": true, "
    "\"ms\": 1, \"skipped\": 0, "
    "\"of\": 0, \"counts\": {\"rays\": 2}, \"reason\": null}]}'; exit 0; }\n"
    "temporary=$(dirname $file)/.partial.csv\n"
    "printf '# cpu: one\\nchapter,' >$temporary\n"
    "if [ $kind = --stability ]; then\n"
    "  printf "
    "'case,quantity,expected,got,error,tolerance,nonfinite,verdict\\n99_fake,stiff,q,1,2,1,0,0,fail\\n' "
    ">>$temporary\n"
    "  mv $temporary $file; exit 1; fi\n"
    "while [ $row = 3 ] && [ -e $T/hold ]; do touch $T/held; sleep 0.02; done\n"
    "if [ $row = 2 ] && [ -e $T/bad ]; then echo 'fake: no light' >&2; exit 1; fi\n"
    "printf "
    "'technique,scene,width,height,settings,ms_technique,ms_min,ms_max,ms_frame,reference,metric,error,ms_"
    "repeats\\n' "
    ">>$temporary\n"
    "printf '99_fake,brute,%s,8,8,steps=%s,%s,1,9,1,truth,nrmse,0.%s,1 2 3\\n' $scene $row $row $((9 - row)) "
    ">>$temporary\n"
    "mv $temporary $file\n";

#define DRIVER "sh tests/tools/report.sh $T/build $T/out $T/chapters 99_fake >$T/log 2>&1"

static void driver_begin(bool with_page)
{
    cr_assert_eq(shell("mkdir -p $T/build $T/chapters/99_fake"), 0, "folders");
    cr_assert_eq(shell(with_page ? "ln -s $B/report $T/build/report" : "ln -s /bin/true $T/build/report"), 0,
                 "what writes the page");
    file_put("chapters/99_fake/report.txt",
             "metric\tnot_measured\n" // no diagram: gnuplot would take most of the time
             "full\t--scene lit --set wide=1\n");
    file_put("build/99_fake", fake);
    cr_assert_eq(shell("chmod +x $T/build/99_fake"), 0, "a program");
}

static void rows_check(const char *why)
{
    CsvTable table = table_of("out/99_fake/sweep.csv");
    cr_assert_eq(table.rows, 1 + 7, "%s: three rows on two scenes and one on its own, not %zu", why,
                 table.rows - 1);
    csv_table_free(&table);
    cr_assert_eq(count_of(text_of("out/99_fake/plan.csv"), "rays=2"), 4, "%s: two scenes, twice", why);
}

Test(report, killed_run_goes_on_where_it_stopped)
{
    driver_begin(false);
    for (int everyone = 1; everyone >= 0; everyone--) { // with its row, as by a power cut; and alone
        cr_assert_eq(shell("rm -rf $T/out $T/runs $T/held; touch $T/hold"), 0, "from the start");
        pid_t child = fork();
        if (child == 0) {
            setpgid(0, 0);
            execl("/bin/sh", "sh", "-c", "exec " DRIVER, (char *)NULL);
            _exit(127);
        }
        for (int wait = 0; wait < 2000 && shell("test -e $T/held") != 0; wait++)
            usleep(10000);
        kill(everyone ? -child : child, SIGKILL);
        waitpid(child, NULL, 0);
        cr_assert_eq(count_of(text_of("runs"), "--sweep lit"), 3, "killed in its third row: %s",
                     text_of("runs"));
        cr_assert_eq(shell("rm $T/hold"), 0, "the row ends");
        cr_assert_eq(shell(DRIVER), 0, "%s", text_of("log"));
        rows_check(everyone ? "all killed" : "driver killed");
        char *runs = text_of("runs");
        cr_assert(count_of(runs, "--sweep lit 1\n") == 1 && count_of(runs, "--sweep lit 2\n") == 1,
                  "what was whole is kept: %s", runs);
        // Its row ends by itself where it was left running, and the next run waits for it.
        cr_assert_eq(count_of(runs, "--sweep lit 3\n"), everyone ? 2 : 1, "%s", runs);
        cr_assert_eq(shell(DRIVER), 0, "%s", text_of("log"));
        cr_assert_str_eq(text_of("runs"), runs, "a third run has nothing to do");
        free(runs);
    }
    cr_assert_eq(shell("echo '# changed' >>$T/build/99_fake; " DRIVER), 0, "%s", text_of("log"));
    cr_assert_eq(count_of(text_of("runs"), "--sweep lit 1\n"), 2, "another program: its rows are run anew");
    cr_assert_eq(shell("QUICK=1 " DRIVER), 0, "%s", text_of("log"));
    cr_assert_eq(count_of(text_of("out/99_fake/sweep.csv"), ",dark,"), 0, "QUICK: the first scene alone");
    cr_assert_eq(shell("FULL=1 " DRIVER), 0, "%s", text_of("log"));
    cr_assert_eq(count_of(text_of("out/99_fake/plan.csv"), "rays=2"), 6, "FULL: one plan more, twice");
}

Test(report, failed_rows_are_told_and_tried_again)
{
    driver_begin(true);
    file_put("bad", "");
    cr_assert_eq(shell(DRIVER), 1, "%s", text_of("log"));
    char *page = text_of("out/index.html");
    cr_assert(strstr(page, "<td>brute lit steps=2</td><td>status 1: fake: no light</td>"), "%s",
              text_of("log"));
    cr_assert_eq(count_of(text_of("out/99_fake/sweep.csv"), "steps=2"), 0, "no row for it");
    cr_assert(strstr(page, "0 of 1 rows pass, 1 fail"),
              "a case that fails is a row, and no failure of the run");
    cr_assert_eq(shell("rm $T/bad"), 0, "mended");
    cr_assert_eq(shell(DRIVER), 0, "%s", text_of("log"));
    rows_check("mended");
    cr_assert_eq(count_of(text_of("runs"), "--sweep lit 2\n"), 2, "tried again");
    cr_assert_eq(count_of(text_of("runs"), "--sweep lit 1\n"), 1, "and nothing else");
}

Test(report, what_does_not_fit_is_left_for_the_next_run)
{
    driver_begin(true);
    cr_assert_eq(shell("REPORT_SECONDS=0 " DRIVER), 0, "%s", text_of("log"));
    cr_assert_eq(count_of(text_of("out/index.html"), "<td>left</td>"), 12, "7 rows, a case and 4 plans");
    file_put("hold", "");
    // The driver counts whole seconds: of one, two quick rows may use up all that was left.
    cr_assert_eq(shell("REPORT_SECONDS=4 " DRIVER), 1, "%s", text_of("log"));
    cr_assert(strstr(text_of("out/index.html"), "<td>brute lit steps=3</td><td>stopped after"), "%s",
              text_of("log"));
    cr_assert_eq(shell("rm $T/hold"), 0, "the row ends");
    cr_assert_eq(shell(DRIVER), 0, "%s", text_of("log"));
    rows_check("in three runs");
}
