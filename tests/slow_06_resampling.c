// 06 resampling, on all scenes of the chapter: a volume from the light's map differs from the truth beside true borders of shadow alone.
#include "vsv_boundaries.h"

Test(slow_vsv_resampling, differs_at_borders_alone_fence)
{
    boundaries_check_scene("fence", 1024, 11, 1e-5, 0.2);
}
Test(slow_vsv_resampling, differs_at_borders_alone_toroid)
{
    boundaries_check_scene("toroid", 1024, 67, 1e-5, 0.2);
}
Test(slow_vsv_resampling, differs_at_borders_alone_colonnade)
{
    boundaries_check_scene("colonnade", 1024, 67, 1e-5, 0.2);
}
Test(slow_vsv_resampling, differs_at_borders_alone_forest)
{
    boundaries_check_scene("forest", 1024, 131, 1e-5, 0.2);
}
// The cone of its spot holds so few rows of this grid that none of their voxels may differ.
Test(slow_vsv_resampling, differs_at_borders_alone_bunny)
{
    boundaries_check_scene("bunny", 1024, 5, -1, 0.2);
}
Test(slow_vsv_resampling, differs_at_borders_alone_cell24)
{
    boundaries_check_scene("cell24", 1024, 67, 1e-5, 0.2);
}
Test(slow_vsv_resampling, differs_at_borders_alone_crowd)
{
    boundaries_check_scene("crowd", 1024, 251, 1e-5, 0.2);
}
