// 02 shadow maps: the program as a user runs it: the same picture with nothing left out, what a frame builds again, the stability table.
#include "image.h"

#include <criterion/criterion.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// What the program's plan says of its last frame; the picture stays in `picture` where that is given.
static char *plan_of(const char *arguments, const char *picture)
{
    const char *build = getenv("BUILD");
    char *out = text_format("/tmp/shadow-%d", (int)getpid()), *own = text_format("%s.exr", out);
    char *command = text_format("%s/02_shadow_maps --out %s --size 48x40 --plan %s >%s 2>&1",
                                build ? build : "build", picture ? picture : own, arguments, out);
    int status = system(command);
    char *plan = file_read(out, NULL);
    cr_assert_eq(status, 0, "%s: %s", command, plan);
    unlink(out);
    unlink(own);
    free(command);
    free(out);
    free(own);
    return plan;
}

// The plan's line of this pass, or NULL.
static const char *line_of(const char *plan, const char *pass)
{
    const size_t length = strlen(pass);
    const char *line = plan;
    while (line && !(strncmp(line, pass, length) == 0 && strncmp(line + length, "  ", 2) == 0))
        line = strchr(line, '\n') ? strchr(line, '\n') + 1 : NULL;
    return line;
}
static bool ran(const char *plan, const char *pass)
{
    const char *line = line_of(plan, pass);
    char word[8] = "";
    cr_assert(line, "no pass '%s' in\n%s", pass, plan);
    sscanf(line + strlen(pass), "%7s", word);
    return strcmp(word, "yes") == 0;
}
// "… 3 of 6 left out": the 3.
static double left_out(const char *plan, const char *pass)
{
    const char *line = line_of(plan, pass), *end = line ? strchr(line, '\n') : NULL;
    cr_assert(line && end, "no pass '%s' in\n%s", pass, plan);
    for (const char *at = line; at < end; at++) {
        double skipped, of;
        if (sscanf(at, "%lf of %lf left out", &skipped, &of) == 2 && at[-1] == ' ')
            return skipped;
    }
    return -1;
}

// With and without --everything: the same numbers; `pass` leaves something out, and does not under --everything.
static void check_everything(const char *arguments, const char *pass)
{
    char *less = text_format("/tmp/less-%d.exr", (int)getpid()),
         *all = text_format("/tmp/all-%d.exr", (int)getpid());
    char *everything = text_format("%s --everything", arguments);
    char *plan = plan_of(arguments, less), *whole = plan_of(everything, all);
    cr_assert(!ran(plan, pass) || left_out(plan, pass) > 0, "%s: %s leaves out nothing\n%s", arguments, pass,
              plan);
    cr_assert(ran(whole, pass), "%s: %s does not run under --everything\n%s", arguments, pass, whole);
    if (ran(plan, pass))
        cr_assert(strcmp(pass, "casters") != 0 || left_out(whole, pass) == 0, "%s", whole);
    Image a = image_read(less), b = image_read(all);
    cr_assert(memcmp(a.pixels, b.pixels, sizeof(float) * (size_t)(a.width * a.height * a.channels)) == 0,
              "%s: the pictures differ", arguments);
    image_free(&a);
    image_free(&b);
    unlink(less);
    unlink(all);
    free(plan);
    free(whole);
    free(everything);
    free(less);
    free(all);
}
Test(shadow_program, faces_without_a_receiver_are_left_out)
{
    check_everything("--scene bunny --step point --set resolution=256", "depth map");
}
Test(shadow_program, casters_outside_the_hull_are_left_out)
{
    check_everything("--scene fence --step filter --set resolution=256 --set fov_deg=12", "casters");
    check_everything(
        "--scene fence --step sun --set resolution=256 --set fov_deg=12 --set fit=scene --set bias=normal",
        "casters");
    check_everything(
        "--scene cornell --step filter --set resolution=256 --set fov_deg=9 --set filter=variance",
        "casters");
}
// The same scene with a view that needs them all.
Test(shadow_program, a_whole_view_needs_every_caster)
{
    char *plan = plan_of("--scene bunny --step filter --set resolution=256", NULL);
    cr_assert_eq(left_out(plan, "casters"), 0, "%s", plan);
    free(plan);
}
// Inside a ball about the light, along the edge of two faces: they alone, or those above and below as well.
Test(shadow_program, a_wider_view_needs_more_faces)
{
    char *narrow = plan_of("--scene edge --step filter --set resolution=256 --set fov_deg=60", NULL);
    char *wide = plan_of("--scene edge --step filter --set resolution=256 --set fov_deg=160", NULL);
    cr_assert_eq(left_out(narrow, "depth map"), 4, "%s", narrow);
    cr_assert_eq(left_out(wide, "depth map"), 2, "%s", wide);
    free(narrow);
    free(wide);
}
Test(shadow_program, a_light_that_reaches_no_pixel_asks_for_nothing)
{
    const char *away = "--scene plate --step filter --set resolution=64 --set light_direction=0,1,0";
    check_everything(away, "depth map");
    check_everything(away, "filter: ask");
    char *plan = plan_of("--scene plate --step filter --set resolution=64 --set light_direction=1,0,0",
                         NULL); // its cone touches the floor
    cr_assert(ran(plan, "depth map") && ran(plan, "filter: ask"), "%s", plan);
    free(plan);
}
Test(shadow_program, the_reflective_map_is_drawn_where_it_is_read)
{
    check_everything("--scene plate --step bounce --set samples=4 --set reflective_resolution=16 --set "
                     "resolution=64 --frames 2",
                     "reflective map");
    char *plan =
        plan_of("--scene plate --set samples=4 --set reflective_resolution=16 --set resolution=64", NULL);
    cr_assert(ran(plan, "reflective map") && ran(plan, "gather"), "%s", plan);
    free(plan);
}

