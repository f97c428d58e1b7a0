// truth: the lit stretches of a ray, exactly. The plane of ray and light cuts each triangle in a segment; seen from the light, the part of it between
// light and ray covers an interval of the ray. What no interval covers is lit.
#include "truth.h"

#include <stdlib.h>
#include <string.h>

enum { LEAF = 8, DEEPEST = 64 };

typedef struct Node {
    double lower[3], upper[3];
    size_t first, count, right; // count 0: an inner node, its left child comes next
} Node;

struct TruthShadows {
    const Truth *truth;
    double *corners; // 9 a triangle, in the order of the tree's leaves
    Node *nodes;
    size_t node_count;
};

typedef struct Triangle {
    double corner[9], key;
} Triangle;

static int by_key(const void *a, const void *b)
{
    const double x = ((const Triangle *)a)->key, y = ((const Triangle *)b)->key;
    return (x > y) - (x < y);
}

static size_t tree_build(TruthShadows *shadows, Triangle *triangles, size_t first, size_t count)
{
    const size_t at = shadows->node_count++;
    Node node = {.lower = {INFINITY, INFINITY, INFINITY}, .upper = {-INFINITY, -INFINITY, -INFINITY}};
    for (size_t i = first; i < first + count; i++)
        for (int k = 0; k < 9; k++) {
            node.lower[k % 3] = fmin(node.lower[k % 3], triangles[i].corner[k]);
            node.upper[k % 3] = fmax(node.upper[k % 3], triangles[i].corner[k]);
        }
    node.first = first;
    if (count <= LEAF) {
        node.count = count;
    } else {
        int axis = 0;
        for (int k = 1; k < 3; k++)
            axis = node.upper[k] - node.lower[k] > node.upper[axis] - node.lower[axis] ? k : axis;
        for (size_t i = first; i < first + count; i++)
            triangles[i].key =
                triangles[i].corner[axis] + triangles[i].corner[axis + 3] + triangles[i].corner[axis + 6];
        qsort(triangles + first, count, sizeof *triangles, by_key);
        tree_build(shadows, triangles, first, count / 2);
        node.right = tree_build(shadows, triangles, first + count / 2, count - count / 2);
    }
    shadows->nodes[at] = node;
    return at;
}

TruthShadows *truth_shadows_open(const Mesh *mesh, const Truth *truth)
{
    const size_t count = mesh->triangle_count;
    TruthShadows *shadows = memory_new(1, sizeof *shadows, "the truth's shadows");
    Triangle *triangles = memory_new(count + 1, sizeof *triangles, "the truth's triangles");
    shadows->truth = truth;
    shadows->corners = memory_new(9 * count + 1, sizeof(double), "the truth's triangles");
    shadows->nodes = memory_new(2 * count + 1, sizeof(Node), "the truth's tree");
    for (size_t i = 0; i < 9 * count; i++)
        triangles[i / 9].corner[i % 9] =
            (double)mesh->positions[3 * (size_t)mesh->indices[3 * (i / 9) + i % 9 / 3] + i % 3];
    if (count > 0)
        tree_build(shadows, triangles, 0, count);
    for (size_t i = 0; i < count; i++)
        memcpy(shadows->corners + 9 * i, triangles[i].corner, sizeof triangles[i].corner);
    free(triangles);
    return shadows;
}

void truth_shadows_close(TruthShadows *shadows)
{
    if (shadows == NULL)
        return;
    free(shadows->corners);
    free(shadows->nodes);
    free(shadows);
}

// The plane of ray and light: x along the ray, y towards the light, z out of the plane, all from the ray's origin.
typedef struct Plane {
    double origin[3], x[3], y[3], z[3];
    double foot, height; // the light in it; a directional light: its slope x/y is `foot`, height is infinite
} Plane;

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// false where the light lies on the ray's line: then there is no plane
static bool plane_make(Plane *plane, const Light *light, const double origin[3], const double direction[3])
{
    double to_light[3], length = 0.0;
    const bool directional = light->kind == LIGHT_DIRECTIONAL;
    for (int k = 0; k < 3; k++) {
        to_light[k] = directional ? -(double)light->direction[k] : (double)light->position[k] - origin[k];
        plane->origin[k] = origin[k];
        plane->x[k] = direction[k];
        length = hypot(length, to_light[k]);
    }
    plane->foot = dot(to_light, direction);
    plane->height = 0.0;
    for (int k = 0; k < 3; k++) {
        plane->y[k] = to_light[k] - plane->foot * direction[k];
        plane->height = hypot(plane->height, plane->y[k]);
    }
    if (plane->height <= 1e-12 * length)
        return false;
    for (int k = 0; k < 3; k++)
        plane->y[k] /= plane->height;
    for (int k = 0; k < 3; k++)
        plane->z[k] =
            plane->x[(k + 1) % 3] * plane->y[(k + 2) % 3] - plane->x[(k + 2) % 3] * plane->y[(k + 1) % 3];
    if (directional) {
        plane->foot /= plane->height;
        plane->height = INFINITY;
    }
    return true;
}

