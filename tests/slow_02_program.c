// 02 shadow maps, slow: more of what test_02_program.c asks, each case a program start or more; the stability table.
#include "shadow_plan.h"
#include "stability_table.h"

#include <math.h>

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

// Just beyond each rule: what would be left out shows in the picture.
static Image picture_of(const char *arguments)
{
    char *path = text_format("/tmp/shadow-beyond-%d.exr", (int)getpid());
    free(plan_of(arguments, path));
    Image picture = image_read(path);
    unlink(path);
    free(path);
    return picture;
}
static float extreme(const Image *picture, float sign) // the largest value, or with −1 the smallest
{
    float found = -INFINITY;
    for (int i = 0; i < picture->width * picture->height * picture->channels; i++)
        found = fmaxf(found, sign * picture->pixels[i]);
    return sign * found;
}
static long different(const char *one, const char *other)
{
    Image a = picture_of(one), b = picture_of(other);
    long count = 0;
    for (int i = 0; i < a.width * a.height * a.channels; i++)
        count += a.pixels[i] != b.pixels[i];
    image_free(&a);
    image_free(&b);
    return count;
}
Test(slow_shadow_program, beyond_its_rule_a_caster_darkens_pixels)
{
    const char *at =
        "--scene plate --step filter --set filter=nearest --set resolution=256 --set fov_deg=1 --set "
        "show=visibility --set target=";
    char *beside = text_format("%s3.2,0,3.2", at), *across = text_format("%s2,0,2", at);
    Image lit = picture_of(beside), border = picture_of(across);
    cr_assert(extreme(&lit, -1) > extreme(&border, -1), "beside the shadow %g, on its border %g",
              (double)extreme(&lit, -1), (double)extreme(&border, -1));
    image_free(&lit);
    image_free(&border);
    free(beside);
    free(across);
}
Test(slow_shadow_program, beyond_its_rule_a_light_reaches_pixels)
{
    const char *at =
        "--scene plate --step filter --set filter=variance --set resolution=64 --set light_direction=";
    char *away = text_format("%s0,1,0", at), *grazing = text_format("%s1,0,0", at);
    Image dark = picture_of(away), lit = picture_of(grazing);
    cr_assert(extreme(&dark, 1) == 0 && extreme(&lit, 1) > 0, "away %g, grazing %g",
              (double)extreme(&dark, 1), (double)extreme(&lit, 1));
    image_free(&dark);
    image_free(&lit);
    free(away);
    free(grazing);
}
Test(slow_shadow_program, beyond_its_rule_a_reflective_map_gives_light)
{
    cr_assert_gt(different("--scene cornell --step filter", "--scene cornell --step bounce --set samples=16"),
                 1000, "without the reflective map the bounce is direct light");
}
Test(slow_shadow_program, beyond_their_rule_old_maps_are_wrong)
{
    const char *const moves[] = {"light", "deform"};
    for (int i = 0; i < 2; i++) {
        char *first =
                 text_format("--scene plate --step filter --set show=visibility --set light_position=0.5,4,0 "
                             "--path %s --frames 1",
                             moves[i]),
             *tenth =
                 text_format("--scene plate --step filter --set show=visibility --set light_position=0.5,4,0 "
                             "--path %s --frames 10",
                             moves[i]);
        cr_assert_gt(different(first, tenth), 0, "--path %s: the tenth frame's visibilities are the first's",
                     moves[i]);
        free(first);
        free(tenth);
    }
}
