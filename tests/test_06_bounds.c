// 06 bounds: the edges that shadow volumes go from, and that all shadow lies between the bounds.
#include "../chapters/06_epipolar_vsv/bounds.h"
#include "../chapters/06_epipolar_vsv/vsv_scenes.h"
#include "airlight.h"

#include <criterion/criterion.h>
#include <string.h>

enum { SIDE = 32 };

static Scene *open_scene(const char *name)
{
    const SceneKind *kind = vsv_scenes;
    while (strcmp(kind->name, name) != 0)
        kind++;
    return scene_from(kind, 1);
}

static vec3 lamp_of_the_cube;
static void make_cube(Scene *scene, uint64_t seed)
{
    (void)seed;
    const uint32_t grey = scene_add_material(scene, "grey", vec3_make(1, 1, 1), vec3_make(0, 0, 0));
    mesh_add_box(&scene->mesh, vec3_make(-1, -1, -1), vec3_make(1, 1, 1), grey);
    scene_add_light(
        scene, (Light){.kind = LIGHT_POINT, .position = lamp_of_the_cube, .intensity = vec3_make(1, 1, 1)});
}

// A cube's outline: 4 edges before a face, 6 before an edge or a corner; from within none, since all faces look away. A face's diagonal is never one of them.
Test(vsv_bounds, a_cube_s_outline_has_four_or_six_edges)
{
    static const struct {
        float lamp[3];
        size_t edges;
    } cases[] = {{{0.2f, 0.1f, 5}, 4}, {{3, 0.3f, 5}, 6}, {{4, 3, 5}, 6}, {{0.3f, 0.2f, 0.1f}, 0}};
    gl_open(GL_PLATFORM_OSMESA, 16, 16, "test");
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        lamp_of_the_cube = vec3_make(cases[i].lamp[0], cases[i].lamp[1], cases[i].lamp[2]);
        Scene *scene = scene_from(&(SceneKind){"cube", "a cube", make_cube}, 1);
        Bounds bounds = bounds_open(scene, &scene->lights[0], SIDE, SIDE);
        cr_assert_eq(bounds.edges, cases[i].edges, "case %zu: %zu edges", i, bounds.edges);
        bounds_close(&bounds);
        scene_close(scene);
    }
    gl_close();
}

// What lies outside the bounds is taken as lit: were any of it in shadow, the picture would be brighter than the exact one. Samples, crowded into the bounds, err
// less than as many along the whole ray.
static void check(const char *name)
{
    gl_open(GL_PLATFORM_OSMESA, 16, 16, "test");
    Scene *scene = open_scene(name);
    Raster *raster = raster_open();
    AirlightSettings settings = {.method = "segments",
                                 .variant = "intervals",
                                 .phase = "uniform",
                                 .steps = 64,
                                 .nodes = 24,
                                 .shadowed = true,
                                 .grey = true};
    Image exact = airlight_picture(raster, scene, &scene->camera, SIDE, SIDE, 512, &settings);
    settings.method = "equiangular";
    Image whole = airlight_picture(raster, scene, &scene->camera, SIDE, SIDE, 512, &settings);
    Bounds bounds = bounds_open(scene, &scene->lights[0], SIDE, SIDE);
    bounds_draw(&bounds, &scene->camera, SIDE, SIDE);
    settings.shader = "06_epipolar_vsv/bounds.comp";
    Image between = airlight_picture(raster, scene, &scene->camera, SIDE, SIDE, 512, &settings);
    const ImageError of_whole = image_compare(&whole, &exact), of_between = image_compare(&between, &exact);
    cr_assert(of_between.nrmse < 0.8 * of_whole.nrmse && of_between.nrmse < 5e-3,
              "%s: %g between bounds, %g without", name, of_between.nrmse, of_whole.nrmse);
    image_free(&exact);
    image_free(&whole);
    image_free(&between);
    bounds_close(&bounds);
    raster_close(raster);
    scene_close(scene);
    gl_close();
}

Test(vsv_bounds, hold_all_shadow_of_a_lamp)
{
    check("stage");
}
Test(vsv_bounds, hold_all_shadow_of_the_sun)
{
    check("stage_sun");
}
