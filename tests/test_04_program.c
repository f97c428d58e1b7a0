// 04 airlight: the program as a user runs it: what is left out and that it changes nothing, what is built again, the stability table.
#define PROGRAM "04_airlight --size 24x24 --set map=64 --set steps=16"
#include "program_plan.h"

static const char *const airlight_pass[] = {"airlight", NULL},
                         *const attenuation_pass[] = {"attenuation", NULL},
                         *const maps_pass[] = {"depth maps", NULL};

Test(airlight_program, a_medium_that_scatters_nothing)
{
    plans_free(check_left_out("--scene blocks --set scattering=0,0,0",
                              "--scene blocks --set scattering=0,0,1e-4", airlight_pass));
}
Test(airlight_program, a_medium_that_takes_nothing)
{
    plans_free(check_left_out("--scene blocks --set scattering=0,0,0 --set absorption=0,0,0",
                              "--scene blocks --set scattering=0,0,0 --set absorption=1e-4,0,0",
                              attenuation_pass));
}
// A uniform phase function, one exponential for three colours, samples behind the first surface: all at once with --everything.
Test(airlight_program, what_a_sample_does_not_need)
{
    plans_free(check_left_out(
        "--scene blocks --set method=march",
        "--scene blocks --set method=march --set phase=henyey_greenstein --set mean_cosine=0.01", NULL));
}

// Rays beside a spot's cone: most of the picture, none where the cone is wide.
Test(airlight_program, rays_beside_the_cone)
{
    Plans plans = check_left_out(
        "--scene beam", "--scene beam --set light_half_angle_deg=89 --set light_direction=0,0,-1", NULL);
    const double narrow = atof(strstr(line_of(plans.fires, "airlight"), "yes") + 14);
    cr_assert(strstr(line_of(plans.fires, "airlight"), "of 576 left out") && narrow > 200, "%s", plans.fires);
    cr_assert(strstr(line_of(plans.beyond, "airlight"), " 0 of 576 left out"), "%s", plans.beyond);
    plans_free(plans);
}

// Away from the block and its shadow there is nothing to look up; where the shadow comes into view there is.
Test(airlight_program, lookups_where_nothing_can_cast)
{
    Plans plans =
        check_left_out("--scene blocks --set show=airlight --set eye=3,0,0 --set target=4,0,0",
                       "--scene blocks --set show=airlight --set eye=-3,0,0 --set target=-4,0,0", maps_pass);
    cr_assert_eq(count(plans.fires, "airlight", "lookups="), 0.0, "%s", plans.fires);
    cr_assert_eq(count(plans.beyond, "airlight", "lookups="), 24.0 * 24 * 16, "%s", plans.beyond);
    plans_free(plans);
}

Test(airlight_program, what_has_not_changed_is_not_built_again)
{
    const struct {
        const char *frames;
        bool map, gbuffer, airlight;
    } cases[] = {
        {"--scene blocks --frames 2", false, false, false},
        {"--scene blocks --frames 2 --path orbit", false, true, true},
        {"--scene blocks --frames 2 --path light", true, false, true},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        Outcome outcome = program(cases[i].frames);
        cr_assert_eq(ran(outcome.text, "depth maps"), cases[i].map, "%s: depth maps", cases[i].frames);
        cr_assert_eq(ran(outcome.text, "G-buffer"), cases[i].gbuffer, "%s: G-buffer", cases[i].frames);
        cr_assert_eq(ran(outcome.text, "airlight"), cases[i].airlight, "%s: airlight", cases[i].frames);
        outcome_free(&outcome);
    }
}

// What is shown alone is what was added.
Test(airlight_program, the_picture_is_surfaces_and_airlight)
{
    Outcome all = program("--scene blocks"), dim = program("--scene blocks --step attenuation"),
            glow = program("--scene blocks --set show=airlight");
    cr_assert(all.picture.pixels && dim.picture.pixels && glow.picture.pixels, "%s\n%s\n%s", all.text,
              dim.text, glow.text);
    for (int i = 0; i < 24 * 24 * all.picture.channels; i++)
        if (i % all.picture.channels < 3)
            cr_assert_eq(all.picture.pixels[i], dim.picture.pixels[i] + glow.picture.pixels[i], "value %d",
                         i);
    outcome_free(&all);
    outcome_free(&dim);
    outcome_free(&glow);
}

