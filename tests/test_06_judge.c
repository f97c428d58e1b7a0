// 06 judge: rows of the stability table that are soon run; slow_06_epipolar_vsv runs all of it.
#include "stability_table.h"

Test(vsv_judge, a_light_in_the_picture_passes)
{
    check_stability_table("06_epipolar_vsv", "--row 1", 2);
}
Test(vsv_judge, the_scale_of_the_world_does_not_matter)
{
    check_stability_table("06_epipolar_vsv", "--row 25", 2);
}
