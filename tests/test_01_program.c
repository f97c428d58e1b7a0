// 01 voxelization: the program as a user runs it: what a frame builds again, which pictures are made, the stability table.
#include "plan_lines.h"
#include "stability_table.h"
#include "base.h"

#include <criterion/criterion.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// What the program's plan says of its last frame, run as a user runs it.
static char *plan_of(const char *arguments)
{
    const char *build = getenv("BUILD");
    char *out = text_format("/tmp/walk-%d", (int)getpid());
    char *command =
        text_format("%s/01_voxelization --out %s.png --size 32x32 --set resolution=16 --plan %s >%s 2>&1",
                    build ? build : "build", out, arguments, out);
    int status = system(command);
    char *plan = file_read(out, NULL), *picture = text_format("%s.png", out);
    cr_assert_eq(status, 0, "%s: %s", command, plan);
    unlink(out);
    unlink(picture);
    free(command);
    free(out);
    free(picture);
    return plan;
}
Test(program, what_has_not_changed_is_not_built_again)
{
    const struct {
        const char *frames;
        bool map, gbuffer, voxels, walk;
    } cases[] = {
        {"--frames 1", true, true, true, true},
        {"--frames 2", false, false, false, false},
        {"--frames 2 --path orbit", false, true, false, true},
        {"--frames 2 --path light", true, false, false, false},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const char *how = cases[i].frames;
        char *mesh_step = text_format("--step mesh %s", how), *plan = plan_of(mesh_step);
        cr_assert_eq(ran(plan, "depth maps"), cases[i].map, "%s: depth maps", how);
        cr_assert_eq(ran(plan, "G-buffer"), cases[i].gbuffer, "%s: G-buffer", how);
        cr_assert_eq(ran(plan, "light and lines"), cases[i].map || cases[i].gbuffer, "%s: light and lines",
                     how);
        free(plan);
        free(mesh_step);
        plan = plan_of(how);
        const char *voxels[] = {"exact: sort", "exact: small", "walk: blocks"};
        for (int k = 0; k < 3; k++)
            cr_assert_eq(ran(plan, voxels[k]), cases[i].voxels, "%s: %s", how, voxels[k]);
        cr_assert_eq(ran(plan, "walk"), cases[i].walk, "%s: walk", how);
        free(plan);
    }
}

// What only another picture needs is left out; --everything makes it all the same.
Test(program, only_the_picture_that_is_shown_is_made)
{
    const char *passes[] = {"depth maps",    "G-buffer",     "raster", "exact: sort",
                            "holes: walk",   "exact: walk",  "walk",   "solid: along z",
                            "storage: sums", "walk: shadow", "msaa"};
    enum { PASSES = sizeof passes / sizeof *passes };
    const struct {
        const char *arguments;
        bool runs[PASSES];
    } cases[] = {
        {"--step holes", {false, false, true, true, true}},
        {"--step exact", {false, false, false, true, false, true}},
        {"--step walk", {false, false, false, true, false, false, true}},
        {"--step walk --set method=raster", {false, false, true, false, false, false, true}},
        {"--step walk --set method=solid", {[6] = true, [7] = true}},
        {"--step holes --set method=solid", {[2] = true, [3] = true, [4] = true}},
        {"--step walk --set method=msaa", {[6] = true, [10] = true}},
        {"--step holes --set method=msaa", {[3] = true, [4] = true, [10] = true}},
        {"--step exact --set method=msaa", {[3] = true, [5] = true}},
        {"--step walk --set storage=attributes", {[3] = true, [6] = true, [8] = true}},
        {"--step exact --set storage=attributes", {[3] = true, [5] = true}},
        {"--step walk --set shadow=-y", {[3] = true, [6] = true, [9] = true}},
        {"--step exact --set shadow=-y", {[3] = true, [5] = true}},
        {"--step walk --everything", {true, true, true, true, true, true, true, true, true, true}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char *arguments = text_format("--scene cornell %s", cases[i].arguments), *plan = plan_of(arguments);
        for (int k = 0; k < PASSES; k++) {
            char *line = text_format("\n%s  ", passes[k]);
            if (cases[i].runs[k] || strstr(plan, line)) // what comes after the step is not in the plan
                cr_assert_eq(ran(plan, passes[k]), cases[i].runs[k], "%s: %s", cases[i].arguments, passes[k]);
            free(line);
        }
        free(arguments);
        free(plan);
    }
}

// The rest of the table is asked by slow_01_surface.c.
Test(program, the_stability_table_of_exact_passes)
{
    check_stability_table("01_voxelization", "--set method=exact --set storage=occupancy", 66);
}
