// Attributes of chapter 01's voxels against sums in double over truth's voxels of each triangle. Listing 4.9: test_01_average.c.
#include "attribute_bench.h"
#include "failure.h"
#include "threads_bench.h"
#include "truth.h"

#include <sys/wait.h>
#include <unistd.h>

static uint32_t random_bits(uint32_t *state) // xorshift32 (Marsaglia 2003)
{
    *state ^= *state << 13;
    *state ^= *state >> 17;
    return *state ^= *state << 5;
}

static float uniform(uint32_t *state) // [0, 1)
{
    return (float)(random_bits(state) >> 8) * 0x1p-24f;
}

// Triangles of all sizes in a grid of 12³, of random colours.
static Scene *make_heap(int triangles)
{
    Scene *scene = open_empty();
    uint32_t state = 11;
    for (int i = 0; i < triangles; i++) {
        vec3 p[3] = {0};
        for (int k = 0; k < 9; k++)
            p[k / 3][k % 3] =
                k < 3 || i % 4 == 0 ? 12 * uniform(&state) : p[0][k % 3] + 2 * uniform(&state) - 1;
        vec3 albedo = vec3_make(uniform(&state), uniform(&state), uniform(&state));
        add_triangle(scene, p[0], p[1], p[2], scene_add_material(scene, "", albedo, vec3_make(0, 0, 0)));
    }
    return scene;
}

static const VoxelGrid heap_grid = {{0, 0, 0}, 1.0, {12, 12, 12}};

// The bits of one triangle, by truth.
static uint32_t *truth_of(const Scene *scene, size_t triangle, const VoxelGrid *grid)
{
    Mesh one = scene->mesh;
    one.triangle_count = 1;
    one.indices += 3 * triangle;
    return truth_voxels(&one, grid);
}

static int by_pair(const void *a, const void *b)
{
    uint64_t p = *(const uint64_t *)a, q = *(const uint64_t *)b;
    return p < q ? -1 : p > q;
}

// (voxel, triangle) of each, sorted; the caller frees.
static uint64_t *truth_fragments(const Scene *scene, const VoxelGrid *grid, size_t *count)
{
    uint64_t *pairs = NULL;
    *count = 0;
    for (size_t t = 0; t < scene->mesh.triangle_count; t++) {
        uint32_t *bits = truth_of(scene, t, grid);
        for (size_t i = 0; i < grid_voxels(grid); i++)
            if (bits[i >> 5] >> (i & 31) & 1) {
                pairs = memory_grow(pairs, *count + 1, sizeof *pairs, "pairs");
                pairs[(*count)++] = (uint64_t)i << 32 | t;
            }
        free(bits);
    }
    if (pairs)
        qsort(pairs, *count, sizeof *pairs, by_pair);
    return pairs;
}

