// 06 solid voxelization in epipolar space: a voxel is set where its middle is inside.
#include "epipolar_voxels.h"

// Every voxel of a box's interior and no other; those whose middle is within 1e-6 of the surface may be either.
static void check_box(VoxelBench *bench, vec3 lower, vec3 upper, const char *what)
{
    mesh_add_box(&bench->scene.mesh, lower, upper, 0);
    cr_assert_eq(triangles_open_edges(&bench->scene.mesh), (size_t)0);
    voxels_fill(bench, &(TrianglesSettings){.method = "solid"});
    size_t inside = 0, wrong = 0, beyond = 0;
    for (int i = 0; i < bench->range.alpha; i++)
        for (int j = 0; j < bench->range.theta; j++)
            for (int k = 0; k < bench->range.phi; k++) {
                const int v[3] = {i, j, k};
                const double middle[3] = {i + 0.5, j + 0.5, k + 0.5};
                double p[3], depth = INFINITY;
                if (!voxels_point(bench, middle, p)) {
                    beyond += voxels_get(bench, v);
                    continue;
                }
                for (int c = 0; c < 3; c++)
                    depth = fmin(depth, fmin(p[c] - (double)lower[c], (double)upper[c] - p[c]));
                inside += depth > 0.0;
                wrong += fabs(depth) > 1e-6 && voxels_get(bench, v) != (depth > 0.0);
            }
    cr_assert(inside > 20, "%s: only %zu voxels are inside", what, inside);
    cr_assert_eq(wrong, (size_t)0, "%s: %zu voxels are wrong, %zu inside", what, wrong, inside);
    cr_assert_eq(beyond, (size_t)0, "%s: %zu voxels beyond infinity are inside", what, beyond);
}

Test(solid_epipolar, a_box_beside_the_axis)
{
    VoxelBench bench = voxels_bench(vec3_make(0.3f, 0.2f, 0.1f), vec3_make(1.1f, 1.7f, -2.3f), 32, 24, 64);
    check_box(&bench, vec3_make(-1.5f, -0.7f, -3.2f), vec3_make(0.4f, 0.8f, -1.1f), "beside");
    voxels_close(&bench);
}
Test(solid_epipolar, a_box_around_the_eye)
{
    VoxelBench bench = voxels_bench(vec3_make(0.3f, 0.2f, 0.1f), vec3_make(1.1f, 1.7f, -2.3f), 32, 24, 64);
    check_box(&bench, vec3_make(-0.5f, -0.7f, -0.7f), vec3_make(0.7f, 0.9f, 0.8f), "around the eye");
    voxels_close(&bench);
}
Test(solid_epipolar, a_box_around_the_light)
{
    VoxelBench bench = voxels_bench(vec3_make(0.3f, 0.2f, 0.1f), vec3_make(1.1f, 1.7f, -2.3f), 32, 24, 64);
    check_box(&bench, vec3_make(0.5f, 1.1f, -3.1f), vec3_make(1.9f, 2.4f, -1.4f), "around the light");
    voxels_close(&bench);
}
Test(solid_epipolar, a_box_between_eye_and_light_seen_in_part)
{
    VoxelBench bench = voxels_bench(vec3_make(0.3f, 0.2f, 0.1f), vec3_make(1.1f, 1.7f, -2.3f), 32, 24, 64);
    bench.range.alpha_most = 1.2f;
    bench.range.theta_least = 2.0f; // over the end at π
    bench.range.theta_span = 2.5f;
    bench.range.phi_least = 0.1f;
    bench.range.phi_most = 0.4f; // what lies beyond still says where inside begins
    check_box(&bench, vec3_make(0.4f, 0.6f, -1.5f), vec3_make(1.0f, 1.3f, -0.8f), "between");
    voxels_close(&bench);
}
Test(solid_epipolar, a_box_in_the_sun)
{
    VoxelBench bench = voxels_bench(vec3_make(0.3f, 0.2f, 0.1f), vec3_make(0, 0, 0), 32, 24, 64);
    bench.light = (Light){.kind = LIGHT_DIRECTIONAL, .direction = vec3_normalize(vec3_make(0.3f, -1, 0.4f))};
    bench.range.phi_most = 4;
    check_box(&bench, vec3_make(-1.5f, -0.7f, -3.2f), vec3_make(0.4f, 0.8f, -1.1f), "sun");
    voxels_close(&bench);
}

// A cube has none; without one of its triangles it has three, and two cubes that share an edge have none (four triangles meet there).
Test(solid_epipolar, edges_of_an_open_mesh_are_counted)
{
    Mesh mesh = {0};
    mesh_add_box(&mesh, vec3_make(0, 0, 0), vec3_make(1, 1, 1), 0);
    cr_assert_eq(triangles_open_edges(&mesh), (size_t)0);
    mesh_add_box(&mesh, vec3_make(1, 1, 0), vec3_make(2, 2, 1), 0);
    cr_assert_eq(triangles_open_edges(&mesh), (size_t)0);
    mesh.triangle_count--;
    cr_assert_eq(triangles_open_edges(&mesh), (size_t)3);
}
