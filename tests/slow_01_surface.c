// 01 voxelization, surface methods, slow: the inclusions on larger grids, every cube, a million triangles in a voxel, and the memory of 512³.
#include "stability_table.h"
#include "surface_bench.h"

#include <unistd.h>

#define INCLUSIONS(scene)                                                                                    \
    Test(slow_surface, methods_include_one_another_on_##scene)                                               \
    {                                                                                                        \
        for (int resolution = 64; resolution <= 256; resolution *= 2)                                        \
            check_inclusions(#scene, resolution);                                                            \
    }
INCLUSIONS(bunny)
INCLUSIONS(cornell)
INCLUSIONS(colonnade)

// Every N that the closed form is promised for; the fast test takes some.
Test(slow_surface, a_cube_a_quarter_inside_the_grid_fills_its_shell_at_every_size)
{
    check_cubes(4, 1);
}

// 0: the renderer's caller does all itself.
#define THREADS(scene)                                                                                       \
    Test(slow_surface, the_number_of_threads_changes_nothing_on_##scene)                                     \
    {                                                                                                        \
        const uint64_t one = hash_with_threads("1", hash_of_methods, #scene);                                \
        cr_assert_eq(hash_with_threads("0", hash_of_methods, #scene), one, "0 and 1 threads differ");        \
        cr_assert_eq(hash_with_threads("2", hash_of_methods, #scene), one, "2 and 1 threads differ");        \
        cr_assert_eq(hash_with_threads("4", hash_of_methods, #scene), one, "4 and 1 threads differ");        \
    }
THREADS(bunny)
THREADS(cornell)
THREADS(colonnade)

Test(slow_surface, a_million_triangles_in_one_voxel_set_it_once)
{
    SurfaceBench bench = surface_bench_open("crowd");
    VoxelGrid grid = scene_grid(bench.on.scene, 16);
    for (int m = 0; m < METHODS; m++) {
        uint32_t *bits = bits_by(&bench, (Method)m, &grid);
        double got = bits_count(bits, &grid);
        cr_assert(m == EXACT || m == BINARY ? got == 3 : got <= 3, "%s: %g voxels", method_names[m], got);
        free(bits);
    }
}

Test(slow_surface, the_whole_stability_table_passes, .timeout = 600)
{
    check_stability_table("01_voxelization", "", 160);
}

// A plan's number after the first `name` behind `from`.
static double plan_number(const char *plan, const char *from, const char *name)
{
    const char *at = strstr(plan, from);
    at = at ? strstr(at, name) : NULL;
    cr_assert(at, "%s of %s is not in %s", name, from, plan);
    return strtod(at + strlen(name) + strlen("\":"), NULL);
}

// The program as a user runs it. A cubic grid of 512³ has 16 MiB of bits, one of another shape less.
static void check_memory(const char *scene, double bytes)
{
    const char *build = getenv("BUILD");
    char *path = text_format("/tmp/memory-%d", (int)getpid());
    char *command = text_format("%s/01_voxelization --scene %s --set resolution=512 --size 256x256 --out "
                                "%s.png --plan --json >%s.json",
                                build ? build : "build", scene, path, path);
    cr_assert_eq(system(command), 0, "%s fails", command);
    char *json = text_format("%s.json", path), *png = text_format("%s.png", path),
         *plan = file_read(json, NULL);
    double grid = plan_number(plan, "\"walk\"", "grid_bytes"),
           peak = plan_number(plan, "\"walk\"", "peak_bytes");
    cr_assert(bytes > 0 ? grid == bytes : grid < 16 << 20, "%s: %g bytes of bits", scene, grid);
    cr_assert(peak <= 512 << 20, "%s: a peak of %g MiB", scene, peak / (1 << 20));
    unlink(json);
    unlink(png);
    free(path);
    free(command);
    free(json);
    free(png);
    free(plan);
}
Test(slow_surface, occupancy_of_512_cubed_takes_16_mib_and_the_program_less_than_512)
{
    check_memory("cube", 16 << 20);
    check_memory("bunny", 0);
    check_memory("cornell", 16 << 20);
    check_memory("colonnade", 0);
}
