// run: passes, plan, sweep and stability table, on a chapter made up for it.
#include "support_run.h"
#include "run.h"
#include <criterion/criterion.h>
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

TestSuite(run_tables, .init = fake_folder_enter, .fini = fake_folder_leave, .timeout = 60);

// --- Passes and the plan --------------------------------------------------------------------------------------------------------
// The text with # for every number of ms and fragments, for comparison.
static char *without_measured(const char *text)
{
    char *copy = strdup(text), *to = copy;
    for (const char *from = text; *from;) {
        size_t key = strncmp(from, "ms\": ", 5) == 0 ? 5 : strncmp(from, "fragments\": ", 12) == 0 ? 12 : 0;
        memcpy(to, from, key ? key : 1);
        to += key ? key : 1;
        from += key ? key : 1;
        if (key) {
            *to++ = '#';
            from += strspn(from, "0123456789.");
        }
    }
    *to = '\0';
    return copy;
}

Test(run_tables, plan_as_json_is_exactly_the_documented_object)
{
    Outcome got = fake_done("--plan --json --size 16x16");
    // One triangle over the picture, drawn twice under one name.
    cr_assert_str_eq(without_measured(got.out),
                     "{\"chapter\": \"99_fake\", \"scene\": \"lit\", \"passes\": [\n"
                     "  {\"name\": \"map\", \"ran\": true, \"ms\": #, \"skipped\": 0, \"of\": 0, \"counts\": "
                     "{}, \"reason\": null},\n"
                     "  {\"name\": \"refine\", \"ran\": false, \"ms\": #, \"skipped\": 0, \"of\": 0, "
                     "\"counts\": {}, \"reason\": \"the "
                     "\\\"raster\\\" method\\u0009needs none\"},\n"
                     "  {\"name\": \"draw\", \"ran\": true, \"ms\": #, \"skipped\": 0, \"of\": 0, "
                     "\"counts\": {\"fragments\": #, "
                     "\"primitives\": 2}, \"reason\": null}],\n \"total_ms\": #}\n",
                     "%s", got.out);
    // 2 · 16² fragments; the renderer counts whole blocks of 4×4, and those on the seam where it cut the triangle twice: below 1.5 times.
    double fragments = atof(strstr(got.out, "fragments\": ") + 12);
    cr_assert(fragments >= 512 && fragments < 768, "%s", got.out);
    // Two frames of warm-up, then the one that is listed; the chapter sleeps 3 ms in the map.
    cr_assert_eq(count_of(got.trace, "frame 0"), 3, "%s", got.trace);
    cr_assert_geq(atof(strstr(got.out, "\"ms\": ") + 6), 3.0, "the map's ms: %s", got.out);
    cr_assert_eq(atof(strstr(strstr(got.out, "refine"), "\"ms\": ") + 6), 0.0,
                 "a pass left out takes no time: %s", got.out);
}

Test(run_tables, everything_runs_what_is_needless_and_marks_it)
{
    Outcome plan = fake_done("--plan --json --size 16x16 --everything"),
            text = fake_done("--plan --everything --size 16x16");
    cr_assert(strstr(without_measured(plan.out),
                     "{\"name\": \"refine\", \"ran\": true, \"ms\": #, \"skipped\": 3, \"of\": 8, "
                     "\"counts\": {\"fetches\": 7, "
                     "\"compute_invocations\": 32}, \"reason\": \"the \\\"raster\\\" method"),
              "4 groups of 8 ran, and the reason is kept: %s", plan.out);
    cr_assert_geq(atof(strstr(strstr(plan.out, "refine"), "\"ms\": ") + 6), 2.0, "its ms: %s", plan.out);
    cr_assert(strstr(text.out, "[needless: the \"raster\" method") && strstr(text.out, "3 of 8 left out") &&
                  strstr(text.out, "fetches=7"),
              "%s", text.out);
    fake_done("--size 8x4 --out a.exr --step second --everything");
    cr_assert_eq(image_read("a.exr").pixels[1], 2.0f, "shaders see EVERYTHING 1");
    Outcome exact = fake_done("--plan --size 16x16 --set method=exact");
    cr_assert(!strstr(exact.out, "needs none"), "needed: nothing to mark: %s", exact.out);
}

Test(run_tables, count_that_is_not_a_number_is_refused)
{
    fake_expect("--plan --size 16x16 --set method=exact --set fault=count", 1,
                "99_fake: pass 'refine': its count of fetches is not a finite number\n");
}

// --- Tables -----------------------------------------------------------------------------------------------------------------------
// The CSV without its comments, which must be there.
static char *rows_of(const char *path)
{
    char *text = file_read(path, NULL), *rows = text;
    cr_assert(text, "%s was not written", path);
    while (*rows == '#')
        rows = strchr(rows, '\n') + 1;
    cr_assert(rows > text, "no machine line in\n%s", text);
    return rows;
}

