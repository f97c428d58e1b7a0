// The shadow volume of chapter 01 against a serial OR, Embree's shadow rays, and what figure 2 of Wyman 2011 shows.
#include "solid_bench.h"
#include "truth.h"
#include "../chapters/01_voxelization/shadow_volume.h"

static bool bit(const uint32_t *words, size_t i)
{
    return words[i >> 5] >> (i & 31) & 1;
}

static uint32_t *find(const ShadowScan *scan, const VoxelGrid *grid, const uint32_t *bits, int axis,
                      bool against)
{
    Voxels in = voxels_create(grid, "in"), shadow = voxels_create(grid, "shadow");
    gl.NamedBufferSubData(in.words, 0, (GLsizeiptr)in.bytes, bits);
    gl.NamedBufferSubData(shadow.words, 0, (GLsizeiptr)in.bytes, bits); // what it held is lost
    shadow_volume_find(scan, &in, axis, against, &shadow);
    uint32_t *found = voxels_read(&shadow);
    voxels_delete(&in);
    voxels_delete(&shadow);
    return found;
}

// Random bits, in grids whose rows begin anywhere in a word. Bits have no tolerance.
Test(shadow_volume, is_the_or_of_all_voxels_before_along_every_axis)
{
    gl_open(GL_PLATFORM_OSMESA, 16, 16, "test");
    ShadowScan scan = shadow_scan_open();
    const int sizes[][3] = {{32, 8, 8},   {33, 7, 5},  {1, 1, 1}, {3, 500, 7},
                            {100, 3, 40}, {31, 31, 2}, {64, 1, 9}};
    uint32_t state = 5;
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
        const int *n = sizes[s];
        VoxelGrid grid = {{0, 0, 0}, 1.0, {n[0], n[1], n[2]}};
        size_t words = grid_words(&grid), voxels = grid_voxels(&grid);
        uint32_t *bits = memory_new(words, sizeof *bits, "bits");
        for (size_t i = 0; i < voxels; i++) {
            state ^= state << 13, state ^= state >> 17, state ^= state << 5; // xorshift32
            bits[i >> 5] |= (uint32_t)(state % 23 == 0) << (i & 31);
        }
        for (int way = 0; way < 6; way++) {
            int axis = way / 2;
            bool against = way % 2;
            uint32_t *got = find(&scan, &grid, bits, axis, against);
            size_t stride = axis == 0 ? 1 : axis == 1 ? (size_t)n[0] : (size_t)n[0] * (size_t)n[1], wrong = 0;
            for (size_t i = 0; i < voxels; i++) {
                size_t at = i / stride % (size_t)n[axis], first = i - at * stride;
                bool shadow = false;
                for (size_t k = against ? at : 0; k < (against ? (size_t)n[axis] : at + 1); k++)
                    shadow = shadow || bit(bits, first + k * stride);
                wrong += shadow != bit(got, i);
            }
            for (size_t i = voxels; i < 32 * words; i++)
                wrong += bit(got, i); // nothing past the end
            cr_assert_eq(wrong, 0, "%d x %d x %d, axis %d%s: %zu wrong", n[0], n[1], n[2], axis,
                         against ? ", against" : "", wrong);
            free(got);
        }
        free(bits);
    }
    shadow_scan_close(&scan);
}

