// solid_truth: see solid_truth.h.
#include "solid_truth.h"
#include <stdlib.h>

// Oblique, so that no row of centres shares a ray and no face of a man-made scene is seen edge on.
enum { DIRECTIONS = 5 };
static const float directions[DIRECTIONS][3] = {{0.36f, 0.48f, 0.8f},
                                                {-0.61f, 0.23f, 0.71f},
                                                {0.13f, -0.94f, 0.29f},
                                                {0.83f, -0.19f, -0.51f},
                                                {-0.27f, -0.33f, -0.9f}};

static bool crosses_odd(const Truth *rays, vec3 from, vec3 way)
{
    bool odd = false;
    uint32_t last = UINT32_MAX;
    for (;;) {
        TruthHit hit = truth_ray(rays, from, way);
        if (!isfinite(hit.distance))
            return odd;
        odd = odd != (hit.triangle != last); // the same one again: the next ray has begun on its near side
        last = hit.triangle;
        from =
            from + (hit.distance * (1.0f + 0x1p-20f) + 0x1p-15f) * way; // in voxels; a little behind the hit
    }
}

uint32_t *solid_truth(const Mesh *mesh, const VoxelGrid *grid)
{
    // in voxels from the grid's corner: centres are exact, and a little is a little of a voxel
    Mesh unit = *mesh;
    unit.positions = memory_new(3 * mesh->vertex_count + 1, sizeof *unit.positions, "the truth's vertices");
    for (size_t i = 0; i < 3 * mesh->vertex_count; i++)
        unit.positions[i] = (float)(((double)mesh->positions[i] - grid->origin[i % 3]) / grid->voxel_size);
    Truth *rays = truth_open(&unit);
    uint32_t *bits = memory_new(grid_words(grid), sizeof *bits, "the true solid");
    const size_t row = (size_t)grid->size[0], column = (size_t)grid->size[1];
    for (size_t i = 0; i < grid_voxels(grid); i++) {
        const size_t at[3] = {i % row, i / row % column, i / row / column};
        vec3 centre = vec3_make((float)at[0] + 0.5f, (float)at[1] + 0.5f, (float)at[2] + 0.5f);
        int inside = 0;
        for (int d = 0; d < DIRECTIONS; d++)
            inside +=
                crosses_odd(rays, centre,
                            vec3_normalize(vec3_make(directions[d][0], directions[d][1], directions[d][2])));
        bits[i >> 5] |= (uint32_t)(2 * inside > DIRECTIONS) << (i & 31);
    }
    truth_close(rays);
    free(unit.positions);
    return bits;
}

uint32_t *shadow_truth(const uint32_t *bits, const VoxelGrid *grid, const char *axis)
{
    const bool against = axis[0] == '-';
    const int k = axis[against] - 'x';
    const size_t stride = k == 0   ? 1
                          : k == 1 ? (size_t)grid->size[0]
                                   : (size_t)grid->size[0] * (size_t)grid->size[1];
    const size_t side = (size_t)grid->size[k];
    uint32_t *shadow = memory_new(grid_words(grid), sizeof *shadow, "the true shadow");
    for (size_t i = 0; i < grid_voxels(grid); i++) {
        size_t at = i / stride % side, first = i - at * stride; // of its column
        bool dark = false;
        for (size_t j = against ? at : 0; j < (against ? side : at + 1) && !dark; j++)
            dark = bits[(first + j * stride) >> 5] >> ((first + j * stride) & 31) & 1;
        shadow[i >> 5] |= (uint32_t)dark << (i & 31);
    }
    return shadow;
}
