// truth_voxels and truth_voxel_gap against exact integers, closed forms, samples and quadruple precision.
#include "truth.h"

#include <criterion/criterion.h>
#include <stdlib.h>

typedef __float128 Quad;

static uint32_t random_bits(uint32_t *state) // xorshift32 (Marsaglia 2003)
{
    *state ^= *state << 13;
    *state ^= *state >> 17;
    return *state ^= *state << 5;
}

static double uniform(uint32_t *state) // [0, 1)
{
    return random_bits(state) / 4294967296.0;
}

static bool is_set(const uint32_t *voxels, int i)
{
    return voxels[i >> 5] >> (i & 31) & 1;
}

static long count_set(const uint32_t *voxels, const VoxelGrid *grid)
{
    long count = 0;
    for (size_t i = 0; i < grid_voxels(grid); i++)
        count += is_set(voxels, (int)i);
    return count;
}

static void add_triangle(Mesh *mesh, const float p[9])
{
    uint32_t corner[3];
    for (int v = 0; v < 3; v++)
        corner[v] =
            mesh_add_vertex(mesh, vec3_make(p[3 * v], p[3 * v + 1], p[3 * v + 2]), vec3_make(0, 0, 0));
    mesh_add_triangle(mesh, corner[0], corner[1], corner[2], 0);
}

static void mesh_clear(Mesh *mesh)
{
    free(mesh->positions);
    free(mesh->normals);
    free(mesh->indices);
    free(mesh->triangle_material);
    *mesh = (Mesh){0};
}

static uint32_t *voxels_of_one(const float p[9], const VoxelGrid *grid)
{
    Mesh mesh = {0};
    add_triangle(&mesh, p);
    uint32_t *voxels = truth_voxels(&mesh, grid);
    mesh_clear(&mesh);
    return voxels;
}

// A second method, exact and without axes: clip the triangle by the six faces in homogeneous integers and see whether a point is left.
typedef struct Point {
    int64_t x[4]; // x, y, z, w > 0
} Point;
static Point between(const Point *p, int64_t p_weight, const Point *q, int64_t q_weight)
{
    Point r;
    int64_t divisor = 0;
    for (int k = 0; k < 4; k++) {
        r.x[k] = p->x[k] * p_weight + q->x[k] * q_weight;
        for (int64_t b = llabs(r.x[k]), t; b != 0; divisor = b, b = t) // Euclid
            t = divisor % b;
    }
    for (int k = 0; k < 4; k++)          // reduced, a point of triangle and two faces stays below 2^24
        r.x[k] /= divisor ? divisor : 1; // w > 0, so it is not 0
    return r;
}

static bool touches_exactly(const int64_t triangle[9], const int64_t lower[3], const int64_t upper[3])
{
    Point polygon[9], next[9]; // a convex polygon gains at most one corner a plane
    int corners = 3;
    for (int v = 0; v < 3; v++)
        polygon[v] = (Point){{triangle[3 * v], triangle[3 * v + 1], triangle[3 * v + 2], 1}};
    for (int face = 0; face < 6 && corners > 0; face++) {
        int k = face / 2, made = 0;
        for (int c = 0; c < corners; c++) {
            const Point *p = &polygon[c], *q = &polygon[(c + 1) % corners];
            int64_t p_in = face % 2 ? upper[k] * p->x[3] - p->x[k] : p->x[k] - lower[k] * p->x[3];
            int64_t q_in = face % 2 ? upper[k] * q->x[3] - q->x[k] : q->x[k] - lower[k] * q->x[3];
            if (p_in >= 0)
                next[made++] = *p;
            if ((p_in > 0 && q_in < 0) || (p_in < 0 && q_in > 0))
                next[made++] = between(p, llabs(q_in), q, llabs(p_in));
        }
        corners = made;
        for (int c = 0; c < corners; c++)
            polygon[c] = next[c];
    }
    return corners > 0;
}