// The bunny, lit along each axis. Of its solid and its touched voxels together every lit voxel's centre must see the light, by Embree (no tolerance: a ray
// that meets the surface meets a touched voxel of its own column). Of the solid alone a voxel is dark where its centre is (parity) or a
// surface has been entered before it: the two differ only in features thinner than a voxel.
Test(shadow_volume, no_shadowed_point_is_lit, .timeout = 60)
{
    gl_open(GL_PLATFORM_OSMESA, 16, 16, "test");
    Scene *scene = scene_open("bunny", 1);
    VoxelGrid grid = scene_grid(scene, 40);
    Filled solid = solid_bench_fill(scene, &grid, false, 0);
    uint32_t *touched = truth_voxels(&scene->mesh, &grid);
    Truth *rays = truth_open(&scene->mesh);
    ShadowScan scan = shadow_scan_open();
    const float length = vec3_length(scene->upper - scene->lower);
    for (int way = 0; way < 6; way++) {
        int axis = way / 2;
        uint32_t *of_solid = find(&scan, &grid, solid.bits, axis, way % 2),
                 *of_surface = find(&scan, &grid, touched, axis, way % 2);
        long missed = 0, extra = 0;
        double missed_by_solid = 0, dark = 0;
        vec3 to_light = {0};
        to_light[axis] = way % 2 ? length : -length;
        for (size_t i = 0; i < grid_voxels(&grid); i++) {
            size_t at[3] = {i % (size_t)grid.size[0], i / (size_t)grid.size[0] % (size_t)grid.size[1],
                            i / (size_t)grid.size[0] / (size_t)grid.size[1]};
            vec3 centre = {0};
            for (int k = 0; k < 3; k++)
                centre[k] = (float)(grid.origin[k] + ((double)at[k] + 0.5) * grid.voxel_size);
            bool shadowed = truth_occluded(rays, centre, centre + to_light);
            dark += shadowed;
            missed += shadowed && !bit(of_surface, i);
            extra += !shadowed && bit(of_solid, i);
            missed_by_solid += shadowed && !bit(of_solid, i);
        }
        cr_assert_eq(missed, 0, "way %d: %ld of %g shadowed centres are lit", way, missed, dark);
        // truth_occluded leaves out 2^-16 of the way at its ends, 0.001 voxel here: of some 2000 columns that enter the bunny 2 end there
        cr_assert(extra <= 6, "way %d: %ld centres in the solid's shadow are lit", way, extra);
        // a surface entered and left between two centres: ears' rims, on some columns
        cr_assert(missed_by_solid < 0.05 * dark, "way %d: the solid loses %g of %g", way, missed_by_solid,
                  dark);
        cr_assert(voxels_count(of_solid, of_surface, grid_words(&grid)) == 0, "way %d: solid's in surface's",
                  way);
        free(of_solid);
        free(of_surface);
    }
    shadow_scan_close(&scan);
    truth_close(rays);
    free(touched);
    filled_free(&solid);
    scene_close(scene);
}

// What the conservative grid's shadow promises is more than its centres: no point of space in shadow lies in a lit voxel. Random points of
// the bunny's grid, a ray towards each of six lights (Embree); no tolerance, for a voxel is asked that holds the point in double.
Test(shadow_volume, of_the_conservative_grid_holds_every_shadowed_point)
{
    gl_open(GL_PLATFORM_OSMESA, 16, 16, "test");
    Scene *scene = scene_open("bunny", 1);
    VoxelGrid grid = scene_grid(scene, 32);
    uint32_t *touched = truth_voxels(&scene->mesh, &grid), state = 9;
    Truth *rays = truth_open(&scene->mesh);
    ShadowScan scan = shadow_scan_open();
    const float length = vec3_length(scene->upper - scene->lower);
    for (int way = 0; way < 6; way++) {
        uint32_t *shadow = find(&scan, &grid, touched, way / 2, way % 2);
        long missed = 0, dark = 0;
        vec3 to_light = {0};
        to_light[way / 2] = way % 2 ? length : -length;
        for (int i = 0; i < 20000; i++) {
            vec3 point = {0};
            size_t at[3];
            for (int k = 0; k < 3; k++) {
                state ^= state << 13, state ^= state >> 17, state ^= state << 5; // xorshift32
                point[k] = (float)(grid.origin[k] + state / 4294967296.0 * grid.size[k] * grid.voxel_size);
                double voxel = floor(((double)point[k] - grid.origin[k]) / grid.voxel_size);
                at[k] = (size_t)fmin(fmax(voxel, 0), grid.size[k] - 1);
            }
            if (!truth_occluded(rays, point, point + to_light))
                continue;
            dark++;
            missed += !bit(shadow, (at[2] * (size_t)grid.size[1] + at[1]) * (size_t)grid.size[0] + at[0]);
        }
        cr_assert(dark > 3000, "way %d: %ld shadowed points", way, dark);
        cr_assert_eq(missed, 0, "way %d: %ld of %ld shadowed points are lit", way, missed, dark);
        free(shadow);
    }
    shadow_scan_close(&scan);
    truth_close(rays);
    free(touched);
    scene_close(scene);
}

