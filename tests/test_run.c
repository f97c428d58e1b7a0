// run: the command line, settings and frames, on a chapter made up for it.
#include "support_run.h"
#include "run.h"
#include <criterion/criterion.h>
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

TestSuite(run, .init = fake_folder_enter, .fini = fake_folder_leave, .timeout = 60);

// --- The command line ---------------------------------------------------------------------------------------------------------
// Everything wrong is one line that names it and what would be right, status 2, and no work begun (no trace of a setting).
#define PARAMETERS                                                                                           \
    "method resolution alpha shift fault eye target fov_deg light light_position light_direction "           \
    "light_intensity light_half_angle_deg "                                                                  \
    "scattering absorption mean_cosine exposure"

Test(run, wrong_request_is_one_exact_line)
{
    static const char *const wrong[][2] = {
        {"--sise 3x3", "--sise: no such option; the nearest is --size, --help lists all"},
        {"--outt=x.png", "--outt=x.png: no such option; the nearest is --out, --help lists all"},
        {"-x", "-x: no such option; the nearest is --set, --help lists all"},
        {"--plan -xy", "-xy: no such option; the nearest is --set, --help lists all"},
        {"-xy", "-xy: no such option; the nearest is --set, --help lists all"},
        {"--size=8x8 -xy --plan", "-xy: no such option; the nearest is --set, --help lists all"},
        {"--plan --=", "--=: no such option; the nearest is --set, --help lists all"},
        {"--size", "--size: a value is needed, as --size WxH"},
        {"--plan=yes", "--plan=yes: --plan takes no value"},
        {"picture.png", "picture.png: not an option, they begin with --; --help lists them"},
        {"--size 0x0", "--size 0x0: WIDTHxHEIGHT is needed, each a whole number from 1 to 16384, as 512x512"},
        {"--size 100000x100000",
         "--size 100000x100000: WIDTHxHEIGHT is needed, each a whole number from 1 to 16384, as 512x512"},
        {"--size 64", "--size 64: WIDTHxHEIGHT is needed, each a whole number from 1 to 16384, as 512x512"},
        {"--size -64x64",
         "--size -64x64: WIDTHxHEIGHT is needed, each a whole number from 1 to 16384, as 512x512"},
        {"--size 64x64x64",
         "--size 64x64x64: WIDTHxHEIGHT is needed, each a whole number from 1 to 16384, as 512x512"},
        {"--frames 0", "--frames 0: a whole number from 1 to 1000000 is needed"},
        {"--frames many", "--frames many: a whole number from 1 to 1000000 is needed"},
        {"--seed -1", "--seed -1: a whole number from 0 to 18446744073709551615 is needed"},
        {"--seed 18446744073709551616",
         "--seed 18446744073709551616: a whole number from 0 to 18446744073709551615 is needed"},
        {"--step fourth", "--step fourth: no such step; 1 to 3 or one of: first second third"},
        {"--step 0", "--step 0: no such step; 1 to 3 or one of: first second third"},
        {"--path circle", "--path circle: not one of: subpixel orbit light deform"},
        {"--path deform --out a.png", "--path deform: nothing deforms in this chapter"},
        {"--set resolution", "--set resolution: KEY=VALUE is needed; --list names the keys"},
        {"--set colour=1", "--set colour=1: no such parameter; there are: " PARAMETERS},
        {"--set resolution=abc",
         "--set resolution=abc: a whole number from 8 to 512 voxels is needed where 'abc' stands"},
        {"--set resolution=8.5",
         "--set resolution=8.5: a whole number from 8 to 512 voxels is needed where '8.5' stands"},
        {"--set resolution=1024", "--set resolution=1024: out of range, 8 to 512 voxels"},
        {"--set resolution=",
         "--set resolution=: a whole number from 8 to 512 voxels is needed where '' stands"},
        {"--set alpha=nan", "--set alpha=nan: a number from 0 to 1 is needed where 'nan' stands"},
        {"--set alpha=0.5m", "--set alpha=0.5m: a number from 0 to 1 is needed where '0.5m' stands"},
        {"--set alpha=1e999", "--set alpha=1e999: a number from 0 to 1 is needed where '1e999' stands"},
        {"--set shift=1,2", "--set shift=1,2: three numbers are needed, as 1,2,3"},
        {"--set shift=0,b,0", "--set shift=0,b,0: a number from -1 to 1 m is needed where 'b' stands"},
        {"--set shift=0,0,2", "--set shift=0,0,2: out of range, -1 to 1 m"},
        {"--set method=exac", "--set method=exac: not one of: raster exact"},
        {"--json", "--json: goes with --plan only"},
        {"--sweep a.csv --out b.png", "--out: does not go with --sweep or --stability, which write tables"},
        {"--sweep a.csv --plan",
         "--plan: does not go with --sweep or --stability; give one setting by --set"},
        {"--sweep a.csv --stability a.csv", "--stability a.csv: --sweep goes to the same file"},
        {"--out a.exr --truth a.exr", "--truth a.exr: --out goes to the same file"},
        {"--window --truth t.exr", "--truth: does not go with --window; use --out beside it"},
        {"--sweep a.csv --frames 3", "--frames: with --sweep it needs --path"},
        {"--sweep a.csv --set method=raster --set resolution=99",
         "--sweep: --row, --set or --scene leaves no row of this chapter's sweep"},
        {"--sweep a.csv --row 4", "--sweep: --row, --set or --scene leaves no row of this chapter's sweep"},
        {"--stability a.csv --row 3",
         "--stability: --row, --set or --scene leaves no case of this chapter's table"},
        {"--row 0 --sweep a.csv", "--row 0: a whole number from 1 to 1000000 is needed"},
        {"--row 1", "--row: goes with --sweep or --stability only"},
        {"--row 1 --sweep a.csv --stability b.csv",
         "--row: names a row of --sweep or of --stability; give one of them"},
        {"--out a%s.png",
         "--out a%s.png: one %d or %04d stands for the frame's number, nothing else may follow a %"},
        {"--out a%d%n.png",
         "--out a%d%n.png: one %d or %04d stands for the frame's number, nothing else may follow a %"},
        {"--out a%0d.png",
         "--out a%0d.png: one %d or %04d stands for the frame's number, nothing else may follow a %"},
        {"--shaders nowhere --plan", "--shaders nowhere: no such folder"},
        {"--plan --size 8x8 --set eye=1,2,3 --set target=1,2,3",
         "--set eye, target: both are at 1,2,3; they must differ"},
        {"--plan --size 8x8 --set light_direction=0,0,0",
         "--set light_direction: 0,0,0 points nowhere; a vector with a length is needed"},
        {"--plan --size 8x8 --set light=1 --set light_position=1,2,3",
         "--set light_position: scene lit cannot take it: a directional light has no position (it has 2 "
         "lights)"},
        {"--plan --size 8x8 --set light=1 --set light_half_angle_deg=20",
         "--set light_half_angle_deg: scene lit cannot take it: only a spot light has a cone (it has 2 "
         "lights)"},
        {"--plan --size 8x8 --set light=2",
         "--set light: scene lit cannot take it: the scene has no such light (it has 2 lights)"},

    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
        char *error = text_format("99_fake: %s\n", wrong[i][1]);
        fake_expect(wrong[i][0], 2, error);
        free(error);
    }
}

