// 06, slow: the two geometric voxelizations on every scene of the chapter, against shadow rays.
#include "epipolar_scene.h"

// No point of a lit voxel is in shadow. The other way round there is no such promise; how much is dark without need is printed, and bounded: what shades it
// passes through a voxel of the same light ray, but not of the same part of it, so it happens only along shadows' borders.
static void check_conservative(const char *name)
{
    SceneBench bench = scene_bench(name, 128, 128, 256);
    voxels_fill(&bench.voxels, &(TrianglesSettings){.method = "conservative"});
    voxels_scan(&bench.voxels);
    const SceneCounts counts = scene_ask(&bench, 20000);
    printf("%s: %zu of %zu dark voxels are lit throughout; of %zu voxels %zu are dark whose middle is lit\n",
           name, counts.dark_though_lit, counts.dark, counts.middles, counts.middles_wrong);
    cr_assert(counts.asked > 100000 && counts.dark > 100, "%s: %zu points, %zu dark voxels", name,
              counts.asked, counts.dark);
    cr_assert_eq(counts.leaks, (size_t)0, "%s: %zu of %zu points of lit voxels are in shadow", name,
                 counts.leaks, counts.asked);
    cr_assert(counts.dark_though_lit * 20 < counts.dark, "%s: %zu of %zu dark voxels are lit throughout",
              name, counts.dark_though_lit, counts.dark);
    scene_bench_close(&bench);
}
#define SCENE(name)                                                                                          \
    Test(slow_voxels, conservative_##name, .timeout = 120)                                                   \
    {                                                                                                        \
        check_conservative(#name);                                                                           \
    }
SCENE(colonnade)
SCENE(fence)
SCENE(bunny)
SCENE(cornell)
SCENE(forest)
SCENE(toroid)
SCENE(cell24)
SCENE(crowd) // a million triangles

// How often a ray from the point meets the mesh tells on which side it is. 1: inside; -1: so near to the surface that single precision decides.
static int inside(const SceneBench *bench, vec3 point)
{
    const float step = 1e-5f * vec3_length(bench->scene->upper - bench->scene->lower);
    const vec3 way = vec3_normalize(vec3_make(0.31f, 0.77f, -0.56f));
    int crossings = 0;
    for (TruthHit hit = truth_ray(bench->truth, point, way); isfinite(hit.distance);
         hit = truth_ray(bench->truth, point, way)) {
        if (hit.distance < step)
            return -1;
        crossings++;
        point += (hit.distance + step) * way;
    }
    return crossings & 1;
}

static void check_solid(const char *name, double most_wrong)
{
    SceneBench bench = scene_bench(name, 128, 128, 256);
    const EpipolarRange *range = &bench.voxels.range;
    bench.voxels.range.alpha_least = 0.0f;
    cr_assert_eq(triangles_open_edges(&bench.scene->mesh), (size_t)0);
    voxels_fill(&bench.voxels, &(TrianglesSettings){.method = "solid"});
    size_t asked = 0, within = 0, wrong = 0;
    for (int n = 0; n < 200000; n++) {
        const int v[3] = {(int)(scene_uniform(&bench) * range->alpha),
                          (int)(scene_uniform(&bench) * range->theta),
                          (int)(scene_uniform(&bench) * range->phi)};
        const double middle[3] = {v[0] + 0.5, v[1] + 0.5, v[2] + 0.5};
        double p[3];
        if (!voxels_point(&bench.voxels, middle, p))
            continue;
        const int expected = inside(&bench, vec3_make((float)p[0], (float)p[1], (float)p[2]));
        asked += expected >= 0;
        within += expected == 1;
        wrong += expected >= 0 && expected != voxels_get(&bench.voxels, v);
    }
    cr_assert(within > 100, "%s: %zu middles are inside", name, within);
    // a surface met within `step` of an edge may be stepped over: a few in a hundred thousand
    cr_assert(wrong * 5000 <= asked, "%s: %zu of %zu middles are wrong", name, wrong, asked);
    voxels_scan(&bench.voxels);
    const SceneCounts counts = scene_ask(&bench, 20000);
    printf("%s: %zu of %zu inside wrong; scanned: %zu of %zu\n", name, wrong, asked, counts.middles_wrong,
           counts.middles);
    cr_assert((double)counts.middles_wrong < most_wrong * (double)counts.middles,
              "%s: the light of %zu of %zu middles is wrong", name, counts.middles_wrong, counts.middles);
    scene_bench_close(&bench);
}
// The scan asks middles of voxels, not every place: what is thinner than a voxel between them casts no shadow.
Test(slow_voxels, solid_bunny)
{
    check_solid("bunny", 0.005);
}
Test(slow_voxels, solid_toroid)
{
    check_solid("toroid", 0.02);
}
