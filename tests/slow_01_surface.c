// 01 voxelization, surface methods, slow: the inclusions on larger grids, every cube, a million triangles in a voxel, and the memory of 512³.
#include "surface_bench.h"

#include "measure.h"

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

Test(slow_surface, a_million_triangles_in_one_voxel_set_it_once)
{
    SurfaceBench bench = surface_bench_open("crowd");
    VoxelGrid grid = scene_grid(bench.scene, 16);
    for (int m = 0; m < METHODS; m++) {
        uint32_t *bits = bits_by(&bench, (Method)m, &grid);
        double got = bits_count(bits, &grid);
        cr_assert(m == EXACT || m == BINARY ? got == 3 : got <= 3, "%s: %g voxels", method_names[m], got);
        free(bits);
    }
}

// Four grids of 512³, as the program holds, and everything else in one process.
Test(slow_surface, occupancy_of_512_cubed_takes_16_mib_and_the_process_less_than_512)
{
    SurfaceBench bench = surface_bench_open("cube");
    VoxelGrid grid = scene_grid(bench.scene, 512);
    Voxels voxels[4];
    for (int i = 0; i < 4; i++)
        voxels[i] = voxels_create(&grid, "memory");
    cr_assert_eq(voxels[0].bytes, (size_t)16 << 20, "%zu bytes", voxels[0].bytes);
    draw_exact(&bench, &voxels[0]);
    uint32_t *bits = voxels_read(&voxels[0]);
    cr_assert(bits_count(bits, &grid) > 6 * 500 * 500, "nothing was found");
    free(bits);
    cr_assert_leq(measure_peak_bytes(), (size_t)512 << 20, "peak %zu bytes", measure_peak_bytes());
}