Test(attributes, means_are_right_in_every_voxel)
{
    Scene *scene = make_heap(400);
    size_t count;
    uint64_t *pairs = truth_fragments(scene, &heap_grid, &count);
    for (int way = 0; way < 2; way++) { // as it comes; all drawn
        Bench bench = bench_open(scene, &heap_grid, way ? 0.01f : 0);
        Fragments from = fragments_of(&bench);
        attributes_sum(&bench.attributer, &from, &bench.attributes);
        VoxelAttributes *read = attributes_read(&bench.attributes);
        size_t slot = 0, most = 0;
        for (size_t i = 0; i < count; slot++) {
            double albedo[3] = {0}, normal[3] = {0};
            uint32_t fragments = 0;
            for (uint64_t voxel = pairs[i] >> 32; i < count && pairs[i] >> 32 == voxel; i++, fragments++) {
                const uint32_t t = (uint32_t)pairs[i], *index = scene->mesh.indices + 3 * (size_t)t;
                double e[2][3], n[3], length = 0;
                for (int k = 0; k < 6; k++)
                    e[k / 3][k % 3] = (double)scene->mesh.positions[3 * index[k / 3 + 1] + (uint32_t)k % 3] -
                                      (double)scene->mesh.positions[3 * index[0] + (uint32_t)k % 3];
                for (int k = 0; k < 3; k++) {
                    n[k] = e[0][(k + 1) % 3] * e[1][(k + 2) % 3] - e[0][(k + 2) % 3] * e[1][(k + 1) % 3];
                    length += n[k] * n[k];
                }
                for (int k = 0; k < 3; k++) {
                    normal[k] += n[k] / sqrt(length);
                    albedo[k] += (double)scene->materials[scene->mesh.triangle_material[t]].albedo[k];
                }
            }
            cr_assert(slot < bench.attributes.slots && read[slot].fragments == fragments,
                      "slot %zu: %u fragments of %u", slot, read[slot].fragments, fragments);
            for (int k = 0; k < 3; k++) {
                cr_assert(fabs((double)read[slot].albedo[k] - albedo[k] / fragments) <= ALBEDO_OFF,
                          "slot %zu: albedo", slot);
                cr_assert(fabs((double)read[slot].normal[k] - normal[k] / fragments) <= NORMAL_OFF,
                          "slot %zu: normal", slot);
            }
            most = fragments > most ? fragments : most;
        }
        cr_assert_eq(slot, bench.attributes.slots, "%zu voxels of %u", slot, bench.attributes.slots);
        cr_assert(most > 10, "voxels with several fragments: %zu", most);
        free(read);
        bench_close(&bench);
    }
    free(pairs);
    scene_close(scene);
}

// Two thirds of the triangles are dark, in any order: the mean is theirs. Both counts that 8 and 16 bits cannot hold.
Test(attributes, means_are_right_with_more_fragments_than_8_and_16_bits_count, .timeout = 60)
{
    const uint32_t counts[] = {300, 70000};
    const VoxelGrid one = {{-1, -1, -1}, 2.0, {1, 1, 1}};
    for (int c = 0; c < 2; c++) {
        Scene *scene = open_empty();
        uint32_t dark = scene_add_material(scene, "dark", vec3_make(0.1f, 0.2f, 0.0f), vec3_make(0, 0, 0));
        uint32_t light = scene_add_material(scene, "light", vec3_make(0.9f, 0.2f, 1.0f), vec3_make(0, 0, 0));
        for (uint32_t i = 0; i < counts[c]; i++) {
            float x = 0.5f * (float)i / (float)counts[c];
            add_triangle(scene, vec3_make(x, 0, 0), vec3_make(x + 0.25f, 0, 0),
                         vec3_make(x, i % 2 ? 0.25f : 0, i % 2 ? 0 : 0.25f), i % 3 == 0 ? light : dark);
        }
        for (int way = 0; way < 2; way++) {
            Bench bench = bench_open(scene, &one, way ? 0.01f : 0);
            Fragments from = fragments_of(&bench);
            attributes_sum(&bench.attributer, &from, &bench.attributes);
            VoxelAttributes *read = attributes_read(&bench.attributes);
            cr_assert_eq(read->fragments, counts[c], "%u fragments of %u", read->fragments, counts[c]);
            const double expected[] = {(0.1 * 2 + 0.9) / 3, 0.2, 1.0 / 3};
            double off = ALBEDO_OFF + 1e-2 / counts[c]; // not quite a third of them
            for (int k = 0; k < 3; k++)
                cr_assert(fabs((double)read->albedo[k] - expected[k]) <= off + 0.7 / counts[c],
                          "%u: albedo %d is %g of %g", counts[c], k, (double)read->albedo[k], expected[k]);
            // half face +z, half -y: (x, 0, 0.25) seen from x is z, so the cross product points along -y
            cr_assert(fabs((double)read->normal[2] - 0.5) <= NORMAL_OFF &&
                          fabs((double)read->normal[1] + 0.5) <= NORMAL_OFF &&
                          fabs((double)read->normal[0]) <= NORMAL_OFF,
                      "normal %g %g %g", (double)read->normal[0], (double)read->normal[1],
                      (double)read->normal[2]);
            free(read);
            // all of them in one voxel's list, each triangle once
            cr_assert_eq(fragment_list_count(&bench.attributer, &from, &bench.attributes), counts[c],
                         "counted");
            fragment_list_fill(&bench.attributer, &from, &bench.attributes);
            uint32_t *listed = fragment_list_read(&bench.attributes);
            bool *seen = memory_new(counts[c], sizeof *seen, "triangles seen");
            for (uint32_t i = 0; i < counts[c]; i++) {
                cr_assert(listed[2 * i] == 0 && listed[2 * i + 1] < counts[c] && !seen[listed[2 * i + 1]],
                          "%u: voxel %u, triangle %u", i, listed[2 * i], listed[2 * i + 1]);
                seen[listed[2 * i + 1]] = true;
            }
            free(listed);
            free(seen);
            bench_close(&bench);
        }
        scene_close(scene);
        gl_close();
    }
}

