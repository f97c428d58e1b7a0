// 06 conservative voxelization in epipolar space: every voxel that a triangle touches is set, and hardly another.
#include "epipolar_scene.h"

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
    voxels_fill(bench, &(TrianglesSettings){.method = "conservative"});
    check_voxels(bench, what);
    check_points(bench, 500, what);
}

static const vec3 EYE = {0.3f, 0.2f, 0.1f}, LAMP = {1.1f, 1.7f, -2.3f};

static void add_random(VoxelBench *bench, int count, double size)
{
    uint64_t state = 1;
    for (int i = 0; i < count; i++) {
        const vec3 at = random_point(&state, 4.0 * size);
        voxels_add(bench, at, at + random_point(&state, size), at + random_point(&state, size));
    }
}
// A triangle around a point, steeply across the line from eye to lamp.
static void add_around(VoxelBench *bench, vec3 at)
{
    voxels_add(bench, at + vec3_make(0.9f, 0.1f, 0.2f), at + vec3_make(-0.5f, 0.6f, -0.1f),
               at + vec3_make(-0.4f, -0.7f, 0.3f));
}

Test(conservative, random_triangles)
{
    VoxelBench bench = voxels_bench(EYE, LAMP, 16, 24, 32);
    add_random(&bench, 6, 1.0);
    check_all(&bench, "random");
    voxels_close(&bench);
}

// What the paper splits: across θ = 0 (here ±π) and around the axis, before the light, behind it and behind the eye (its figure 9).
Test(conservative, triangles_across_the_ends_of_theta)
{
    VoxelBench bench = voxels_bench(EYE, LAMP, 16, 24, 32);
    const EpipolarFrame frame = epipolar_frame(&bench.camera, &bench.light);
    const vec3 middle = EYE - 1.5f * frame.up + 0.5f * frame.axis; // θ = π
    voxels_add(&bench, middle + 0.8f * frame.side, middle - 0.6f * frame.side, middle + 0.7f * frame.axis);
    check_all(&bench, "wrap");
    voxels_close(&bench);
}
Test(conservative, triangles_around_the_axis)
{
    static const float where[] = {0.4f, 1.5f, -0.7f};
    VoxelBench bench = voxels_bench(EYE, LAMP, 16, 16, 32);
    for (int i = 0; i < 3; i++) {
        bench.scene.mesh.triangle_count = 0;
        add_around(&bench, EYE + where[i] * (LAMP - EYE));
        check_all(&bench, i == 0 ? "between eye and light" : i == 1 ? "behind the light" : "behind the eye");
    }
    voxels_close(&bench);
}
// Corners at the light and the eye, where φ and α are every angle; a plane through both; edges through both; slivers, and corners in a line.
Test(conservative, triangles_at_the_eye_and_the_light)
{
    VoxelBench bench = voxels_bench(EYE, LAMP, 16, 16, 32);
    const vec3 way = LAMP - EYE;
    voxels_add(&bench, LAMP, LAMP + vec3_make(1, 0.2f, 0.3f), LAMP + vec3_make(0.3f, -0.6f, 0.9f));
    voxels_add(&bench, EYE, EYE + vec3_make(-1, 0.2f, 0.3f), EYE + vec3_make(0.3f, -0.6f, 0.9f));
    check_all(&bench, "corners");
    bench.scene.mesh.triangle_count = 0;
    voxels_add(&bench, EYE + 0.25f * way, EYE + 0.75f * way, EYE + 0.5f * way + vec3_make(0, 1, 0));
    voxels_add(&bench, EYE - 0.5f * way, LAMP + way, EYE + vec3_make(-1, 0.5f, 0.5f));
    check_all(&bench, "edges along the axis");
    bench.scene.mesh.triangle_count = 0;
    voxels_add(&bench, vec3_make(-2, 1, -1), vec3_make(3, -1, 1), vec3_make(0.5f, 1e-6f, 0));
    voxels_add(&bench, vec3_make(-2, -1, -1), vec3_make(2, -1, -3), vec3_make(0, -1, -2));
    check_all(&bench, "a sliver and a line");
    voxels_close(&bench);
}