// Where a column's line enters and leaves the mesh, by Embree, one hit after the other.
typedef struct Crossings {
    double depth[64]; // voxels from the grid's face
    int count;
} Crossings;

static Crossings cross(const Truth *rays, const VoxelGrid *grid, vec3 from, int axis)
{
    Crossings crossings = {0};
    vec3 way = {0};
    way[axis] = 1;
    uint32_t last = UINT32_MAX;
    while (crossings.count < 64) {
        TruthHit hit = truth_ray(rays, from, way);
        if (!isfinite(hit.distance))
            break;
        double at = (double)from[axis] + (double)hit.distance;
        if (hit.triangle != last)
            crossings.depth[crossings.count++] = (at - grid->origin[axis]) / grid->voxel_size;
        last = hit.triangle;
        from[axis] = nextafterf((float)at, INFINITY);
    }
    return crossings;
}

// The solid's shadow at centres: dark from the first centre on that lies between an odd crossing and the next. In columns that Embree crosses an even
// number of times, and at centres no nearer to a crossing than a thousandth of a voxel, which float32 distances do not tell.
Test(shadow_volume, of_the_solid_is_right_at_centres)
{
    gl_open(GL_PLATFORM_OSMESA, 16, 16, "test");
    Scene *scene = scene_open("bunny", 1);
    VoxelGrid grid = scene_grid(scene, 40);
    Filled solid = solid_bench_fill(scene, &grid, false, 0);
    Truth *rays = truth_open(&scene->mesh);
    ShadowScan scan = shadow_scan_open();
    long wrong = 0, dark = 0, doubtful = 0, columns = 0;
    for (int axis = 0; axis < 3; axis++) {
        uint32_t *shadow = find(&scan, &grid, solid.bits, axis, false);
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        for (int i = 0; i < grid.size[u] * grid.size[v]; i++) {
            size_t at[3] = {0};
            at[u] = (size_t)(i % grid.size[u]), at[v] = (size_t)(i / grid.size[u]);
            vec3 from = {0};
            for (int k = 0; k < 3; k++)
                from[k] =
                    (float)(grid.origin[k] + (k == axis ? -1.0 : (double)at[k] + 0.5) * grid.voxel_size);
            Crossings line = cross(rays, &grid, from, axis);
            if (line.count == 0)
                continue;
            columns++;
            bool in_shadow = false, doubt = line.count % 2 != 0;
            for (int depth = 0; depth < grid.size[axis] && !doubt; depth++) {
                int before = 0;
                for (int c = 0; c < line.count; c++) {
                    before += line.depth[c] < depth + 0.5;
                    doubt = doubt || fabs(line.depth[c] - depth - 0.5) < 1e-3;
                }
                in_shadow = in_shadow || before % 2 == 1;
                at[axis] = (size_t)depth;
                size_t voxel = (at[2] * (size_t)grid.size[1] + at[1]) * (size_t)grid.size[0] + at[0];
                wrong += !doubt && in_shadow != bit(shadow, voxel);
                dark += in_shadow;
            }
            doubtful += doubt;
        }
        free(shadow);
    }
    // two crossings or more a column, a thousandth of a voxel on each side: 1 column in 200
    cr_assert(doubtful < columns / 50, "%ld of %ld columns are in doubt", doubtful, columns);
    cr_assert_eq(wrong, 0, "%ld centres of %ld in shadow are wrong", wrong, dark);
    shadow_scan_close(&scan);
    truth_close(rays);
    filled_free(&solid);
    scene_close(scene);
}
