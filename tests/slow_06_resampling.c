// 06 resampling, on all scenes of the chapter: a volume from the light's map differs from the truth beside true borders of shadow alone.
#include "../chapters/06_epipolar_vsv/vsv_scenes.h"
#include "vsv_boundaries.h"

#include <string.h>

static Scene *open_scene(const char *name)
{
    for (const SceneKind *kind = vsv_scenes; kind->name; kind++)
        if (strcmp(kind->name, name) == 0)
            return scene_from(kind, 1);
    return scene_open(name, 1);
}

static void check(const char *name, int map, int stride, double least, double most)
{
    static const VsvSettings settings = {.alpha = 64,
                                         .theta = 64,
                                         .phi = 128,
                                         .scan = "columns",
                                         .warp = "even",
                                         .slices = "uniform",
                                         .shape = "cube"};
    Scene *scene = open_scene(name);
    Boundaries b = boundaries_open(scene, &settings, map);
    const double share = boundaries_check(&b, stride);
    // some differ, or nothing was asked; few, since borders are few
    cr_assert(share > least && share < most, "%s: %g of the voxels differ", name, share);
    boundaries_close(&b);
    scene_close(scene);
}

Test(slow_vsv_resampling, differs_at_borders_alone_fence)
{
    check("fence", 1024, 11, 1e-5, 0.2);
}
Test(slow_vsv_resampling, differs_at_borders_alone_toroid)
{
    check("toroid", 1024, 67, 1e-5, 0.2);
}
Test(slow_vsv_resampling, differs_at_borders_alone_colonnade)
{
    check("colonnade", 1024, 67, 1e-5, 0.2);
}
Test(slow_vsv_resampling, differs_at_borders_alone_forest)
{
    check("forest", 1024, 131, 1e-5, 0.2);
}
// The cone of its spot holds so few rows of this grid that none of their voxels may differ.
Test(slow_vsv_resampling, differs_at_borders_alone_bunny)
{
    check("bunny", 1024, 5, -1, 0.2);
}
Test(slow_vsv_resampling, differs_at_borders_alone_cell24)
{
    check("cell24", 1024, 67, 1e-5, 0.2);
}
Test(slow_vsv_resampling, differs_at_borders_alone_crowd)
{
    check("crowd", 1024, 251, 1e-5, 0.2);
}
