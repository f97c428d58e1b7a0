// 06 conservative voxelization in epipolar space: every voxel that a triangle touches is set, and hardly another.
#include "epipolar_voxels.h"

static double uniform(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) * 0x1p-53;
}
static vec3 random_point(uint64_t *state, double size)
{
    vec3 p = {0};
    for (int k = 0; k < 3; k++)
        p[k] = (float)(size * (2.0 * uniform(state) - 1.0));
    return p;
}

// Points of each triangle: inside, on its edges, its corners. Those within 1e-9 of a voxel's side may count to either.
static size_t check_points(VoxelBench *bench, int points, const char *what)
{
    const Mesh *mesh = &bench->scene.mesh;
    uint64_t state = 7;
    size_t in_grid = 0;
    for (size_t t = 0; t < mesh->triangle_count; t++)
        for (int i = 0; i < points; i++) {
            double b[3] = {uniform(&state), uniform(&state), uniform(&state)}, p[3] = {0}, place[3];
            if (i % 4 == 0)
                b[i / 4 % 3] = 0.0;
            if (i % 16 == 0)
                b[(i / 4 + 1) % 3] = 0.0;
            const double sum = b[0] + b[1] + b[2];
            for (int k = 0; k < 9; k++)
                p[k % 3] +=
                    b[k / 3] / sum *
                    (double)mesh->positions[3 * mesh->indices[3 * t + (size_t)(k / 3)] + (size_t)(k % 3)];
            voxels_place(bench, p, place);
            const int v[3] = {(int)fmax(place[0], 0.0), (int)place[1], (int)place[2]};
            if (v[0] >= bench->range.alpha || v[1] >= bench->range.theta || v[2] >= bench->range.phi ||
                place[2] < 0.0)
                continue;
            bool near_side = false;
            for (int k = 0; k < 3; k++)
                near_side = near_side || fabs(place[k] - round(place[k])) < 1e-9;
            in_grid++;
            cr_assert(near_side || voxels_get(bench, v),
                      "%s: a point of triangle %zu lies in voxel %g %g %g, which is not set", what, t,
                      place[0], place[1], place[2]);
        }
    return in_grid;
}

// Every set voxel is touched by a triangle when both are grown a little; and every voxel that is touched for certain is set.
static void check_voxels(VoxelBench *bench, const char *what)
{
    const Mesh *mesh = &bench->scene.mesh;
    size_t set = 0, missing = 0, extra = 0;
    float(*triangles)[9] = memory_new(mesh->triangle_count + 1, sizeof *triangles, "triangles");
    for (size_t i = 0; i < 9 * mesh->triangle_count; i++)
        triangles[i / 9][i % 9] = mesh->positions[3 * mesh->indices[i / 3] + i % 3];
    for (int i = 0; i < bench->range.alpha; i++)
        for (int j = 0; j < bench->range.theta; j++)
            for (int k = 0; k < bench->range.phi; k++) {
                const int v[3] = {i, j, k};
                bool surely = false, perhaps = false;
                for (size_t t = 0; t < mesh->triangle_count && !perhaps; t++)
                    perhaps = voxels_touch(bench, triangles[t], v, 1e-7);
                for (size_t t = 0; t < mesh->triangle_count && perhaps && !surely; t++)
                    surely = voxels_touch(bench, triangles[t], v, -1e-7);
                set += voxels_get(bench, v);
                missing += surely && !voxels_get(bench, v);
                extra += !perhaps && voxels_get(bench, v);
            }
    free(triangles);
    cr_assert(set > 0, "%s: nothing is set", what);
    cr_assert_eq(missing, (size_t)0, "%s: %zu voxels are missing of %zu", what, missing, set);
    cr_assert_eq(extra, (size_t)0, "%s: %zu voxels too many of %zu", what, extra, set);
}

static void check_all(VoxelBench *bench, const char *what)
{
    voxels_fill(bench, &(TrianglesSettings){0});
    check_voxels(bench, what);
    check_points(bench, 500, what);
}

Test(conservative, random_triangles)
{
    VoxelBench bench = voxels_bench(vec3_make(0.3f, 0.2f, 0.1f), vec3_make(1.1f, 1.7f, -2.3f), 16, 24, 32);
    uint64_t state = 1;
    for (int i = 0; i < 6; i++) {
        const vec3 at = random_point(&state, 4.0);
        voxels_add(&bench, at, at + random_point(&state, 1.0), at + random_point(&state, 1.0));
    }
    check_all(&bench, "random");
    voxels_close(&bench);
}