static char *line_of(char *text, int index) // without its end
{
    while (index--)
        text = strchr(text, '\n') + 1;
    return text_format("%.*s", (int)strcspn(text, "\n"), text);
}

Test(run_tables, sweep_repeats_slow_frames_less)
{
    Outcome got = fake_done("--sweep s.csv --set method=exact --set fault=slow");
    cr_assert_eq(count_of(got.trace, "frame 0\n"), 2 + 3, "frames of a second: %s", got.trace);
    char *row = line_of(rows_of("s.csv"), 1);
    double ms[4];
    cr_assert_eq(sscanf(strrchr(row, '"'), "\",%lf,%lf,%lf,%lf", &ms[0], &ms[1], &ms[2], &ms[3]), 4, "%s",
                 row);
    cr_assert(ms[1] >= 2 && ms[1] <= ms[0] && ms[0] <= ms[2] && ms[3] >= 1001, "of the three that ran: %s",
              row);
}

Test(run_tables, sweep_runs_every_row_on_its_scenes_and_writes_medians)
{
    Outcome got = fake_done("--size 8x8 --sweep s.csv --set alpha=0.25");
    static const char *const settings[] = {
        "setting brute lit raster 8 0.25 0 8x8\n", "setting brute dark raster 8 0.25 0 8x8\n",
        "setting brute lit raster 16 0.25 0 8x8\n", "setting brute dark raster 16 0.25 0 8x8\n",
        "setting ours lit exact 64 0.25 1 8x4\n"};
    const char *at = got.trace;
    for (int i = 0; i < 5; ++i, ++at) {
        at = strstr(at, settings[i]);
        cr_assert(at, "%s is not there, or not in order:\n%s", settings[i], got.trace);
    }
    cr_assert_eq(count_of(got.trace, "setting "), 5, "five settings: %s", got.trace);
    cr_assert_eq(count_of(got.trace, "frame 0\n"), 5 * 9,
                 "two frames of warm-up and seven repeats, all of frame 0");
    char *rows = rows_of("s.csv");
    cr_assert_str_eq(line_of(rows, 0),
                     "chapter,technique,scene,width,height,settings,ms_technique,ms_min,ms_max,ms_frame,"
                     "reference,metric,error,ms_repeats,ms_frame_repeats",
                     "the header");
    cr_assert_eq(count_of(rows, "\n"), 6, "%s", rows);
    double ms[4], repeats[2][7];
    char *ours = line_of(rows, 5), tail[64];
    cr_assert_eq(sscanf(ours,
                        "99_fake,ours,lit,8,4,\"method=exact;alpha=0.25;shift=0,0,1\",%lf,%lf,%lf,%lf,%63s",
                        ms, ms + 1, ms + 2, ms + 3, tail),
                 5, "%s", ours);
    char *last = strrchr(tail, ',');
    cr_assert(last, "%s", ours);
    *last = '\0';
    cr_assert_str_eq(tail, "converged,wrong,0.015625", "%s", ours);
    const char *text = strstr(ours, ",0.015625,") + 10;
    for (int i = 0; i < 14; ++i) {
        cr_assert_eq(text[-1], i % 7 ? text[-1] : ',', "seven of the technique, then seven of the frame");
        repeats[i / 7][i % 7] = strtod(text, (char **)&text);
        text += *text != '\0';
    }
    Statistics of = measure_statistics(repeats[0], 7), frame = measure_statistics(repeats[1], 7);
    cr_assert_eq(frame.median, ms[3], "the frame's median: %s", ours);
    cr_assert(*text == '\0' && of.median == ms[0] && of.least == ms[1] && of.most == ms[2],
              "seven repeats, of which median, least and most are told: %s", ours);
    // The chapter sleeps 2 ms in its own pass and 3 in the map; a sleep is never shorter.
    cr_assert(ms[1] >= 2 && ms[1] <= ms[0] && ms[0] <= ms[2], "min, median, max: %s", ours);
    cr_assert_geq(ms[3], ms[1] + 3, "the frame holds the map too: %s", ours);
    cr_assert(strstr(line_of(rows, 1), "99_fake,brute,lit,8,8,method=raster;resolution=8;alpha=0.25,"), "%s",
              rows);
}

Test(run_tables, set_and_scene_leave_out_rows_that_say_otherwise)
{
    Outcome got = fake_done("--size 8x8 --sweep s.csv --set resolution=16 --scene dark");
    cr_assert_eq(count_of(got.trace, "setting "), 1, "%s", got.trace);
    cr_assert(strstr(got.trace, "setting brute dark raster 16 "), "%s", got.trace);
}

Test(run_tables, row_runs_alone)
{
    Outcome got = fake_done("--size 8x8 --sweep s.csv --row 2 --scene dark");
    cr_assert_eq(count_of(got.trace, "setting "), 1, "%s", got.trace);
    cr_assert(strstr(got.trace, "setting brute dark raster 16 "), "%s", got.trace);
    got = fake_done("--size 8x8 --stability t.csv --row 2");
    cr_assert(count_of(got.trace, "setting ") == 1 && strstr(got.trace, "setting rough dark"), "%s",
              got.trace);
}