Test(run, unknown_scene_lists_the_scenes)
{
    Outcome got = fake_command("--scene kitchen --out a.exr");
    cr_assert_eq(got.status, 2, "status %d", got.status);
    cr_assert(
        strstr(got.error, "--scene kitchen: no such scene; a file with its ending, or one of: lit dark "),
        "%s", got.error);
    cr_assert(strstr(got.error, " cornell"), "the built-in scenes are not listed: %s", got.error);
    cr_assert_eq(count_of(got.error, "\n"), 1, "not one line: %s", got.error);
}

Test(run, list_is_lines_of_fields_between_tabs)
{
    Outcome got = fake_done("--list");
    static const char *const lines[] = {"chapter\t99_fake\tFake\n",
                                        "default\tlit\ndefault\tdark\n",
                                        "scene\tlit\ta quad, a spot and a sun\n",
                                        "step\t2\tsecond\tthe shader's\n",
                                        "parameter\tmethod\traster exact\traster\thow\n",
                                        "parameter\tresolution\t8..512 voxels\t64\tvoxels a side\n",
                                        "parameter\tshift\tx,y,z -1..1 m\t0,0.25,0\ta vector\n",
                                        "parameter\teye\tx,y,z -1e+08..1e+08 m\tscene\t",
                                        "parameter\tlight\t0..1e+06\t0\t",
                                        "sweep\t2\tbrute\t-\tmethod=raster resolution=16\t-\n",
                                        "sweep\t3\tours\tlit\tmethod=exact shift=0,0,1\t8x4\n",
                                        "stability\t2\trough\tdark\tmethod=raster\t16x16\n"};
    for (size_t i = 0; i < sizeof lines / sizeof *lines; ++i)
        cr_expect(strstr(got.out, lines[i]), "no line '%s' in\n%s", lines[i], got.out);
    cr_assert_str_eq(got.trace, "", "work was begun");
}

