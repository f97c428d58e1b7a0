// truth_voxels: which voxels triangles touch, by separating axes in double (Akenine-Möller, "Fast 3D Triangle-Box Overlap Testing",
// 2001), and how far from touching they are. One thread, one order: the result depends on nothing but the input.
//
// Lengths are doubled and relative to the middle of a box, r = 2(vertex − origin) − (first + end)·h for the box of voxels first … end−1, so
// that its half extent is (end − first)·h. With float32 vertices, origin and h these are exact in all but freak cases, and so is every
// projection where the coordinates lie on a lattice of up to 2^16 steps: what touches there in a point is found to touch. Products of up
// to six float32 values neither over- nor underflow in double.
#include "truth.h"

typedef double Double3 __attribute__((vector_size(32))); // as vec3: the last lane is 0

typedef struct Separation {
    Double3 twice[3]; // 2(vertex − origin)
    Double3 axis[13]; // coordinate axes, normal, 9 × (edge × coordinate axis)
    double scale[13]; // 2h × the axis' length
    int axis_count;
    double voxel_size, slack, spread; // slack: see mark; spread: see truth_gap_bound
} Separation;

// Unlike fmin and fmax these are one instruction; nothing here is NaN.
#define LESSER(a, b)  ((a) < (b) ? (a) : (b))
#define GREATER(a, b) ((a) > (b) ? (a) : (b))

