// 06 resampling: a volume from the light's map differs from the truth beside true borders of shadow alone. slow_06_resampling asks all scenes.
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

Test(vsv_resampling, differs_at_borders_alone_on_the_stage)
{
    check("stage", 256, 23, 1e-4, 0.02);
}
Test(vsv_resampling, differs_at_borders_alone_with_a_coarse_map)
{
    check("stage", 48, 23, 1e-4, 0.05);
}
Test(vsv_resampling, differs_at_borders_alone_in_the_sun)
{
    check("stage_sun", 256, 23, 1e-4, 0.02);
}
Test(vsv_resampling, differs_at_borders_alone_around_a_lamp_in_a_box)
{
    check("in_one_box", 256, 23, 1e-4, 0.02);
}
