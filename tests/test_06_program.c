// 06 epipolar voxelized shadow volumes: the program as a user runs it: what is left out and that it changes nothing, what is built again, wrong requests.
#define PROGRAM "06_epipolar_vsv --size 24x24 --set map=64 --set alpha=64 --set theta=64 --set phi=128"
#include "program_plan.h"

// "12 of 34 left out"
static double left_out(const char *plan, const char *pass)
{
    const char *line = line_of(plan, pass);
    double ms, skipped;
    cr_assert(line && sscanf(line + strlen(pass), " yes %lf %lf of", &ms, &skipped) == 2,
              "%s: nothing left out in\n%s", pass, plan);
    return skipped;
}

static const char *const volume_passes[] = {"range", "clear", "voxels", "scan", NULL};
static const char *const building[] = {"clear", "voxels", "scan", NULL};

// Blocks and shadow lie behind the eye and lead away from it; where it turns round they are in view.
Test(epipolar_program, voxels_where_nothing_can_cast_into_the_view)
{
    plans_free(check_left_out(
        "--scene stage --set light_position=0,1,20 --set eye=0,1,30 --set target=0,1,60",
        "--scene stage --set light_position=0,1,20 --set eye=0,1,30 --set target=0,1,0", volume_passes));
}
Test(epipolar_program, a_medium_that_scatters_nothing)
{
    plans_free(check_left_out("--scene stage --set scattering=0,0,0",
                              "--scene stage --set scattering=0,0,1e-3", volume_passes));
}
// The eye sees what the light sees, until they are as far apart as a pixel of the nearest surface.
Test(epipolar_program, a_light_at_the_eye)
{
    plans_free(check_left_out("--scene stage --set light_position=0.3,1.2,3.5",
                              "--scene stage --set light_position=0.3,2.2,3.5", building));
    Outcome near = program("--scene stage --set light_position=0.3,1.21,3.5"),
            far = program("--scene stage --set light_position=0.3,1.6,3.5");
    cr_assert(!ran(near.text, "voxels") && ran(far.text, "voxels"), "%s\n%s", near.text, far.text);
    outcome_free(&near);
    outcome_free(&far);
}

// Brute force asks the map also where nothing casts: left undrawn, it would say that all is dark. Of a lamp straight ahead the picture's diagonals lie between two
// faces of its map, and belong to one of them.
Test(epipolar_program, brute_force_where_nothing_casts)
{
    Outcome runs = program("--scene mist --step airlight --set light_position=0,0,-3");
    static const char *const methods[] = {"equiangular --set steps=256", "segments"};
    for (int i = 0; i < 2; i++) {
        char *arguments = text_format(
            "--scene mist --step airlight --set light_position=0,0,-3 --set method=%s", methods[i]);
        Outcome brute = program(arguments);
        const ImageError error = image_compare(&brute.picture, &runs.picture);
        cr_expect(error.nrmse < 0.01, "%s: %g", methods[i], error.nrmse);
        outcome_free(&brute);
        free(arguments);
    }
    outcome_free(&runs);
}

// Word columns that nothing shades are not scanned; rows that are lit or dark throughout, and words behind a ray's end, are not fetched.
Test(epipolar_program, empty_rows_and_words_behind_the_end)
{
    Plans plans = check_left_out("--scene stage", "--scene stage --set light_position=0.9,1.6,-2.5", NULL);
    cr_assert(left_out(plans.fires, "scan") > 0, "%s", plans.fires);
    cr_assert(count(plans.fires, "airlight", "lookups=") < 0.8 * count(plans.all, "airlight", "lookups="),
              "%s\n%s", plans.fires, plans.all);
    plans_free(plans);
    plans = check_left_out("--scene stage --set integral=riemann",
                           "--scene stage --set integral=riemann --set light_position=0.9,1.6,-2.5", NULL);
    cr_assert(count(plans.fires, "airlight", "lookups=") < count(plans.all, "airlight", "lookups="), "%s\n%s",
              plans.fires, plans.all);
    plans_free(plans);
    plans = check_left_out("--scene stage --set integral=sparse",
                           "--scene stage --set integral=sparse --set light_position=0.9,1.6,-2.5", NULL);
    cr_assert(count(plans.fires, "airlight", "lookups=") < count(plans.all, "airlight", "lookups="), "%s\n%s",
              plans.fires, plans.all);
    plans_free(plans);
}

// A light beside the picture: most planes through it and the eye miss the picture. At the picture's centre none does.
Test(epipolar_program, slices_off_screen)
{
    Outcome beside = program("--scene stage --set eye=0.3,1.2,-1.9 --set target=-3,1,-1.9"),
            centre = program("--scene stage --set target=0.8,1.6,-2.2");
    cr_assert(left_out(beside.text, "range") > 64, "%s", beside.text);
    const char *line = line_of(centre.text, "range");
    cr_assert(strstr(line, " 0 of 64 left out"), "%s", centre.text);
    outcome_free(&beside);
    outcome_free(&centre);
}

Test(epipolar_program, what_has_not_changed_is_not_built_again)
{
    const struct {
        const char *frames;
        bool volume, shape;
    } cases[] = {
        {"--scene stage --frames 2", false, false},
        {"--scene stage --frames 2 --path orbit", true, false},
        {"--scene stage --frames 2 --path light", true, false},
        {"--scene cell24 --frames 2 --path deform", true, true},
    };
    static const char *const passes[] = {"depth maps", "G-buffer", "range",   "clear",
                                         "voxels",     "scan",     "airlight"};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        Outcome outcome = program(cases[i].frames);
        cr_assert_eq(outcome.status, 0, "%s", outcome.text);
        for (size_t k = 0; k < sizeof passes / sizeof *passes; k++)
            cr_assert_eq(ran(outcome.text, passes[k]), cases[i].volume, "%s: %s", cases[i].frames, passes[k]);
        outcome_free(&outcome);
    }
}

static void check_refused(const char *arguments, const char *says)
{
    Outcome outcome = program(arguments);
    cr_assert_eq(outcome.status, 2, "%s", outcome.text);
    cr_assert(strstr(outcome.text, says) && strchr(outcome.text, '\n') == strrchr(outcome.text, '\n'), "%s",
              outcome.text);
    outcome_free(&outcome);
}
Test(epipolar_program, wrong_requests)
{
    check_refused("--scene stage --set texture=window", "integral=runs knows no texture");
    check_refused("--scene stage --set texture=window --set method=march", "method=march: knows no texture");
    check_refused("--scene stage_sun --set shape=paraboloid", "maps of all directions");
    check_refused("--scene fence --set method=solid", "needs closed meshes");
    check_refused("--scene stage --path deform", "keeps its shape");
}

// Every step has its picture, for volumes and for brute force.
Test(epipolar_program, every_step_shows)
{
    static const char *const steps[] = {"map",      "voxels",   "scanned", "counts",
                                        "surfaces", "airlight", "picture"};
    for (size_t i = 0; i < sizeof steps / sizeof *steps; i++) {
        char *arguments = text_format("--scene stage --step %s", steps[i]);
        Outcome outcome = program(arguments);
        cr_assert_eq(outcome.status, 0, "%s", outcome.text);
        double sum = 0;
        for (int k = 0; k < 24 * 24; k++)
            sum += (double)outcome.picture.pixels[k * outcome.picture.channels];
        cr_assert(sum > 1.0, "%s is black", steps[i]);
        outcome_free(&outcome);
        free(arguments);
    }
}