Test(run, help_names_every_option_and_parameter)
{
    Outcome got = fake_done("--out nowhere/a.png --help");
    static const char *const words[] = {
        "--scene",  "--size",      "--step", "--set",  "--out",        "--window",  "--truth",
        "--sweep",  "--stability", "--plan", "--json", "--everything", "--shaders", "--list",
        "--frames", "--seed",      "--row",  "--path", "resolution",   "exposure",  "nothing real"};
    for (size_t i = 0; i < sizeof words / sizeof *words; ++i)
        cr_expect(strstr(got.out, words[i]), "no %s in\n%s", words[i], got.out);
}

Test(run, picture_is_written_top_row_first)
{
    Outcome got = fake_done("--size 8x4 --out a.exr --set resolution=9 --set resolution=12");
    cr_assert(strstr(got.trace, "setting - lit raster 12 0.5 0 8x4\nframe 0\n"), "%s", got.trace);
    cr_assert_eq(count_of(got.trace, "frame"), 1, "one frame is rendered: %s", got.trace);
    Image image = image_read("a.exr");
    cr_assert(image.width == 8 && image.height == 4, "%dx%d", image.width, image.height);
    for (int y = 0; y < 4; ++y) // the chapter numbers rows from the bottom
        cr_expect_eq(image.pixels[y * 8 * image.channels], (float)(3 - y), "row %d", y);
    cr_assert_eq(files_written(), 1, "a temporary file was left");
}

Test(run, value_that_is_not_finite_is_an_error_and_no_file)
{
    // Row 1 from the bottom is row 2 from the top of 4.
    fake_expect(
        "--size 8x4 --out a.exr --set fault=nan", 1,
        "99_fake: --out a.exr: 1 of 96 values are NaN or Inf, the first at pixel 2,2 from the top left\n");
    cr_assert_eq(files_written(), 0, "something was left");
}

Test(run, step_shows_its_picture_and_stops_what_follows)
{
    Outcome first = fake_done("--size 8x4 --out first.exr --step first --set method=exact"),
            second = fake_done("--size 8x4 --out second.exr --step 2");
    cr_assert_eq(count_of(first.trace, "draw"), 0, "a pass ran after the step");
    cr_assert_eq(count_of(second.trace, "draw"), 2, "the passes before the step ran");
    cr_assert_eq(image_read("first.exr").pixels[0], 3.0f, "the first step's picture: rows");
    cr_assert_eq(image_read("second.exr").pixels[1], 1.0f, "the second's: green by the shader");
    fake_expect("--size 8x4 --out a.exr --step second --set fault=step", 2,
                "99_fake: --step second: this setting does not come to it\n");
}

Test(run, frames_go_to_numbered_files_or_the_last_to_one)
{
    Outcome got = fake_done("--size 8x4 --frames 3 --out a%02d.exr");
    cr_assert_eq(count_of(got.trace, "frame"), 3, "%s", got.trace);
    cr_assert(there("a00.exr") && there("a01.exr") && there("a02.exr") && files_written() == 3,
              "three files");
    fake_done("--size 8x4 --frames 3 --out last.exr");
    cr_assert(there("last.exr") && files_written() == 4, "one more");
}