// Corners on a lattice of quarter voxels, so that faces, edges and corners are often just touched. No tolerance: all is exact.
Test(truth_voxels, agrees_with_exact_clipping_on_a_lattice)
{
    const VoxelGrid grid = {{-1.125, 10.5, 1024.0}, 0.375, {6, 5, 6}};
    uint32_t state = 1;
    long wrong = 0, inconsistent = 0, ties = 0, touched = 0;
    for (int made = 0; made < 10000;) {
        int64_t lattice[9] = {0}, e[6];
        float p[9];
        int64_t reach = made % 2 ? 32 : 8; // large triangles and small ones
        for (int i = 0; i < 9; i++) {
            int64_t base = i < 3 || reach == 32 ? -4 : lattice[i % 3] - 4;
            lattice[i] = base + (int64_t)(random_bits(&state) % (uint32_t)(i < 3 ? 33 : reach + 1));
            p[i] = (float)(grid.origin[i % 3] + (double)lattice[i] * 0.25 * grid.voxel_size);
        }
        for (int i = 0; i < 6; i++)
            e[i] = lattice[3 + i] - lattice[i % 3];
        if (e[0] * e[4] == e[1] * e[3] && e[1] * e[5] == e[2] * e[4] && e[2] * e[3] == e[0] * e[5])
            continue; // no area
        made++;
        uint32_t *voxels = voxels_of_one(p, &grid);
        for (int z = 0; z < grid.size[2]; z++)
            for (int y = 0; y < grid.size[1]; y++)
                for (int x = 0; x < grid.size[0]; x++) {
                    const int64_t lower[3] = {4 * x, 4 * y, 4 * z},
                                  upper[3] = {4 * x + 4, 4 * y + 4, 4 * z + 4};
                    bool expected = touches_exactly(lattice, lower, upper),
                         got = is_set(voxels, (z * grid.size[1] + y) * grid.size[0] + x);
                    wrong += expected != got;
                    touched += got;
                    if (made % 4 == 0) { // preparing the axes anew for every voxel takes its time
                        double gap = truth_voxel_gap(p, &grid, (int[]){x, y, z});
                        inconsistent += got != (gap <= 0.0);
                        ties += gap == 0.0;
                    }
                }
        free(voxels);
    }
    cr_assert_eq(wrong, 0, "%ld voxels differ from exact clipping", wrong);
    cr_assert_eq(inconsistent, 0, "%ld gaps have another sign than the voxel", inconsistent);
    cr_assert(ties > 2000 && touched > 10 * 10000, "only %ld ties among %ld touched voxels", ties, touched);
}

// N³ voxels less the inner ones, for a box from 0.25 to N − 0.25 voxels; exact at any place and size that float32 holds.
Test(truth_voxels, cube_surface)
{
    const double places[4][2] = {
        {0.0, 1.0}, {-1e6, 1.0}, {3.0, 0.375}, {0x1p-20, 0x1.8p-24}}; // origin, voxel size
    for (int place = 0; place < 4; place++)
        for (int n = 2; n <= 34; n += 8) {
            double o = places[place][0], h = places[place][1];
            const VoxelGrid grid = {{o, o, o}, h, {n, n, n}};
            for (int in_faces = 0; in_faces < 2; in_faces++) {
                float a = (float)(o + (in_faces ? 1.0 : 0.25) * h),
                      b = (float)(o + (in_faces ? n - 1 : n - 0.25) * h);
                if (!(a < b)) // the box in faces of n = 2 has no extent
                    continue;
                Mesh mesh = {0};
                mesh_add_box(&mesh, vec3_make(a, a, a), vec3_make(b, b, b), 0);
                uint32_t *voxels = truth_voxels(&mesh, &grid);
                // A box whose sides lie in voxel faces marks both layers: all but (N − 4)³.
                long inner = in_faces ? n - 4 : n - 2, expected = (long)n * n * n - inner * inner * inner;
                long got = count_set(voxels, &grid);
                cr_assert_eq(got, expected, "place %d, %d³, in faces %d: %ld voxels, not %ld", place, n,
                             in_faces, got, expected);
                free(voxels);
                mesh_clear(&mesh);
            }
        }
}