Test(conservative, part_of_the_angles)
{
    VoxelBench bench = voxels_bench(EYE, LAMP, 16, 24, 32);
    bench.range.alpha_least = 0.3f; // what comes before counts as in the first column
    bench.range.alpha_most = 2;
    bench.range.theta_least = 2; // over π
    bench.range.theta_span = 3;
    bench.range.phi_least = 0.2f;
    bench.range.phi_most = 1.5f;
    bench.squared = true;
    bench.borders = memory_new(25, sizeof(float), "borders");
    for (int i = 0; i <= 24; i++)
        bench.borders[i] = 0.5f * (float)i / 24 * (1 + (float)i / 24);
    add_random(&bench, 16, 1.5);
    add_around(&bench, EYE + 0.4f * (LAMP - EYE));
    const vec3 before = EYE + 0.95f * (LAMP - EYE); // all of it before the range of α
    voxels_add(&bench, before + vec3_make(0.3f, 0, 0.1f), before + vec3_make(-0.15f, 0.2f, 0.05f),
               before + vec3_make(-0.1f, -0.25f, -0.2f));
    check_all(&bench, "part");
    cr_assert(bench.counts.outside > 0 && bench.counts.outside < 16, "%u of 18 outside",
              bench.counts.outside);
    voxels_close(&bench);
}

Test(conservative, a_light_at_infinity)
{
    VoxelBench bench = voxels_bench(EYE, LAMP, 16, 16, 32);
    bench.light = (Light){.kind = LIGHT_DIRECTIONAL, .direction = vec3_normalize(vec3_make(0.3f, -1, 0.4f))};
    bench.range.phi_most = 4;
    add_random(&bench, 4, 1.0);
    add_around(&bench, EYE - 2.0f * bench.light.direction);
    check_all(&bench, "sun");
    voxels_close(&bench);
}

// Three slices are narrow enough; two, each of half a turn, are not.
Test(conservative, three_slices)
{
    VoxelBench bench = voxels_bench(EYE, LAMP, 16, 3, 32);
    add_random(&bench, 3, 1.0);
    check_all(&bench, "three slices");
    voxels_close(&bench);
}
Test(conservative, two_slices_are_refused, .exit_code = 2)
{
    VoxelBench bench = voxels_bench(EYE, LAMP, 16, 2, 32);
    add_random(&bench, 3, 1.0);
    voxels_fill(&bench, &(TrianglesSettings){.method = "conservative"});
}

// A light that all but meets the eye, or does; a far one; a world a million times as large or as small.
Test(conservative, near_and_far_lights)
{
    static const float away[] = {0, 1e-6f, 1e6f};
    for (int i = 0; i < 3; i++) {
        VoxelBench bench = voxels_bench(EYE, EYE + vec3_make(0, 0, -away[i]), 16, 16, 32);
        if (i == 2) // rays are all but parallel
            bench.range.phi_most = 5e-6f;
        add_random(&bench, 5, 1.0);
        check_all(&bench, i == 0 ? "at the eye" : i == 1 ? "a micrometre away" : "far");
        voxels_close(&bench);
    }
}
Test(conservative, scales)
{
    static const float scales[] = {1e-6f, 1e6f};
    for (int i = 0; i < 2; i++) {
        const float scale = scales[i];
        VoxelBench bench = voxels_bench(scale * EYE, scale * LAMP, 16, 16, 32);
        add_random(&bench, 5, (double)scale);
        check_all(&bench, scale < 1 ? "small" : "large");
        voxels_close(&bench);
    }
}

// After the scan nothing that is lit has any shadow in it (slow_06_voxels.c: all scenes).
static void check_scene(const char *name)
{
    SceneBench bench = scene_bench(name, 48, 64, 64);
    voxels_fill(&bench.voxels, &(TrianglesSettings){.method = "conservative"});
    voxels_scan(&bench.voxels);
    const SceneCounts counts = scene_ask(&bench, 2000);
    cr_assert(counts.asked > 10000 && counts.dark > 10, "%s: %zu points, %zu dark voxels", name, counts.asked,
              counts.dark);
    cr_assert_eq(counts.leaks, (size_t)0, "%s: %zu of %zu points of lit voxels are in shadow", name,
                 counts.leaks, counts.asked);
    cr_assert(counts.dark_though_lit * 10 < counts.dark, "%s: %zu of %zu dark voxels are lit throughout",
              name, counts.dark_though_lit, counts.dark);
    scene_bench_close(&bench);
}
Test(conservative, nothing_lit_is_in_shadow_behind_a_fence)
{
    check_scene("fence");
}
Test(conservative, nothing_lit_is_in_shadow_in_a_box)
{
    check_scene("cornell");
}