static uint32_t *sums_of(const Attributes *attributes)
{
    uint32_t *sums = memory_new(7 * (size_t)attributes->slots + 1, sizeof *sums, "sums");
    gl_buffer_read(attributes->sums, 0, 28 * (size_t)attributes->slots, sums);
    return sums;
}

// Bit for bit, in any order, drawn or not, listed or not.
Test(attributes, the_list_drops_no_fragment_and_its_sums_are_the_same)
{
    Scene *scene = make_heap(300);
    size_t count;
    uint64_t *pairs = truth_fragments(scene, &heap_grid, &count);
    const float sides[] = {0, 0.01f, 100.0f};
    uint32_t *first = NULL;
    for (int way = 0; way < 3; way++) {
        Bench bench = bench_open(scene, &heap_grid, sides[way]);
        Fragments from = fragments_of(&bench);
        attributes_sum(&bench.attributer, &from, &bench.attributes);
        uint32_t *direct = sums_of(&bench.attributes);
        cr_assert_eq(fragment_list_count(&bench.attributer, &from, &bench.attributes), count, "counted");
        fragment_list_fill(&bench.attributer, &from, &bench.attributes);
        uint32_t *listed = fragment_list_read(&bench.attributes);
        uint64_t *sorted = memory_new(count, sizeof *sorted, "pairs");
        for (size_t i = 0; i < count; i++)
            sorted[i] = (uint64_t)listed[2 * i] << 32 | listed[2 * i + 1];
        qsort(sorted, count, sizeof *sorted, by_pair);
        cr_assert_eq(memcmp(sorted, pairs, count * sizeof *pairs), 0,
                     "way %d: each fragment is in the list, once", way);
        fragment_list_sum(&bench.attributer, &from, &bench.attributes);
        uint32_t *later = sums_of(&bench.attributes);
        cr_assert_eq(memcmp(direct, later, 28 * (size_t)bench.attributes.slots), 0, "way %d: the list's sums",
                     way);
        if (first)
            cr_assert_eq(memcmp(direct, first, 28 * (size_t)bench.attributes.slots), 0,
                         "way %d: the same sums", way);
        // 28 bytes a set voxel, 8 a fragment, a rank a word
        cr_assert_eq(attributes_bytes(&bench.attributes),
                     28 * (size_t)bench.attributes.slots + 8 * count + 4 * grid_words(&heap_grid), "bytes");
        free(listed);
        free(sorted);
        free(later);
        if (first)
            free(direct);
        else
            first = direct;
        bench_close(&bench);
        // the same triangles, the last first
        Mesh *mesh = &scene->mesh;
        for (size_t i = 0; i < mesh->triangle_count / 2; i++) {
            size_t j = mesh->triangle_count - 1 - i;
            for (size_t k = 0; k < 3; k++) {
                uint32_t index = mesh->indices[3 * i + k];
                mesh->indices[3 * i + k] = mesh->indices[3 * j + k];
                mesh->indices[3 * j + k] = index;
            }
            uint32_t material = mesh->triangle_material[i];
            mesh->triangle_material[i] = mesh->triangle_material[j];
            mesh->triangle_material[j] = material;
        }
        free(pairs);
        pairs = truth_fragments(scene, &heap_grid, &count); // triangles have other numbers
    }
    free(first);
    free(pairs);
    scene_close(scene);
}