Test(run_tables, rows_of_a_name_run_alone)
{
    Outcome got = fake_done("--size 8x8 --sweep s.csv --row brute --scene dark");
    cr_assert_eq(count_of(got.trace, "setting "), 2, "%s", got.trace);
    got = fake_done("--size 8x8 --sweep s.csv --row our,ours,oursome --scene lit");
    cr_assert(count_of(got.trace, "setting ") == 1 && strstr(got.trace, "setting ours"), "%s", got.trace);
    got = fake_done("--size 8x8 --sweep s.csv --row ours,brute --scene lit --set resolution=16");
    cr_assert_eq(count_of(got.trace, "setting "), 2, "and --set leaves out of them: %s", got.trace);
    got = fake_done("--size 8x8 --stability t.csv --row rough");
    cr_assert(count_of(got.trace, "setting ") == 1 && strstr(got.trace, "setting rough"), "%s", got.trace);
    fake_expect("--size 8x8 --sweep s.csv --row bru,brutes", 2,
                "99_fake: --sweep: --row, --set or --scene leaves no row of this chapter's sweep\n");
}

Test(run_tables, row_that_measures_nothing_is_an_error)
{
    fake_expect("--size 8x8 --sweep s.csv --set fault=silent", 1,
                "99_fake: sweep row brute, scene lit: nothing was measured\n");
    cr_assert_eq(files_written(), 0, "no half table");
}

Test(run_tables, flicker_is_the_change_that_the_truth_does_not_make)
{
    Outcome got =
        fake_done("--size 8x8 --sweep s.csv --path orbit --frames 4 --scene lit --set method=exact");
    // The picture stands still while the truth steps by ±2 in every value: rms 2 exactly.
    cr_assert(strstr(line_of(rows_of("s.csv"), 1), ",truth,flicker,2,"), "%s", rows_of("s.csv"));
    cr_assert_eq(count_of(got.trace, "truth "), 4, "one truth a frame: %s", got.trace);
    cr_assert_eq(count_of(got.trace, "frame 0\n"), 10, "nine measured, then the path's own first");
    fake_offers_truth = false;
    fake_expect("--size 8x8 --sweep t.csv --path orbit --set method=exact", 2,
                "99_fake: --path with --sweep: ours gives no truth for its frames, so no flicker\n");
}

Test(run_tables, stability_rows_carry_their_verdict)
{
    Outcome got = fake_done("--size 8x8 --stability t.csv");
    char *rows = rows_of("t.csv");
    cr_assert_str_eq(
        rows,
        "chapter,case,quantity,expected,got,error,tolerance,nonfinite,verdict\n"
        "99_fake,fine,ratio,1,1.05,0.05,0.1,0,pass\n99_fake,fine,\"limit, far\",inf,inf,0,0.1,0,pass\n"
        "99_fake,rough,ratio,1,1.05,0.05,0.1,0,pass\n99_fake,rough,\"limit, far\",inf,inf,0,0.1,0,pass\n",
        "%s", rows);
    cr_assert_eq(count_of(got.trace, "frame"), 2, "one frame a case: %s", got.trace);
    cr_assert(strstr(got.trace, "setting rough dark raster 64 0.5 0 16x16\n"), "a case's scene and size: %s",
              got.trace);
}

Test(run_tables, failed_case_is_written_and_ends_with_1)
{
    static const struct {
        double got;
        long nonfinite;
        const char *row;
    } bad[] = {{1.11, 0, "99_fake,fine,ratio,1,1.11,0.11,0.1,0,fail\n"},
               {NAN, 0, "99_fake,fine,ratio,1,nan,nan,0.1,0,fail\n"},
               {1, 3, "99_fake,fine,ratio,1,1,0,0.1,3,fail\n"},
               {-INFINITY, 0, "99_fake,fine,ratio,1,-inf,inf,0.1,0,fail\n"}};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; ++i) {
        fake_checked[0][1] = bad[i].got;
        fake_nonfinite = bad[i].nonfinite;
        // With non-finite values both quantities fail, otherwise the first alone.
        fake_expect("--size 8x8 --stability t.csv --set method=exact", 1,
                    bad[i].nonfinite ? "99_fake: --stability t.csv: 2 of 2 rows failed\n"
                                     : "99_fake: --stability t.csv: 1 of 2 rows failed\n");
        cr_expect(strstr(rows_of("t.csv"), bad[i].row), "%s", rows_of("t.csv"));
    }
}

Test(run_tables, sweep_and_stability_go_together)
{
    Outcome got = fake_done("--size 8x8 --stability t.csv --sweep s.csv --set method=exact");
    cr_assert(strstr(got.trace, "setting fine") > strstr(got.trace, "setting ours"),
              "the sweep comes first: %s", got.trace);
    cr_assert(there("s.csv") && there("t.csv"), "both tables");
}