// Where the shadow of a point of the plane falls on the ray; y in [0, height): on the light's side, below the light.
static double shadow_of(const Plane *plane, double x, double y)
{
    if (isinf(plane->height))
        return x - y * plane->foot;
    return (x * plane->height - y * plane->foot) / (plane->height - y);
}

typedef struct Intervals {
    TruthSpan *items;
    size_t count, capacity;
} Intervals;

static void interval_add(Intervals *intervals, double a, double b)
{
    if (intervals->count == intervals->capacity) {
        intervals->capacity = intervals->capacity ? 2 * intervals->capacity : 64;
        intervals->items =
            memory_grow(intervals->items, intervals->capacity, sizeof *intervals->items, "shadows on a ray");
    }
    intervals->items[intervals->count++] = (TruthSpan){fmin(a, b), fmax(a, b)};
}

// The shadow of a segment of the plane: its part with 0 ≤ y < height, thrown from the light.
static void segment_shadow(const Plane *plane, const double p[2], const double q[2], Intervals *shadows)
{
    const double *low = p[1] <= q[1] ? p : q, *high = low == p ? q : p;
    if (high[1] < 0.0 || low[1] >= plane->height)
        return;
    double a = low[0], ya = low[1], b = high[0], yb = high[1];
    if (ya < 0.0) {
        a += (b - a) * (ya / (ya - yb));
        ya = 0.0;
    }
    if (yb >= plane->height) { // it rises past the light: its shadow reaches to infinity
        const double at = high[0] + (low[0] - high[0]) * ((yb - plane->height) / (yb - low[1]));
        interval_add(shadows, shadow_of(plane, a, ya), at >= plane->foot ? INFINITY : -INFINITY);
    } else {
        interval_add(shadows, shadow_of(plane, a, ya), shadow_of(plane, b, yb));
    }
}

// Corners on the plane count as above it, so a triangle is cut in no segment or in one. An edge is cut from its lower end in memory's order of
// coordinates, so two triangles that share it are cut in the very same point, and no light falls between them.
static void triangle_shadow(const Plane *plane, const double *corners, Intervals *shadows)
{
    double height[3], at[3][2], cut[2][2];
    int cuts = 0;
    for (size_t i = 0; i < 3; i++) {
        const double from[3] = {corners[3 * i] - plane->origin[0], corners[3 * i + 1] - plane->origin[1],
                                corners[3 * i + 2] - plane->origin[2]};
        height[i] = dot(plane->z, from);
        at[i][0] = dot(plane->x, from);
        at[i][1] = dot(plane->y, from);
    }
    for (size_t i = 0; i < 3; i++) {
        size_t a = i, b = (i + 1) % 3;
        if ((height[a] >= 0.0) == (height[b] >= 0.0) || cuts == 2)
            continue;
        if (memcmp(corners + 3 * a, corners + 3 * b, 3 * sizeof(double)) > 0)
            a = b, b = i;
        const double share = height[a] / (height[a] - height[b]);
        for (int k = 0; k < 2; k++)
            cut[cuts][k] = at[a][k] + share * (at[b][k] - at[a][k]);
        cuts++;
    }
    if (cuts == 2)
        segment_shadow(plane, cut[0], cut[1], shadows);
}

static void tree_shadows(const TruthShadows *shadows, const Plane *plane, Intervals *intervals)
{
    size_t stack[DEEPEST], depth = 0;
    if (shadows->node_count > 0)
        stack[depth++] = 0;
    while (depth > 0) {
        const size_t at = stack[--depth];
        const Node *node = &shadows->nodes[at];
        double distance = 0.0, reach = 0.0, rounding = 0.0;
        for (int k = 0; k < 3; k++) {
            const double half = 0.5 * (node->upper[k] - node->lower[k]);
            const double centre = node->lower[k] + half - plane->origin[k];
            distance += plane->z[k] * centre;
            reach += fabs(plane->z[k]) * half;
            rounding += fabs(node->lower[k]) + fabs(plane->origin[k]) + half;
        }
        if (fabs(distance) > reach + 1e-14 * rounding) // no corner lies across the plane
            continue;
        for (size_t i = 0; i < node->count; i++)
            triangle_shadow(plane, shadows->corners + 9 * (node->first + i), intervals);
        if (node->count == 0) {
            stack[depth++] = node->right;
            stack[depth++] = at + 1;
        }
    }
}

