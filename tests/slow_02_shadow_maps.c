// 02 shadow maps, slow: errors against Embree fall with the map's size, on real scenes, for every shape.
#include "base.h"

#include "csv.h"
#include <criterion/criterion.h>
#include <stdlib.h>
#include <unistd.h>

// The order of convergence that the sweep reports for its largest map: at least ⅓ on each shape. ½ is measured on a fence and a bunny, whose
// borders lie closer than most maps' texels, and 1 where they do not; a bias, a place or a face that is wrong gives 0.
static void check_order(const char *scene, const char *shape)
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
    cr_assert(order < -1.0 / 3, "%s: the order is %g", command, order);
    csv_table_free(&table);
    unlink(path);
    free(path);
    free(command);
}
#define ORDER_TEST(name, scene, shape)                                                                       \
    Test(slow_shadow, order_of_##name, .timeout = 300)                                                       \
    {                                                                                                        \
        check_order(scene, shape);                                                                           \
    }
ORDER_TEST(spot, "fence", "--set kind=spot")
ORDER_TEST(sun_by_view, "fence", "--set kind=directional --set fit=view")
ORDER_TEST(sun_by_scene, "fence", "--set kind=directional --set fit=scene")
ORDER_TEST(cube, "fence", "--set kind=point --set map=cube")
ORDER_TEST(paraboloid, "fence", "--set kind=point --set map=paraboloid")
ORDER_TEST(spot_on_a_bunny, "bunny", "--set kind=spot")
