// attributes_truth: see attributes_truth.h. It shares nothing with the shaders: other fragments, other arithmetic.
#include "attributes_truth.h"
#include <stdlib.h>

// Set bits before each word's first.
static uint32_t *rank_words(const uint32_t *bits, size_t words)
{
    uint32_t *ranks = memory_new(words + 1, sizeof *ranks, "the true voxels' ranks");
    for (size_t i = 0; i < words; i++)
        ranks[i + 1] = ranks[i] + (uint32_t)__builtin_popcount(bits[i]);
    return ranks;
}

// The part of the grid that a triangle's box reaches, a voxel more on each side; false where there is none. Its origin is a voxel's corner of
// the grid, exact in double as all of them.
static bool part_of(const Mesh *mesh, size_t triangle, const VoxelGrid *grid, VoxelGrid *part, int first[3])
{
    part->voxel_size = grid->voxel_size;
    for (size_t k = 0; k < 3; k++) {
        double least = INFINITY, most = -INFINITY;
        for (size_t v = 0; v < 3; v++) {
            double at =
                ((double)mesh->positions[3 * (size_t)mesh->indices[3 * triangle + v] + k] - grid->origin[k]) /
                grid->voxel_size;
            least = fmin(least, at), most = fmax(most, at);
        }
        first[k] = (int)fmin(fmax(floor(least) - 1.0, 0.0), grid->size[k]);
        part->size[k] = (int)fmin(fmax(floor(most) + 2.0, 0.0), grid->size[k]) - first[k];
        part->origin[k] = grid->origin[k] + first[k] * grid->voxel_size;
        if (part->size[k] <= 0)
            return false;
    }
    return true;
}

static void unit_normal(const Mesh *mesh, size_t triangle, double normal[3])
{
    const uint32_t *index = mesh->indices + 3 * triangle;
    double edge[2][3], most = 0.0, squared = 0.0;
    for (size_t e = 0; e < 2; e++)
        for (size_t k = 0; k < 3; k++)
            edge[e][k] = (double)mesh->positions[3 * (size_t)index[e + 1] + k] -
                         (double)mesh->positions[3 * (size_t)index[0] + k];
    for (int k = 0; k < 3; k++) {
        normal[k] = edge[0][(k + 1) % 3] * edge[1][(k + 2) % 3] - edge[0][(k + 2) % 3] * edge[1][(k + 1) % 3];
        most = fmax(most, fabs(normal[k]));
    }
    for (int k = 0; k < 3; k++)
        squared += pow(normal[k] / most, 2.0);
    for (int k = 0; k < 3; k++)
        normal[k] /= most * sqrt(squared);
}

// Add the triangle to every voxel that it touches.
static void add_triangle(const Scene *scene, size_t triangle, const VoxelGrid *grid, const uint32_t *bits,
                         const uint32_t *ranks, TrueMean *sums)
{
    VoxelGrid part;
    int first[3];
    if (!part_of(&scene->mesh, triangle, grid, &part, first))
        return;
    Mesh alone = scene->mesh;
    alone.triangle_count = 1;
    alone.indices += 3 * triangle;
    uint32_t *touched = truth_voxels(&alone, &part);
    double normal[3];
    unit_normal(&scene->mesh, triangle, normal);
    const vec3 albedo = scene->materials[scene->mesh.triangle_material[triangle]].albedo;
    const size_t row = (size_t)part.size[0], column = (size_t)part.size[1];
    for (size_t i = 0; i < grid_voxels(&part); i++)
        if (touched[i >> 5] >> (i & 31) & 1) {
            size_t x = (size_t)first[0] + i % row, y = (size_t)first[1] + i / row % column,
                   z = (size_t)first[2] + i / row / column;
            size_t at = (z * (size_t)grid->size[1] + y) * (size_t)grid->size[0] + x;
            if (!(bits[at >> 5] >> (at & 31) & 1))
                continue; // touched by less than the rounding of the part's corner
            uint32_t before = bits[at >> 5] & ((UINT32_C(1) << (at & 31)) - 1);
            TrueMean *sum = &sums[ranks[at >> 5] + (uint32_t)__builtin_popcount(before)];
            sum->fragments += 1.0;
            for (int k = 0; k < 3; k++) {
                sum->albedo[k] += (double)albedo[k];
                sum->normal[k] += normal[k];
            }
        }
    free(touched);
}

TrueMean *attributes_truth(const Scene *scene, const VoxelGrid *grid, size_t *count)
{
    uint32_t *bits = truth_voxels(&scene->mesh, grid), *ranks = rank_words(bits, grid_words(grid));
    *count = ranks[grid_words(grid)];
    TrueMean *means = memory_new(*count + 1, sizeof *means, "true attributes");
    for (size_t i = 0; i < scene->mesh.triangle_count; i++)
        add_triangle(scene, i, grid, bits, ranks, means);
    for (size_t i = 0; i < *count; i++)
        for (int k = 0; k < 3; k++) {
            means[i].albedo[k] /= fmax(means[i].fragments, 1.0);
            means[i].normal[k] /= fmax(means[i].fragments, 1.0);
        }
    free(ranks);
    free(bits);
    return means;
}

AttributesError attributes_error(const Scene *scene, const Attributes *stored, bool averaged)
{
    size_t count;
    TrueMean *means = attributes_truth(scene, &stored->voxels.grid, &count);
    VoxelAttributes *sums = averaged ? NULL : attributes_read(stored);
    uint32_t *averages = averaged ? attributes_read_averages(stored) : NULL;
    AttributesError error = {0};
    if (count != stored->slots)
        error = (AttributesError){INFINITY, INFINITY, INFINITY};
    for (size_t i = 0; i < 3 * count && count == stored->slots; i++) {
        double got =
            averaged ? averages[i / 3] >> (8 * (i % 3)) & 255 : 255.0 * (double)sums[i / 3].albedo[i % 3];
        double off = got - 255.0 * means[i / 3].albedo[i % 3];
        error.mean += fabs(off) / (3.0 * (double)count);
        error.bias += off / (3.0 * (double)count);
        error.worst = fmax(error.worst, fabs(off));
    }
    free(averages);
    free(sums);
    free(means);
    return error;
}
