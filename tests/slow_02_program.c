// 02 shadow maps, slow: more of what test_02_program.c asks, each case a program start or more; the stability table.
#include "shadow_plan.h"
#include "stability_table.h"

Test(slow_shadow_program, casters_outside_the_hull_are_left_out, .timeout = 120)
{
    CHECK_EVERYTHING("--scene fence --step sun --set resolution=256 --set fov_deg=12 --set fit=scene --set "
                     "bias=normal",
                     "casters");
    CHECK_EVERYTHING(
        "--scene cornell --step filter --set resolution=256 --set fov_deg=9 --set filter=variance",
        "casters");
    CHECK_EVERYTHING("--scene bunny --step point --set resolution=256", "depth map");
}
// Views that need every caster and every half.
Test(slow_shadow_program, a_whole_view_needs_all, .timeout = 120)
{
    cr_assert_eq(left_out_by("--scene bunny --step filter --set resolution=256", "casters"), 0);
    cr_assert_eq(
        left_out_by("--scene edge --step filter --set resolution=128 --set fov_deg=160 --set map=paraboloid",
                    "depth map"),
        0);
}
Test(slow_shadow_program, pictures_of_a_second_frame_are_the_same, .timeout = 120)
{
    CHECK_EVERYTHING(
        "--scene plate --set samples=4 --set reflective_resolution=16 --set resolution=64 --frames 2",
        "reflective map", "depth map", "gather");
    // A swaying scene under --everything: what was kept was right.
    CHECK_EVERYTHING("--scene grazing --set samples=4 --set reflective_resolution=16 --set resolution=64 "
                     "--frames 2 --path deform",
                     "reflective map", "depth map", "gather");
}
// What is seen, and how the map is fitted.
Test(slow_shadow_program, what_has_not_changed_is_not_drawn_again, .timeout = 120)
{
    static const Dependency cases[] = {
        {"--scene plate --frames 1", true, true, true},
        {"--scene plate --frames 2 --path orbit", false, true, false}, // 2 degrees ask for the same tiles
        {"--scene plate --frames 2 --path orbit --set kind=directional", true, true, false},
        {"--scene plate --frames 2 --path subpixel --set kind=directional --set fit=view", true, true, false},
        {"--scene plate --frames 2 --path subpixel --set kind=directional --set fit=scene", false, true,
         false},
    };
    check_dependencies(cases, sizeof cases / sizeof *cases);
}
Test(slow_shadow_program, the_stability_table_passes, .timeout = 120)
{
    check_stability_table("02_shadow_maps", "", 47);
}
Test(slow_shadow_program, a_light_that_grazes_the_picture_asks_for_all)
{
    char *plan = plan_of(
        "--scene plate --step filter --set filter=variance --set resolution=64 --set light_direction=1,0,0",
        NULL); // its cone touches the floor
    cr_assert(ran(plan, "depth map") && ran(plan, "moments") && ran(plan, "filter: ask"), "%s", plan);
    free(plan);
}
Test(slow_shadow_program, faces_and_casters_of_views_on_borders_change_no_pixel, .timeout = 120)
{
    CHECK_EVERYTHING("--scene edge --step filter --set resolution=128 --set fov_deg=160", "depth map");
    CHECK_EVERYTHING("--scene plate --step filter --set filter=nearest --set resolution=256 --set fov_deg=1 "
                     "--set target=3.2,0,3.2",
                     "casters");
}