static uint64_t hash_of_heap(const char *triangles)
{
    Scene *scene = make_heap(atoi(triangles));
    Bench bench = bench_open(scene, &heap_grid, 0);
    Fragments from = fragments_of(&bench);
    attributes_sum(&bench.attributer, &from, &bench.attributes);
    uint32_t *sums = sums_of(&bench.attributes);
    size_t count = fragment_list_count(&bench.attributer, &from, &bench.attributes);
    fragment_list_fill(&bench.attributer, &from, &bench.attributes);
    uint32_t *listed = fragment_list_read(&bench.attributes);
    uint64_t *sorted = memory_new(count, sizeof *sorted, "pairs");
    for (size_t k = 0; k < count; k++)
        sorted[k] = (uint64_t)listed[2 * k] << 32 | listed[2 * k + 1];
    qsort(sorted, count, sizeof *sorted, by_pair);
    const uint64_t hash = hash_bytes(HASH_START, sums, 28 * (size_t)bench.attributes.slots);
    return count > 10000 ? hash_bytes(hash, sorted, count * sizeof *sorted) : 0;
}
Test(attributes, any_number_of_threads_gives_the_same_sums_and_list)
{
    cr_assert_eq(hash_with_threads("0", hash_of_heap, "2000"), hash_with_threads("4", hash_of_heap, "2000"),
                 "one thread and four");
}

// No triangle in the grid, and none at all.
Test(attributes, nothing_has_no_attributes)
{
    Scene *scene = open_empty();
    for (int way = 0; way < 2; way++) {
        Bench bench = bench_open(scene, &heap_grid, 0);
        Fragments from = fragments_of(&bench);
        attributes_sum(&bench.attributer, &from, &bench.attributes);
        cr_assert_eq(bench.attributes.slots, 0u, "no voxel");
        cr_assert_eq(fragment_list_count(&bench.attributer, &from, &bench.attributes), UINT64_C(0),
                     "no fragment");
        fragment_list_fill(&bench.attributer, &from, &bench.attributes);
        fragment_list_sum(&bench.attributer, &from, &bench.attributes);
        free(attributes_read(&bench.attributes));
        bench_close(&bench);
        scene_add_material(scene, "", vec3_make(1, 1, 1), vec3_make(0, 0, 0));
        add_triangle(scene, vec3_make(20, 20, 20), vec3_make(21, 20, 20), vec3_make(20, 21, 20), 0);
    }
    scene_close(scene);
}

static void read_too_many(void)
{
    Scene *scene = open_empty();
    scene_add_material(scene, "", vec3_make(1, 1, 1), vec3_make(0, 0, 0));
    add_triangle(scene, vec3_make(1, 1, 1), vec3_make(1.5f, 1, 1), vec3_make(1, 1.5f, 1), 0);
    Bench bench = bench_open(scene, &(VoxelGrid){{0, 0, 0}, 4.0, {1, 1, 1}}, 0);
    Fragments from = fragments_of(&bench);
    attributes_sum(&bench.attributer, &from, &bench.attributes);
    const uint32_t many = ATTRIBUTES_MOST + 1;
    gl.NamedBufferSubData(bench.attributes.sums, 0, sizeof many, &many);
    attributes_read(&bench.attributes);
}

Test(attributes, more_fragments_than_a_sum_holds_are_refused)
{
    Failure failure = failure_of(read_too_many);
    cr_assert_eq(failure.status, 1, "the work failed: %d", failure.status);
    cr_assert(failure_says(&failure, "4198405 fragments"), "%s", failure.message);
}
