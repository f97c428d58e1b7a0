// 02 shadow maps, slow: errors against Embree fall with the map's size, on real scenes, for every shape.
#include "base.h"

#include "csv.h"
#include <criterion/criterion.h>
#include <stdlib.h>
#include <unistd.h>

// The slope of log(wrong share) over log(a map's side in texels) from 128 to 4096, as the sweep reports it with its largest map. A border of length L
// is wrong within about half a texel, so the share falls as 1/side: order −1 where borders lie more than texels apart, as on a plate (measured: −0.94
// to −1.25). On a fence and in a colonnade small maps' texels are wider than wires and flutes, which costs a tenth (−0.93, −0.90). Maps of
// all directions have fewer texels where the camera looks, so more of their range is too coarse for wires (cube −0.70, paraboloid −0.65). On a bunny the bias is reckoned from interpolated normals, whose slope the triangles exceed: acne of 1 to 3 in a thousand pixels stays (−0.69).
// A bias, a place or a face that is wrong gives 0.
static void check_order(const char *scene, const char *shape, double most)
{
    const char *build = getenv("BUILD");
    char *path = text_format("/tmp/shadow-order-%d.csv", (int)getpid());
    char *command = text_format(
        "%s/02_shadow_maps --scene %s --size 100x71 --sweep %s --set filter=nearest %s 2>/dev/null",
        build ? build : "build", scene, path, shape);
    cr_assert_eq(system(command), 0, "%s fails", command);
    CsvTable table = csv_table_read(path);
    double order = 0;
    for (size_t row = 1; row < table.rows; row++)
        if (strcmp(csv_table_field(&table, row, "metric"), "order") == 0 &&
            strstr(csv_table_field(&table, row, "settings"), "resolution=4096"))
            order = atof(csv_table_field(&table, row, "error"));
    cr_assert(order < most, "%s: the order is %g", command, order);
    csv_table_free(&table);
    unlink(path);
    free(path);
    free(command);
}
#define ORDER_TEST(name, scene, shape, most)                                                                 \
    Test(slow_shadow, order_of_##name, .timeout = 300)                                                       \
    {                                                                                                        \
        check_order(scene, shape, most);                                                                     \
    }
ORDER_TEST(spot_on_a_plate, "plate", "--set kind=spot", -0.85)
ORDER_TEST(spot, "fence", "--set kind=spot", -0.75)
ORDER_TEST(sun_by_view, "fence", "--set kind=directional --set fit=view", -0.75)
ORDER_TEST(sun_by_scene, "fence", "--set kind=directional --set fit=scene", -0.75)
ORDER_TEST(cube, "fence", "--set kind=point --set map=cube", -0.6)
ORDER_TEST(paraboloid, "fence", "--set kind=point --set map=paraboloid", -0.55)
ORDER_TEST(spot_on_a_bunny, "bunny", "--set kind=spot", -0.5)