// The paper's way, against the exact one: voxels that one sets and the other does not, as a share of the exact ones.
typedef struct FlatError {
    double missing, extra;
} FlatError;
static FlatError flat_error(VoxelBench *bench, TriangleSplits splits, int parts)
{
    const size_t words =
        (size_t)bench->range.alpha * (size_t)bench->range.theta * (size_t)bench->range.phi / 32;
    voxels_fill(bench, &(TrianglesSettings){.method = "conservative"});
    uint32_t *exact = bench->words;
    bench->words = NULL;
    voxels_fill(bench, &(TrianglesSettings){"flat", splits, parts});
    double missing = 0.0, extra = 0.0, all = 0.0;
    for (size_t i = 0; i < words; i++) {
        all += __builtin_popcount(exact[i]);
        missing += __builtin_popcount(exact[i] & ~bench->words[i]);
        extra += __builtin_popcount(bench->words[i] & ~exact[i]);
    }
    free(exact);
    return (FlatError){missing / all, extra / all};
}

// Edges that are straight in space are curved in (α, θ, φ): the more parts, the fewer voxels are missed, but some always are.
Test(flat, subdivision_closes_in_on_curved_edges)
{
    VoxelBench bench = voxels_bench(EYE, LAMP, 64, 64, 64);
    add_random(&bench, 12, 2.0);
    const FlatError one = flat_error(&bench, SPLIT_ALL, 1), most = flat_error(&bench, SPLIT_ALL, 16);
    cr_assert(one.missing > 0.1 && one.extra > 0.1, "one part: %g missing, %g extra", one.missing, one.extra);
    cr_assert(most.missing < 0.5 * one.missing, "16 parts: %g missing, one: %g", most.missing, one.missing);
    cr_assert(most.missing > 0.0, "nothing is missing");
    voxels_close(&bench);
}

// Section 4.1.1 and figures 9, 10: without the wrap's split a triangle flips over to the wrong slices; without the epipole's it leaves a hole around the axis.
Test(flat, without_its_splits_light_leaks_and_shadows_come_from_nowhere)
{
    VoxelBench bench = voxels_bench(EYE, LAMP, 64, 64, 64);
    const EpipolarFrame frame = epipolar_frame(&bench.camera, &bench.light);
    const vec3 middle = EYE - 1.5f * frame.up + 0.5f * frame.axis; // θ = π, where the grid's ends are
    voxels_add(&bench, middle + 0.4f * frame.side, middle - 0.3f * frame.side, middle + 0.3f * frame.axis);
    const FlatError split = flat_error(&bench, SPLIT_ALL, 16),
                    unsplit = flat_error(&bench, SPLIT_EPIPOLE, 16);
    cr_assert(split.missing < 0.02 && split.extra < 0.05, "wrap split: %g missing, %g extra", split.missing,
              split.extra);
    cr_assert(unsplit.missing > 0.1 && unsplit.extra > 0.5, "wrap not split: %g missing, %g extra",
              unsplit.missing, unsplit.extra);
    bench.scene.mesh.triangle_count = 0;
    add_around(&bench, EYE + 0.4f * (LAMP - EYE));
    const FlatError whole = flat_error(&bench, SPLIT_ALL, 16), holed = flat_error(&bench, SPLIT_WRAP, 16);
    cr_assert(whole.missing < 0.1, "epipole split: %g missing", whole.missing);
    cr_assert(holed.missing > whole.missing + 0.05, "epipole not split: %g missing, split: %g", holed.missing,
              whole.missing);
    voxels_close(&bench);
}
