// 06: triangles that no voxel of the grid can need are left out; those that one does are not.
#include "epipolar_voxels.h"

static const vec3 EYE = {0.3f, 0.2f, 0.1f}, LAMP = {1.1f, 1.7f, -2.3f};

// A grid of part of the angles, and one triangle about the middle of a place in it (in voxels; beside the grid where it is not in it), a twentieth of a voxel in size.
static VoxelBench one_triangle(double alpha, double theta, double phi, const char *method)
{
    VoxelBench bench = voxels_bench(EYE, LAMP, 16, 16, 32);
    bench.range = (EpipolarRange){0.3f, 1.5f, -0.5f, 1.5f, 0.4f, 1.2f, 16, 16, 32};
    bench.frame = epipolar_frame(&bench.camera, &bench.light);
    vec3 corner[3];
    for (int i = 0; i < 3; i++) {
        const double place[3] = {alpha + (i == 0 ? 0.05 : 0.0), theta + (i == 1 ? 0.05 : 0.0),
                                 phi + (i == 2 ? 0.05 : 0.0)};
        double p[3];
        cr_assert(voxels_point(&bench, place, p));
        corner[i] = vec3_make((float)p[0], (float)p[1], (float)p[2]);
    }
    voxels_add(&bench, corner[0], corner[1], corner[2]);
    voxels_fill(&bench, &(TrianglesSettings){.method = method});
    return bench;
}

static size_t bits_set(const VoxelBench *bench)
{
    size_t set = 0;
    for (size_t i = 0; i < (size_t)16 * 16 * 32 / 32; i++)
        set += (size_t)__builtin_popcount(bench->words[i]);
    return set;
}

// Just within each side of the grid it sets voxels, and leaving it out would change them; just without it makes no work and sets none.
static void check_side(double alpha, double theta, double phi, bool outside, const char *what)
{
    VoxelBench bench = one_triangle(alpha, theta, phi, "conservative");
    cr_assert_eq(bench.counts.outside, outside ? 1u : 0u, "%s: %u outside", what, bench.counts.outside);
    cr_assert_eq(bench.counts.items == 0, outside, "%s: %u items", what, bench.counts.items);
    cr_assert_eq(bits_set(&bench) == 0, outside, "%s: %zu voxels", what, bits_set(&bench));
    voxels_close(&bench);
}
Test(left_out, behind_all_view_rays)
{
    check_side(15.9, 8, 16, false, "last column");
    check_side(16.1, 8, 16, true, "behind it");
}
Test(left_out, before_all_view_rays_it_still_shades_them)
{
    check_side(-0.1, 8, 16, false, "before the first column");
}
Test(left_out, beside_all_slices)
{
    check_side(8, 0.1, 16, false, "first slice");
    check_side(8, -0.2, 16, true, "before it");
    check_side(8, 15.9, 16, false, "last slice");
    check_side(8, 16.2, 16, true, "behind it");
}
Test(left_out, beside_all_light_rays)
{
    check_side(8, 8, 0.1, false, "first light ray");
    check_side(8, 8, -0.2, true, "before it");
    check_side(8, 8, 31.9, false, "last light ray");
    check_side(8, 8, 32.2, true, "behind it");
}
// What is behind all light rays of the grid is needed to know what is inside.
Test(left_out, a_solid_s_far_side_is_kept)
{
    VoxelBench far_side = one_triangle(8, 8, 32.2, "solid"), near_side = one_triangle(8, 8, -0.2, "solid");
    cr_assert_eq(far_side.counts.outside, 0u);
    cr_assert_eq(near_side.counts.outside, 1u);
    voxels_close(&far_side);
    voxels_close(&near_side);
}

// Nothing left out: more work, the same voxels.
Test(left_out, everything_gives_the_same_voxels)
{
    uint32_t *words[2];
    TrianglesCounts counts[2];
    for (int everything = 0; everything < 2; everything++) {
        VoxelBench bench = voxels_bench(EYE, LAMP, 16, 16, 32);
        bench.range = (EpipolarRange){0.3f, 1.5f, -3.14159265f, 6.2831853f, 0.4f, 1.2f, 16, 16, 32};
        for (int i = 0; i < 8; i++) {
            const vec3 at =
                EYE + vec3_make(2 * cosf((float)i), 2 * sinf(2.3f * (float)i), 1 - 0.6f * (float)i);
            voxels_add(&bench, at, at + vec3_make(0.5f, 0.1f, 0), at + vec3_make(0, 0.3f, 0.4f));
        }
        if (everything)
            shader_define_all("EVERYTHING", 1);
        voxels_fill(&bench, &(TrianglesSettings){.method = "conservative"});
        words[everything] = bench.words;
        counts[everything] = bench.counts;
        bench.words = NULL;
        voxels_close(&bench);
    }
    cr_assert(counts[0].outside > 0, "nothing is left out");
    cr_assert_eq(counts[1].outside, 0u);
    cr_assert(counts[1].items > counts[0].items, "%u items, %u", counts[1].items, counts[0].items);
    cr_assert_eq(memcmp(words[0], words[1], (size_t)16 * 16 * 32 / 8), 0);
    free(words[0]);
    free(words[1]);
}
