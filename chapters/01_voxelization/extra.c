// extra: see extra.h. An extra voxel lies next to a triangle as a rule, so each triangle is asked about the extra voxels round its box alone;
// every voxel about every triangle would be 10^10 questions for a fine mesh.
#include "extra.h"

#include <stdlib.h>

// The set bits of the words, and for each word how many were set before it.
typedef struct Extra {
    uint32_t *words, *before;
    size_t count;
    double *gaps;
} Extra;

static Extra find_extra(const VoxelGrid *grid, const uint32_t *got, const uint32_t *truth)
{
    const size_t words = grid_words(grid);
    Extra extra = {.words = memory_new(words, sizeof(uint32_t), "extra voxels"),
                   .before = memory_new(words, sizeof(uint32_t), "extra voxels")};
    for (size_t i = 0; i < words; i++) {
        extra.words[i] = got[i] & ~truth[i];
        extra.before[i] = (uint32_t)extra.count;
        extra.count += (size_t)__builtin_popcount(extra.words[i]);
    }
    extra.gaps = memory_new(extra.count, sizeof *extra.gaps, "extra voxels");
    for (size_t i = 0; i < extra.count; i++)
        extra.gaps[i] = INFINITY;
    return extra;
}

static void triangle_corners(const Mesh *mesh, size_t triangle, float corners[9])
{
    for (size_t k = 0; k < 9; k++)
        corners[k] = mesh->positions[3 * (size_t)mesh->indices[3 * triangle + k / 3] + k % 3];
}

// The voxels from first to last (none where last < first) that are less than `margin` from the triangle's box along each axis.
static void box_around(const float corners[9], const VoxelGrid *grid, double margin, int first[3],
                       int last[3])
{
    for (int k = 0; k < 3; k++) {
        double lower = INFINITY, upper = -INFINITY;
        for (int v = 0; v < 3; v++) {
            double voxels = ((double)corners[3 * v + k] - grid->origin[k]) / grid->voxel_size;
            lower = fmin(lower, voxels);
            upper = fmax(upper, voxels);
        }
        first[k] = (int)fmin(fmax(floor(lower - margin) - 1.0, 0.0), grid->size[k]);
        last[k] = (int)fmax(fmin(ceil(upper + margin), grid->size[k] - 1.0), -1.0);
    }
}

// The next extra voxel of a row at x or after it, up to `last`; past it where there is none.
static int next_extra(const Extra *extra, size_t row, int x, int last)
{
    while (x <= last) {
        const size_t i = row + (size_t)x;
        const uint32_t rest = extra->words[i >> 5] >> (i & 31);
        if (rest)
            return x + __builtin_ctz(rest);
        x += 32 - (int)(i & 31);
    }
    return x;
}

static void ask_triangle(Extra *extra, const VoxelGrid *grid, const float corners[9], double margin)
{
    int first[3], last[3];
    box_around(corners, grid, margin, first, last);
    for (int z = first[2]; z <= last[2]; z++)
        for (int y = first[1]; y <= last[1]; y++) {
            const size_t row = ((size_t)z * (size_t)grid->size[1] + (size_t)y) * (size_t)grid->size[0];
            for (int x = next_extra(extra, row, first[0], last[0]); x <= last[0];
                 x = next_extra(extra, row, x + 1, last[0])) {
                const size_t i = row + (size_t)x;
                const uint32_t below = extra->words[i >> 5] & ((UINT32_C(1) << (i & 31)) - 1);
                double *least = &extra->gaps[extra->before[i >> 5] + (size_t)__builtin_popcount(below)];
                if (*least <= 0.0)
                    continue;
                *least = fmin(*least, truth_voxel_gap(corners, grid, (int[]){x, y, z}));
            }
        }
}

double extra_gap(const Mesh *mesh, const VoxelGrid *grid, const uint32_t *got, const uint32_t *truth)
{
    Extra extra = find_extra(grid, got, truth);
    double most = 0.0, margin = 1.0, side = fmax(grid->size[0], fmax(grid->size[1], grid->size[2]));
    // A gap of at most `margin` is the least: whatever is nearer reaches into the same box. Else look farther.
    while (extra.count > 0) {
        for (size_t t = 0; t < mesh->triangle_count; t++) {
            float corners[9];
            triangle_corners(mesh, t, corners);
            ask_triangle(&extra, grid, corners, margin);
        }
        most = 0.0;
        for (size_t i = 0; i < extra.count; i++)
            most = fmax(most, extra.gaps[i]);
        if (most <= margin || margin > side)
            break;
        margin *= 8.0;
    }
    free(extra.words);
    free(extra.before);
    free(extra.gaps);
    return most;
}