// The light is on the ray's line: surfaces along the ray end what it reaches.
static void line_shadows(const TruthShadows *shadows, const Light *light, const double origin[3],
                         const double direction[3], Intervals *intervals)
{
    const vec3 along = vec3_make((float)direction[0], (float)direction[1], (float)direction[2]);
    const vec3 eye = vec3_make((float)origin[0], (float)origin[1], (float)origin[2]);
    if (light->kind == LIGHT_DIRECTIONAL) {
        const bool from_behind = vec3_dot(light->direction, along) > 0.0f;
        const double hit = (double)truth_ray(shadows->truth, eye, from_behind ? -along : along).distance;
        if (from_behind && isfinite(hit))
            interval_add(intervals, -INFINITY, INFINITY);
        else if (!from_behind)
            interval_add(intervals, -INFINITY, isfinite(hit) ? INFINITY : -INFINITY);
        return;
    }
    const double foot = (double)vec3_dot(light->position - eye, along);
    interval_add(intervals, foot + (double)truth_ray(shadows->truth, light->position, along).distance,
                 INFINITY);
    interval_add(intervals, -INFINITY,
                 foot - (double)truth_ray(shadows->truth, light->position, -along).distance);
}

// The part of the ray inside a spot's cone, as shadows of what is outside: cosθ·|p| is linear, so the border is a quadratic in t.
static void cone_shadows(const Light *light, const double origin[3], const double direction[3],
                         Intervals *intervals)
{
    double axis[3], from[3], length = 0.0;
    for (int k = 0; k < 3; k++) {
        axis[k] = (double)light->direction[k];
        from[k] = origin[k] - (double)light->position[k];
        length = hypot(length, axis[k]);
    }
    const double c2 = pow(cos((double)light->half_angle_rad) * length, 2.0);
    const double ad = dot(axis, direction), af = dot(axis, from);
    const double a = ad * ad - c2, b = ad * af - c2 * dot(from, direction),
                 c = af * af - c2 * dot(from, from);
    const double inside = b * b - a * c;
    double borders[4] = {-INFINITY, INFINITY, INFINITY, INFINITY};
    if (inside > 0.0 && a != 0.0) {
        const double q = -(b + copysign(sqrt(inside), b));
        borders[1] = fmin(q / a, c / q);
        borders[2] = fmax(q / a, c / q);
    }
    for (int i = 0; i < 3; i++) { // is the middle of each stretch inside?
        const double lo = borders[i], hi = borders[i + 1];
        if (!(lo < hi))
            continue;
        const double span = fabs(isinf(lo) ? hi : lo) + 1.0;
        const double t = isinf(lo) && isinf(hi) ? 0.0
                         : isinf(lo)            ? hi - span
                         : isinf(hi)            ? lo + span
                                                : 0.5 * (lo + hi);
        const double p[3] = {from[0] + t * direction[0], from[1] + t * direction[1],
                             from[2] + t * direction[2]};
        const double along = dot(axis, p);
        if (!(along >= 0.0 && along * along >= c2 * dot(p, p)))
            interval_add(intervals, lo, hi);
    }
}

static int by_start(const void *a, const void *b)
{
    const double x = ((const TruthSpan *)a)->t0, y = ((const TruthSpan *)b)->t0;
    return (x > y) - (x < y);
}

TruthSpan *truth_lit_spans(const TruthShadows *shadows, const Light *light, const double origin[3],
                           const double direction[3], double length, size_t *count)
{
    Plane plane;
    Intervals dark = {0};
    if (plane_make(&plane, light, origin, direction))
        tree_shadows(shadows, &plane, &dark);
    else
        line_shadows(shadows, light, origin, direction, &dark);
    if (light->kind == LIGHT_SPOT)
        cone_shadows(light, origin, direction, &dark);
    if (dark.count > 0)
        qsort(dark.items, dark.count, sizeof *dark.items, by_start);
    TruthSpan *lit = memory_new(dark.count + 1, sizeof *lit, "lit spans");
    double lit_from = 0.0;
    *count = 0;
    for (size_t i = 0; i < dark.count && lit_from < length; i++) {
        if (dark.items[i].t0 > lit_from)
            lit[(*count)++] = (TruthSpan){lit_from, fmin(dark.items[i].t0, length)};
        lit_from = fmax(lit_from, dark.items[i].t1);
    }
    if (lit_from < length)
        lit[(*count)++] = (TruthSpan){lit_from, length};
    free(dark.items);
    return lit;
}