// The picture's relative error (of 64² texels, 16 samples) against the truth.
static double error_of(const char *arguments)
{
    char *truth = text_format("/tmp/airlight-truth-%d.exr", (int)getpid()),
         *all = text_format("--set show=airlight --truth %s %s", truth, arguments);
    Outcome got = program(all);
    cr_assert_eq(got.status, 0, "%s: %s", arguments, got.text);
    Image expected = image_read(truth);
    const double error = image_compare(&got.picture, &expected).nrmse;
    unlink(truth);
    image_free(&expected);
    outcome_free(&got);
    free(all);
    free(truth);
    return error;
}
// A light that moves takes its map with it, and its place where no map is drawn. Maps of 64² texels: a hundredth.
Test(airlight_program, a_light_that_moves_is_where_the_truth_has_it)
{
    cr_assert_lt(error_of("--scene two_lights --set method=segments --frames 9 --path light"), 2e-2);
    cr_assert_lt(error_of("--scene haze --set method=segments --frames 9 --path light"), 1e-4);
    cr_assert_lt(error_of("--scene sun --set method=segments --frames 9 --path light"), 1e-4);
}
// With exact visibility, what integrates exactly is the truth (8 nodes: 5e-5; float32); what samples keeps its own error, and a closed form loses that of its shadows.
Test(airlight_program, an_exact_map_leaves_the_integrals_error)
{
    const double segments = error_of("--scene two_lights --set method=segments"),
                 exact = error_of("--scene two_lights --set method=segments --set oracle=map");
    cr_assert(segments > 5e-3 && exact < 1e-4, "segments: %g with the map, %g without", segments, exact);
    const double summed =
        error_of("--scene two_lights --set method=segments --set variant=signed --set oracle=map");
    cr_assert(summed < 1e-3 && summed != exact, "signed: %g", summed);
    const double march = error_of("--scene blocks --set method=march --set oracle=map");
    cr_assert_gt(march, 1e-2);
    const double lit = error_of("--scene blocks --set method=gauss --set oracle=map");
    cr_assert_lt(lit, 1e-4, "gauss over the lit stretches: %g", lit);
}
Test(airlight_program, an_exact_map_follows_eye_light_and_sun)
{
    cr_assert_lt(error_of("--scene blocks --set method=segments --set oracle=map --frames 2 --path orbit"),
                 1e-4);
    cr_assert_lt(error_of("--scene blocks --set method=segments --set oracle=map --frames 2 --path light"),
                 1e-4);
    cr_assert_lt(error_of("--scene colonnade --set method=segments --set oracle=map"),
                 2e-3); // edges of the G-buffer's pixels
    Outcome plan = program("--scene blocks --set show=airlight --set oracle=map");
    cr_assert(!ran(plan.text, "depth maps") && strstr(plan.text, "oracle=map stands for them"), "%s",
              plan.text);
    outcome_free(&plan);
}
// What no sampling leaves of a method's error is the map's, so of all methods the same picture; of a closed form, what it does without shadow.
Test(airlight_program, an_exact_integral_leaves_the_maps_error)
{
    Outcome segments = program("--scene blocks --set method=segments --set nodes=24"),
            gauss = program("--scene blocks --set method=gauss --set nodes=24");
    const char *const methods[] = {"march", "sun"};
    for (size_t i = 0; i < 2; i++) {
        char *plain = text_format("--scene blocks --set method=%s", methods[i]),
             *exact = text_format("%s --set oracle=quadrature", plain);
        Outcome before = program(plain), after = program(exact);
        cr_assert_eq(image_compare(&after.picture, i < 1 ? &segments.picture : &gauss.picture).max_abs, 0.0,
                     "%s", methods[i]);
        cr_assert_gt(image_compare(&after.picture, &before.picture).max_abs, 0.0, "%s", methods[i]);
        outcome_free(&before);
        outcome_free(&after);
        free(plain);
        free(exact);
    }
    outcome_free(&segments);
    outcome_free(&gauss);
}

Test(airlight_program, closed_forms_for_one_phase_function_alone)
{
    Outcome refused = program("--scene haze --set method=sun --set phase=rayleigh");
    cr_assert_eq(refused.status, 2);
    cr_assert(strstr(refused.text, "holds for phase=uniform alone"), "%s", refused.text);
    free(refused.text);
}