Test(run, path_moves_camera_or_light_and_nothing_else)
{
    Outcome still = fake_done("--size 8x8 --frames 2 --out a.exr"),
            pixel = fake_done("--size 8x8 --frames 9 --path subpixel --out a.exr");
    Outcome orbit = fake_done("--size 8x8 --frames 2 --path orbit --out a.exr"),
            light = fake_done("--size 8x8 --frames 46 --path light --out a.exr");
    const char *eye = "eye 0.0000 1.0000 4.0000 target 0.0000 0.0000 0.0000";
    cr_assert_eq(count_of(still.trace, eye), 2, "%s", still.trace);
    // Frame 8 is one pixel to the right: at distance √17 and fov 0.5 a pixel is 2·√17·tan(0.25)/8 = 0.2632 m.
    cr_assert(strstr(pixel.trace, "eye 0.2632 "), "%s", pixel.trace);
    cr_assert_eq(count_of(pixel.trace, eye), 1, "only frame 0 stands still");
    cr_assert_eq(count_of(orbit.trace, eye), 1, "only frame 0 stands still");
    cr_assert_eq(count_of(orbit.trace, "target 0.0000 0.0000 0.0000"), 2, "an orbit keeps its target");
    // Frame 45 has turned by 90° about y through the box's centre, the origin: (0, 1, 2) goes to (2, 1, 0).
    cr_assert(strstr(light.trace, "light 2.0000 1.0000 0.0000"), "%s", light.trace);
    cr_assert_eq(count_of(light.trace, eye), 46, "the camera stands still");
}

Test(run, common_parameters_reach_the_scene)
{
    Outcome got =
        fake_done("--size 8x8 --out a.exr --seed 3 --set light_half_angle_deg=45 --set eye=0,0,1000");
    cr_assert(strstr(got.trace, "light 0.0000 3.0000 2.0000 cone 0.7854"), "seed and cone: %s", got.trace);
    cr_assert(strstr(got.trace, "eye 0.0000 0.0000 1000.0000 target 0.0000 0.0000 0.0000"), "%s", got.trace);
    // The far plane, 100 in the scene, now holds the whole quad (half diagonal √2).
    cr_assert(strstr(got.trace, "far 1001.41"), "%s", got.trace);
}

Test(run, no_display_and_no_wish_writes_a_picture_and_says_so)
{
    fake_expect(
        "--size 8x4", 0,
        "99_fake: note: no display: the picture goes to out/99_fake.png; --help lists what else there is\n");
    cr_assert(there("out/99_fake.png"), "it is there");
}

Test(run, unwritable_output_is_found_before_the_work)
{
    static const char *const lines[] = {"--out nowhere/a.png", "--truth nowhere/a.exr",
                                        "--sweep nowhere/a.csv", "--stability nowhere/a.csv", "--out ."};
    for (size_t i = 0; i < sizeof lines / sizeof *lines; ++i) {
        Outcome got = fake_command(lines[i]);
        cr_expect(got.status != 0 && count_of(got.error, "\n") == 1, "'%s': %d, %s", lines[i], got.status,
                  got.error);
        cr_expect(strstr(got.error, strchr(lines[i], ' ') + 1), "the path is not named: %s", got.error);
        cr_expect_eq(count_of(got.trace, "setting"), 0, "work was begun");
    }
    cr_assert_eq(fake_command("--out a.jpg").status, 2,
                 "an ending that is neither .exr nor .png is a wrong request");
    cr_assert_eq(files_written(), 0, "something was left");
}

Test(run, truth_is_written_or_missed)
{
    Outcome got = fake_done("--size 8x4 --frames 2 --truth t.exr");
    cr_assert(strstr(got.trace, "truth 1\n") && count_of(got.trace, "truth ") == 1,
              "asked once, in the last frame: %s", got.trace);
    cr_assert_eq(image_read("t.exr").pixels[0], 2.0f, "what the chapter gave");
    fake_offers_truth = false;
    fake_expect("--size 8x4 --truth u.exr", 1,
                "99_fake: --truth u.exr: this setting has no truth, nothing was written\n");
    cr_assert(!there("u.exr"), "nothing is written");
}

Test(run, shaders_of_a_student_are_taken_first)
{
    cr_assert_eq(mkdir("mine", 0777), 0, "a folder");
    file_put("mine/fake.frag", "out vec4 color;\nvoid main() { color = vec4(0, 7, 0, 1); }\n");
    file_put(
        "mine/fake.vert",
        "void main() { gl_Position = vec4(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1, 0, 1); }\n");
    file_put("mine/fake.comp", "layout(local_size_x = 8) in;\nvoid main() {}\n");
    fake_done("--size 8x4 --out a.exr --step second --shaders mine");
    cr_assert_eq(image_read("a.exr").pixels[1], 7.0f, "the shader in mine/");
}
