// 06 epipolar voxelized shadow volumes: what takes long: the whole stability table, rows of the sweep.
#include "csv.h"
#include "stability_table.h"

#include <math.h>

Test(vsv_slow, the_stability_table_passes)
{
    check_stability_table("06_epipolar_vsv", "", 50);
}

// One row of a sweep on the stage; the caller frees the table.
static CsvTable sweep_row(int row)
{
    const char *build = getenv("BUILD");
    char *path = text_format("/tmp/sweep-%d.csv", (int)getpid());
    char *command =
        text_format("%s/06_epipolar_vsv --scene stage --size 24x24 --row %d --sweep %s >/dev/null 2>&1",
                    build ? build : "build", row, path);
    cr_assert_eq(system(command), 0, "%s fails", command);
    CsvTable table = csv_table_read(path);
    unlink(path);
    free(path);
    free(command);
    return table;
}

static double error_of(const CsvTable *table, const char *reference, const char *metric)
{
    for (size_t row = 1; row < table->rows; row++)
        if (strcmp(csv_table_field(table, row, "reference"), reference) == 0 &&
            strcmp(csv_table_field(table, row, "metric"), metric) == 0)
            return atof(csv_table_field(table, row, "error"));
    cr_assert_fail("no %s against %s", metric, reference);
    return NAN;
}

static int row_of(const char *technique, const char *settings)
{
    const char *build = getenv("BUILD");
    char *command = text_format("%s/06_epipolar_vsv --list", build ? build : "build"), line[512];
    FILE *list = popen(command, "r");
    int found = 0;
    while (list && fgets(line, sizeof line, list)) {
        char *field[6] = {line};
        for (int i = 1; i < 6 && field[i - 1]; i++) {
            field[i] = strchr(field[i - 1], '\t');
            if (field[i])
                *field[i]++ = '\0';
        }
        if (field[5] && !strcmp(field[0], "sweep") && !strcmp(field[2], technique) &&
            !strcmp(field[4], settings))
            found = atoi(field[1]);
    }
    if (list)
        pclose(list);
    free(command);
    cr_assert(found, "no row %s %s", technique, settings);
    return found;
}

// Closed forms over the map's own lit stretches are what `converged` is: nothing is left but the number of their nodes, and the error against the truth is
// the map's alone.
Test(vsv_slow, what_converges_has_the_map_s_error_alone)
{
    CsvTable table = sweep_row(row_of("segments", "method=segments"));
    const double map = error_of(&table, "truth", "map_nrmse");
    cr_assert_lt(error_of(&table, "converged", "nrmse"), 1e-5);
    cr_assert(map > 0 && fabs(error_of(&table, "truth", "nrmse") - map) < 1e-5, "%g of the map", map);
    csv_table_free(&table);
}

// Shadow rays at the volume's own φ have the error of their number alone; what map and grid add may be a quarter of it at most.
Test(vsv_slow, a_volume_is_as_near_to_the_truth_as_rays_at_its_angles)
{
    CsvTable rays = sweep_row(row_of("rays", "method=rays phi=128")),
             volume = sweep_row(row_of("map", "method=map phi=128"));
    const double of_rays = error_of(&rays, "truth", "rel_rmse"),
                 of_volume = error_of(&volume, "truth", "rel_rmse");
    cr_assert(of_rays > 0 && of_rays < 0.02 && of_volume < 1.25 * of_rays, "%g and %g", of_rays, of_volume);
    csv_table_free(&rays);
    csv_table_free(&volume);
}
