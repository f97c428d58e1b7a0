// 06 solid voxelization in epipolar space: a voxel is set where its middle is inside.
#include "epipolar_voxels.h"

// The middle of a voxel as a point in space.
static bool voxel_middle(const VoxelBench *bench, const int v[3], double point[3])
{
    double angle[3], axis[3], length = 0.0, along = 0.0, up[3], side[3], up_length = 0.0;
    for (int k = 0; k < 3; k++)
        angle[k] = 0.5 * (voxels_border(bench, k, v[k]) + voxels_border(bench, k, v[k] + 1));
    for (int k = 0; k < 3; k++) {
        axis[k] = bench->frame.at_infinity ? -(double)bench->light.direction[k]
                                           : (double)bench->light.position[k] - (double)bench->camera.eye[k];
        length += axis[k] * axis[k];
    }
    length = sqrt(length);
    for (int k = 0; k < 3; k++) {
        axis[k] /= length;
        along += axis[k] * (double)bench->frame.up[k];
    }
    for (int k = 0; k < 3; k++) {
        up[k] = (double)bench->frame.up[k] - along * axis[k];
        up_length += up[k] * up[k];
    }
    for (int k = 0; k < 3; k++)
        up[k] /= sqrt(up_length);
    for (int k = 0; k < 3; k++)
        side[k] = axis[(k + 1) % 3] * up[(k + 2) % 3] - axis[(k + 2) % 3] * up[(k + 1) % 3];
    double beside, forward;
    if (bench->frame.at_infinity) {
        beside = angle[2];
        forward = beside / tan(angle[0]);
    } else {
        if (angle[0] + angle[2] >= M_PI)
            return false;                                                     // beyond infinity
        const double way = length * sin(angle[2]) / sin(angle[0] + angle[2]); // law of sines
        beside = way * sin(angle[0]);
        forward = way * cos(angle[0]);
    }
    for (int k = 0; k < 3; k++)
        point[k] = (double)bench->camera.eye[k] + forward * axis[k] +
                   beside * (cos(angle[1]) * up[k] + sin(angle[1]) * side[k]);
    return true;
}

// Every voxel of a box's interior and no other; those whose middle is within 1e-6 of the surface may be either.
static void check_box(VoxelBench *bench, vec3 lower, vec3 upper, const char *what)
{
    mesh_add_box(&bench->scene.mesh, lower, upper, 0);
    cr_assert_eq(triangles_open_edges(&bench->scene.mesh), (size_t)0);
    voxels_fill(bench, &(TrianglesSettings){.solid = true});
    size_t inside = 0, wrong = 0, beyond = 0;
    for (int i = 0; i < bench->range.alpha; i++)
        for (int j = 0; j < bench->range.theta; j++)
            for (int k = 0; k < bench->range.phi; k++) {
                const int v[3] = {i, j, k};
                double p[3], depth = INFINITY;
                if (!voxel_middle(bench, v, p)) {
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