static double dot(Double3 a, Double3 b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// a·b − c·d within two roundings of itself, however much cancels (Kahan's algorithm; Jeannerod, Louvet, Muller 2013).
static double product_difference(double a, double b, double c, double d)
{
    double cd = c * d;
    return fma(a, b, -cd) + fma(-c, d, cd);
}

// What a − b loses when it is rounded (Knuth's TwoSum, exact).
static double difference_residue(double a, double b)
{
    double difference = a - b, b_part = a - difference, a_part = difference + b_part;
    return (a - a_part) - (b - b_part);
}

// An axis of zero length (an edge along its coordinate axis) separates nothing and cannot be normalised; any other, however short, is
// accurate (see truth_gap_bound) and kept.
static void add_axis(Separation *s, Double3 axis)
{
    if (axis[0] == 0.0 && axis[1] == 0.0 && axis[2] == 0.0)
        return;
    s->axis[s->axis_count] = axis;
    s->scale[s->axis_count++] = 2.0 * s->voxel_size * sqrt(dot(axis, axis));
}

static Separation separation_of(const float triangle[9], const VoxelGrid *grid)
{
    Separation s = {.voxel_size = grid->voxel_size, .slack = grid->voxel_size};
    Double3 edge[3] = {0}, normal = {0}, sums = {0};
    bool rounded = false;
    for (int v = 0; v < 3; v++)
        for (int k = 0; k < 3; k++) {
            double here = triangle[3 * v + k], next = triangle[(3 * v + 3 + k) % 9];
            edge[v][k] = next - here;
            rounded = rounded || difference_residue(next, here) != 0.0;
            s.twice[v][k] = 2.0 * (here - grid->origin[k]);
            s.slack = GREATER(s.slack, grid->voxel_size + 0x1p-46 * fabs(s.twice[v][k]));
        }
    for (int k = 0; k < 3; k++) {
        int a = (k + 1) % 3, b = (k + 2) % 3;
        add_axis(&s, (Double3){k == 0, k == 1, k == 2});
        normal[k] = product_difference(edge[0][a], edge[1][b], edge[0][b], edge[1][a]);
        sums[k] = fabs(edge[0][a] * edge[1][b]) + fabs(edge[0][b] * edge[1][a]);
    }
    add_axis(&s, normal);
    for (int v = 0; v < 3; v++) {
        add_axis(&s, (Double3){0.0, -edge[v][2], edge[v][1]});
        add_axis(&s, (Double3){edge[v][2], 0.0, -edge[v][0]});
        add_axis(&s, (Double3){-edge[v][1], edge[v][0], 0.0});
    }
    if (rounded)
        s.spread = dot(normal, normal) > 0.0 ? sqrt(dot(sums, sums) / dot(normal, normal)) : INFINITY;
    return s;
}

// The largest gap between the projections of the triangle and of the box of voxels first … end−1, grown by `slack`, in voxels; the first
// above `enough` will do.
static double gap(const Separation *s, const int first[3], const int end[3], double slack, double enough)
{
    Double3 r[3] = {s->twice[0], s->twice[1], s->twice[2]};
    double half[3], largest = -INFINITY;
    for (int k = 0; k < 3; k++) {
        half[k] = (end[k] - first[k]) * s->voxel_size + slack;
        for (int v = 0; v < 3; v++)
            r[v][k] -= (first[k] + end[k]) * s->voxel_size;
    }
    for (int i = 0; i < s->axis_count && !(largest > enough); i++) {
        Double3 a = s->axis[i];
        double t0 = dot(a, r[0]), t1 = dot(a, r[1]), t2 = dot(a, r[2]);
        double apart = GREATER(LESSER(t0, LESSER(t1, t2)), -GREATER(t0, GREATER(t1, t2)));
        double radius = half[0] * fabs(a[0]) + half[1] * fabs(a[1]) + half[2] * fabs(a[2]);
        largest = GREATER(largest, (apart - radius) / s->scale[i]);
    }
    return largest;
}

// Halve the box of voxels until the triangle misses it or one voxel is left, so that one triangle over the whole grid costs what it touches.
// Blocks are grown by s->slack, more than their rounding, so that none is left out whose voxel touches: that is for single voxels to say.
static void mark(const Separation *s, const VoxelGrid *grid, const int first[3], const int end[3],
                 uint32_t *voxels)
{
    int size[3] = {end[0] - first[0], end[1] - first[1], end[2] - first[2]};
    int k = size[0] >= size[1] && size[0] >= size[2] ? 0 : size[1] >= size[2] ? 1 : 2; // the longest
    if (gap(s, first, end, size[k] > 1 ? s->slack : 0.0, 0.0) > 0.0)
        return;
    if (size[k] == 1) {
        size_t row = (size_t)first[2] * (size_t)grid->size[1] + (size_t)first[1],
               i = row * (size_t)grid->size[0] + (size_t)first[0];
        voxels[i >> 5] |= UINT32_C(1) << (i & 31);
        return;
    }
    int low_end[3] = {end[0], end[1], end[2]}, high_first[3] = {first[0], first[1], first[2]};
    low_end[k] = high_first[k] = first[k] + size[k] / 2;
    mark(s, grid, first, low_end, voxels);
    mark(s, grid, high_first, end, voxels);
}

static Separation separation_in(const Mesh *mesh, size_t index, const VoxelGrid *grid)
{
    float triangle[9];
    for (size_t i = 0; i < 9; i++)
        triangle[i] = mesh->positions[3 * (size_t)mesh->indices[3 * index + i / 3] + i % 3];
    return separation_of(triangle, grid);
}

// Grow lower … upper, in voxels from the origin, by the triangle.
static void extend(const Separation *s, Double3 *lower, Double3 *upper)
{
    for (int v = 0; v < 3; v++)
        for (int k = 0; k < 3; k++) {
            (*lower)[k] = LESSER((*lower)[k], s->twice[v][k] / (2.0 * s->voxel_size));
            (*upper)[k] = GREATER((*upper)[k], s->twice[v][k] / (2.0 * s->voxel_size));
        }
}

uint32_t *truth_voxels(const Mesh *mesh, const VoxelGrid *grid)
{
    uint32_t *voxels = memory_new(grid_words(grid), sizeof *voxels, "true voxels");
    for (size_t t = 0; t < mesh->triangle_count; t++) {
        Separation s = separation_in(mesh, t, grid);
        Double3 lower = {INFINITY, INFINITY, INFINITY}, upper = -lower;
        extend(&s, &lower, &upper);
        int first[3], end[3];
        bool inside = true;
        for (
            int k = 0; k < 3;
            k++) { // one voxel more on either side: the quotient is rounded, and a touched face belongs to two
            first[k] = (int)LESSER(GREATER(floor(lower[k]) - 1.0, 0.0), grid->size[k]);
            end[k] = (int)LESSER(GREATER(floor(upper[k]) + 2.0, 0.0), grid->size[k]);
            inside = inside && first[k] < end[k];
        }
        if (inside)
            mark(&s, grid, first, end, voxels);
    }
    return voxels;
}

double truth_voxel_gap(const float triangle[9], const VoxelGrid *grid, const int voxel[3])
{
    Separation s = separation_of(triangle, grid);
    return gap(&s, voxel, (int[]){voxel[0] + 1, voxel[1] + 1, voxel[2] + 1}, 0.0, INFINITY);
}

// Proof, with u = 2^-53, γ_n = n·u/(1 − n·u) and the standard model fl(x op y) = (x op y)(1 + δ), |δ| ≤ u; (first + end)·h is exact.
// Let S_k be the extent of mesh and grid together along k, in voxels, and L = 2h·|S|₂. Then |r| ≤ L, and as S_k ≥ 1 the box's half
// extents (doubled, h) have |(h, h, h)|₂ ≤ L/2.
//  1. Axis. Let p be the exact unit axis, q the computed one normalised exactly, and η the relative error (2-norm) of the computed one.
//     |q − p| ≤ 2η, so the gap along q differs from that along p by ≤ 2η·(L + L/2) = 3ηL.
//     An edge's components are single roundings: η ≤ u. A normal from exact edges: η ≤ 2u (product_difference). From rounded edges its
//     components err by ≤ 2u·(|e_a f_b| + |e_b f_a|) more; `spread` is the length of these sums over the normal's.
//  2. Gap along q (times |q|, left out): r errs by u·L (vertex − origin) and u·L (− middle), the dot product by γ_3·L, together 5u·L; the
//     box's radius by γ_3·L/2; their difference, ≤ 1.5L, rounds: 8u·L in all.
//  3. Division by `scale`: γ_3/2 + u for the length, u for the product, u for the quotient: 4.5u of a gap ≤ 1.5L, 6.75u·L.
// Sum, ÷ 2h: (14.75u + 3·2u + 6u·spread)·|S|₂ voxels. A maximum of 13 values errs by no more than the worst of them. 22 for 20.75 and 7 for
// 6 hold the terms in u² and the rounding of the bound itself.
double truth_gap_bound(const Mesh *mesh, const VoxelGrid *grid)
{
    Double3 lower = {0}, upper = {grid->size[0], grid->size[1], grid->size[2]};
    double spread = 0.0;
    for (size_t t = 0; t < mesh->triangle_count; t++) {
        Separation s = separation_in(mesh, t, grid);
        extend(&s, &lower, &upper);
        spread = GREATER(spread, s.spread);
    }
    return 0x1p-53 * (22.0 + 7.0 * spread) * sqrt(dot(upper - lower, upper - lower));
}
