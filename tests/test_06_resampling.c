// 06 resampling: a volume from the light's map differs from the truth beside true borders of shadow alone. slow_06_resampling asks all scenes.
#include "vsv_boundaries.h"

Test(vsv_resampling, differs_at_borders_alone_on_the_stage)
{
    boundaries_check_scene("stage", 256, 23, 1e-4, 0.02);
}
Test(vsv_resampling, differs_at_borders_alone_with_a_coarse_map)
{
    boundaries_check_scene("stage", 48, 23, 1e-4, 0.05);
}
Test(vsv_resampling, differs_at_borders_alone_in_the_sun)
{
    boundaries_check_scene("stage_sun", 256, 23, 1e-4, 0.02);
}
Test(vsv_resampling, differs_at_borders_alone_around_a_lamp_in_a_box)
{
    boundaries_check_scene("in_one_box", 256, 23, 1e-4, 0.02);
}