// Each dependency of a map by itself: the light, what is seen, how the map is fitted. (Casters never move.)
Test(shadow_program, what_has_not_changed_is_not_drawn_again)
{
    const struct {
        const char *arguments;
        bool map, ask, reflective;
    } cases[] = {
        {"--scene plate --frames 1", true, true, true},
        {"--scene plate --frames 2", false, false, false},
        {"--scene plate --frames 2 --path light --set light_position=0.5,4,0", true, true, true},
        {"--scene plate --frames 2 --path orbit", false, true, false}, // 2 degrees ask for the same tiles
        {"--scene plate --frames 2 --path orbit --set kind=directional", true, true, false},
        {"--scene plate --frames 2 --path subpixel", false, true, false},
        {"--scene plate --frames 2 --path subpixel --set kind=directional --set fit=view", true, true, false},
        {"--scene plate --frames 2 --path subpixel --set kind=directional --set fit=scene", false, true,
         false},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char *arguments = text_format("%s --set resolution=64 --set samples=4 --set reflective_resolution=16",
                                      cases[i].arguments);
        char *plan = plan_of(arguments, NULL);
        cr_expect_eq(ran(plan, "depth map"), cases[i].map, "%s: depth map\n%s", arguments, plan);
        cr_expect_eq(ran(plan, "bounce: ask"), cases[i].ask, "%s: ask\n%s", arguments, plan);
        cr_expect_eq(ran(plan, "reflective map"), cases[i].reflective, "%s: reflective map\n%s", arguments,
                     plan);
        free(plan);
        free(arguments);
    }
}

Test(shadow_program, the_stability_table_passes)
{
    const char *build = getenv("BUILD");
    char *path = text_format("/tmp/shadow-%d.csv", (int)getpid());
    char *command =
        text_format("%s/02_shadow_maps --stability %s 2>/dev/null", build ? build : "build", path);
    cr_assert_eq(system(command), 0, "%s fails", command);
    char *table = file_read(path, NULL);
    int passed = 0;
    for (const char *line = table; (line = strchr(line, '\n')) != NULL; line++)
        passed += line - table > 5 && strncmp(line - 5, ",pass", 5) == 0;
    cr_assert_eq(passed, 39, "%d checks pass", passed);
    unlink(path);
    free(path);
    free(command);
    free(table);
}
