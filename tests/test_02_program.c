// 02 shadow maps: the program as a user runs it: the same picture with nothing left out, and what a frame builds again. A program start takes half a
// second, so what more there is to ask stands in slow_02_program.c.
#include "shadow_plan.h"

// Inside a ball about the light, along the edge of two faces: they alone are asked, or those above and below as well.
Test(shadow_program, faces_without_a_receiver_are_left_out)
{
    const char *narrow = "--scene edge --step filter --set resolution=128 --set fov_deg=60";
    CHECK_EVERYTHING(narrow, "depth map", "casters");
    cr_assert_eq(
        left_out_by("--scene edge --step filter --set resolution=128 --set fov_deg=160", "depth map"), 2);
}
// All of that view lies before the lamp's half space z > 0; of the other half neither distances nor moments are needed.
Test(shadow_program, a_half_without_a_receiver_is_left_out)
{
    CHECK_EVERYTHING("--scene edge --step filter --set resolution=128 --set fov_deg=40 --set map=paraboloid "
                     "--set filter=variance",
                     "depth map", "moments");
}
Test(shadow_program, casters_outside_the_hull_are_left_out)
{
    CHECK_EVERYTHING("--scene fence --step filter --set resolution=256 --set fov_deg=12", "casters");
}
// The plate's shadow ends at 2 m: a view of the floor beside it does not need the plate, a view across the border does.
Test(shadow_program, a_caster_counts_from_the_border_of_its_shadow_on)
{
    const char *at =
        "--scene plate --step filter --set filter=nearest --set resolution=256 --set fov_deg=1 --set target=";
    char *beside = text_format("%s3.2,0,3.2", at), *across = text_format("%s2,0,2", at);
    const double few = left_out_by(beside, "casters"), more = left_out_by(across, "casters");
    cr_assert(few >= 2 && more < few, "%g casters left out beside the shadow, %g on its border", few, more);
    free(beside);
    free(across);
}
Test(shadow_program, a_light_that_reaches_no_pixel_asks_for_nothing)
{
    CHECK_EVERYTHING(
        "--scene plate --step filter --set filter=variance --set resolution=64 --set light_direction=0,1,0",
        "depth map", "moments", "filter: ask");
}
// Of three lights the reflective map of one is shown; the bounce reads all three.
Test(shadow_program, the_reflective_map_is_drawn_where_it_is_read)
{
    const char *scene = "--scene chapters/02_shadow_maps/lamps.gltf --set reflective_resolution=16 --set "
                        "resolution=64 --set samples=1";
    char *one = text_format("%s --step reflective", scene);
    CHECK_EVERYTHING(one, "reflective map");
    char *all = plan_of(scene, NULL);
    cr_assert_eq(primitives(all, "reflective map"), 8 * 90, "%s",
                 all); // a spot's, a sun's and six of a cube, of 90 triangles
    free(one);
    free(all);
}
Test(shadow_program, what_has_not_changed_is_not_drawn_again)
{
    static const Dependency cases[] = {
        {"--scene plate --frames 2", false, false, false},
        {"--scene plate --frames 2 --path light --set light_position=0.5,4,0", true, true, true},
        {"--scene plate --frames 2 --path deform", true, true, true},
        {"--scene grazing --frames 2 --path deform", false, false, false}, // flat: it does not lean
        {"--scene plate --frames 2 --path subpixel", false, true, false},
    };
    check_dependencies(cases, sizeof cases / sizeof *cases);
}