Test(truth_voxels, plane_through_the_whole_grid)
{
    // x + y + z = N touches the voxels whose corner sums are N − 3 … N: triangular numbers, less three corners that lie outside.
    enum { N = 128 };
    const VoxelGrid grid = {{0}, 1.0, {N, N, N}};
    uint32_t *voxels = voxels_of_one((float[]){N, 0, 0, 0, N, 0, 0, 0, N}, &grid);
    long expected = -3, got = count_set(voxels, &grid);
    for (long s = N - 3; s <= N; s++)
        expected += (s + 1) * (s + 2) / 2;
    cr_assert_eq(got, expected, "%ld voxels, not %ld", got, expected);
    free(voxels);

    // Corners 2^100 voxels away: one layer, though r of x and y is rounded by far more than the grid.
    voxels = voxels_of_one(
        (float[]){-0x1p100f, -0x1p100f, 5.5f, 0x1p101f, -0x1p100f, 5.5f, 0, 0x1p101f, 5.5f}, &grid);
    got = count_set(voxels, &grid);
    cr_assert_eq(got, N * N, "%ld voxels in a layer of %d", got, N * N);
    free(voxels);
}

Test(truth_voxels, closed_in_faces_and_at_the_border)
{
    const VoxelGrid grid = {{0}, 1.0, {4, 4, 4}};
    const struct {
        float p[9];
        long expected;
    } cases[] = {
        // In the face z = 2; 13 cells hold a point with x, y ≥ 0.5 and x + y ≤ 4, on both sides.
        {{0.5f, 0.5f, 2, 3.5f, 0.5f, 2, 0.5f, 3.5f, 2}, 26},
        {{0.5f, 0.5f, 4, 3.5f, 0.5f, 4, 0.5f, 3.5f, 4}, 13},                        // in the grid's own face
        {{0.5f, 0.5f, 0x1.000002p2f, 3.5f, 0.5f, 0x1.000002p2f, 0.5f, 3.5f, 5}, 0}, // one float32 above it
        {{2, 2, 2, 2.25f, 2.5f, 2.25f, 2.5f, 2.25f, 2.25f}, 8},                     // a corner on a corner
        {{4, 4, 4, 9, 8, 5, 8, 9, 5}, 1}, // on the grid's corner, from outside
        {{-9, -9, -9, -8, -9, -9, -9, -8, -9}, 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        uint32_t *voxels = voxels_of_one(cases[i].p, &grid);
        long got = count_set(voxels, &grid);
        cr_assert_eq(got, cases[i].expected, "case %zu: %ld voxels, not %ld", i, got, cases[i].expected);
        free(voxels);
    }
    uint32_t *voxels = truth_voxels(&(Mesh){0}, &grid);
    cr_assert_eq(count_set(voxels, &grid), 0, "the empty mesh touches nothing");
    free(voxels);
}

// Families of float32 triangles: 0 anywhere, 1 small, 2 slivers of aspect 10⁶ and more, 3 a million voxels off, 4 coordinates of very
// different size (edges are rounded), 5 far beyond the grid, 6 up to 2^60 voxels beyond it, one edge through its middle.
enum { FAMILIES = 7 };
static VoxelGrid random_triangle(int family, int size, uint32_t *state, float p[9])
{
    double h = (float)((0.5 + uniform(state)) * (family == 1 ? 1e-6 : 1.0) / size),
           away = family == 3 ? 1e6 * h : 0.0;
    VoxelGrid grid = {
        {(float)(away - 0.5 * h * size), (float)(away - 0.3 * h * size), (float)away}, h, {size, size, size}};
    for (int i = 0; i < 9; i++) {
        double reach = family == 1 && i >= 3 ? 3.0 : size,
               base = family == 1 && i >= 3 ? (double)p[i % 3] : grid.origin[i % 3];
        double value = base + (uniform(state) - (i >= 3 && family == 1 ? 0.5 : 0.0)) * h * reach;
        p[i] = (float)(family == 5 ? value + (uniform(state) - 0.5) * 1e5 * h * size : value);
        if (family == 4)
            p[i] = ldexpf(p[i], -(int)(random_bits(state) % 40));
        if (family == 2 && i >= 6)
            p[i] = (float)(0.3 * p[i - 6] + 0.7 * p[i - 3] + (uniform(state) - 0.5) * 1e-6 * h * size);
    }
    if (family == 6) {
        float far = ldexpf((float)h, (int)(random_bits(state) % 60));
        for (int k = 0; k < 3; k++) {
            grid.origin[k] = -0.5 * h * size;
            p[k] = far * (float)(uniform(state) - 0.5);
            p[3 + k] = -p[k];
            p[6 + k] = far * (float)(uniform(state) - 0.5);
        }
    }
    return grid;
}

Test(truth_voxels, blocks_lose_nothing_and_samples_lie_in_set_voxels)
{
    enum { N = 24 };
    uint32_t state = 7;
    for (int i = 0; i < 20 * FAMILIES; i++) {
        float p[9];
        const VoxelGrid grid = random_triangle(i % FAMILIES, N, &state, p);
        uint32_t *voxels = voxels_of_one(p, &grid);
        for (int v = 0; v < N * N * N; v++) {
            const int voxel[3] = {v % N, v / N % N, v / N / N};
            bool touches = truth_voxel_gap(p, &grid, voxel) <= 0.0, set = is_set(voxels, v);
            cr_assert_eq(set, touches, "triangle %d, voxel %d: set %d, by its gap %d", i, v, set, touches);
        }
        for (int sample = 0; sample < 2000 && i % FAMILIES != 6;
             sample++) { // samples of 6 are rounded by voxels
            double u = uniform(&state), v = uniform(&state) * (1.0 - u), margin = 1.0;
            int voxel[3];
            bool inside = true;
            for (int k = 0; k < 3; k++) {
                double q =
                    (p[k] + u * (p[3 + k] - (double)p[k]) + v * (p[6 + k] - (double)p[k]) - grid.origin[k]) /
                    grid.voxel_size;
                inside = inside && q >= 0.0 && q < N;
                voxel[k] = inside ? (int)q : 0;
                margin = fmin(margin, fmin(q - voxel[k], voxel[k] + 1 - q));
            }
            // The sample itself is rounded: by 10⁻⁸ of a voxel at most, for the far family (2·10⁶ voxels · 2^-52 · a few).
            if (inside && margin > 1e-8)
                cr_assert(is_set(voxels, (voxel[2] * N + voxel[1]) * N + voxel[0]),
                          "triangle %d: a sample lies in an empty voxel", i);
        }
        free(voxels);
    }
}

Test(truth_voxels, triangle_order_does_not_matter)
{
    enum { N = 32, TRIANGLES = 300 };
    float p[TRIANGLES][9];
    uint32_t state = 3;
    const VoxelGrid grid = {{0}, 0.1f, {N, N - 3, N + 5}};
    Mesh forward = {0}, backward = {0};
    for (int t = 0; t < TRIANGLES; t++)
        for (int i = 0; i < 9; i++)
            p[t][i] = i < 3 ? (float)(uniform(&state) * 3.2) : p[t][i % 3] + (float)(uniform(&state) - 0.5);
    for (int t = 0; t < TRIANGLES; t++) {
        add_triangle(&forward, p[t]);
        add_triangle(&backward, p[TRIANGLES - 1 - t]);
    }
    uint32_t *a = truth_voxels(&forward, &grid), *b = truth_voxels(&backward, &grid);
    for (size_t i = 0; i < grid_words(&grid); i++)
        cr_assert_eq(a[i], b[i], "word %zu differs", i);
    free(a), free(b);
    mesh_clear(&forward), mesh_clear(&backward);
}

Test(truth_voxel_gap, closed_forms)
{
    const VoxelGrid grid = {{8.0, 8.0, 8.0}, 0.5, {4, 4, 4}};
    const struct {
        float p[9]; // in voxels from the origin
        int voxel[3];
        double expected;
    } cases[] = {
        {{-9, -9, 2.5f, 9, -9, 2.5f, 0, 30, 2.5f}, {1, 1, 1}, 0.5},  // above the top face
        {{-9, -9, 2.5f, 9, -9, 2.5f, 0, 30, 2.5f}, {1, 1, 2}, -0.5}, // through the middle
        {{-9, -9, 2, 9, -9, 2, 0, 30, 2}, {1, 1, 1}, 0.0},           // in the top face
        {{9, 0, -5.25f, 0, 9, -5.25f, -9, -9, 21.75f},
         {0, 0, 0},
         0.4330127018922193}, // x + y + z = 3.75: 0.75/√3 off the corner
        {{4, -1, -3, -1, 4, 4, 6, 6, 0.5f}, {0, 0, 0}, 0.7071067811865476}, // edge to edge: 1/√2
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        float p[9];
        for (int k = 0; k < 9; k++)
            p[k] = 8.0f + 0.5f * cases[i].p[k];
        double got = truth_voxel_gap(p, &grid, cases[i].voxel);
        // 10⁻¹⁴: a few roundings of numbers up to 30.
        cr_assert(fabs(got - cases[i].expected) < 1e-14, "case %zu: %.17g, not %.17g", i, got,
                  cases[i].expected);
    }
}

static Quad quad_gap(const float p[9], const VoxelGrid *grid, const int voxel[3])
{
    Quad r[9], h = grid->voxel_size, largest = -1e30;
    for (int i = 0; i < 9; i++)
        r[i] = (Quad)p[i] - grid->origin[i % 3] - ((Quad)voxel[i % 3] + 0.5) * h;
    for (int axis = 0; axis < 13; axis++) {
        Quad a[3] = {0}, e[9], length, least = 1e30, most = -1e30, radius = 0;
        for (int i = 0; i < 9; i++)
            e[i] = (Quad)p[(i + 3) % 9] - p[i];
        for (int k = 0; k < 3; k++) {
            int k1 = (k + 1) % 3, k2 = (k + 2) % 3;
            if (axis < 3)
                a[k] = k == axis;
            else if (axis == 3)
                a[k] = e[k1] * e[3 + k2] - e[k2] * e[3 + k1];
            else // edge × coordinate axis
                a[k] = e[3 * (axis % 3) + k1] * ((axis - 4) / 3 == k2) -
                       e[3 * (axis % 3) + k2] * ((axis - 4) / 3 == k1);
        }
        Quad square = a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
        if (square == 0)
            continue;
        length = sqrt((double)square);
        for (int step = 0; step < 2; step++) // Newton doubles the 53 right bits
            length = (length + square / length) / 2;
        for (int v = 0; v < 3; v++) {
            Quad t = a[0] * r[3 * v] + a[1] * r[3 * v + 1] + a[2] * r[3 * v + 2];
            least = t < least ? t : least;
            most = t > most ? t : most;
            radius += (a[v] < 0 ? -a[v] : a[v]) * h / 2;
        }
        Quad gap = ((least > -most ? least : -most) - radius) / (length * h);
        largest = gap > largest ? gap : largest;
    }
    return largest;
}

Test(truth_voxel_gap, error_is_below_the_proven_bound)
{
    enum { N = 64 };
    uint32_t state = 5;
    double closest = 0.0;
    for (int i = 0; i < 2000 * FAMILIES; i++) {
        float p[9];
        const VoxelGrid grid = random_triangle(i % FAMILIES, N, &state, p);
        Mesh mesh = {0};
        add_triangle(&mesh, p);
        double bound = truth_gap_bound(&mesh, &grid);
        mesh_clear(&mesh);
        // Anywhere, or about the first corner, where gaps are small and the sign matters.
        int voxel[3];
        for (int k = 0; k < 3; k++) {
            double corner = (p[k] - grid.origin[k]) / grid.voxel_size + 4.0 * uniform(&state) - 2.0;
            voxel[k] =
                i / FAMILIES % 2 && corner >= 0 && corner < N ? (int)corner : (int)(random_bits(&state) % N);
        }
        double error = fabs((double)(truth_voxel_gap(p, &grid, voxel) - quad_gap(p, &grid, voxel)));
        cr_assert(error <= bound, "family %d: error %g, bound %g", i % FAMILIES, error, bound);
        closest = fmax(closest, error / bound);
        // A small part of a voxel, but where rounded edges lose the plane (4) or the grid is nothing beside the triangle (6).
        cr_assert(bound < 1e-6 || i % FAMILIES == 4 || i % FAMILIES == 6, "family %d: bound %g", i % FAMILIES,
                  bound);
    }
    // Sums of worst cases are seldom met; a bound a hundred times too large would still be a careless one.
    cr_assert(closest > 0.01, "the largest error is only %g of its bound", closest);
}
