// inputs_01_winding: what exercise 01.3 is given: a polygon, and points about it.
#include "inputs.h"

// Coordinates are whole numbers of `unit`, at most 2048 of them from `centre`: products of their differences stay
// below 2^24, exact in float32.

typedef struct Polygon {
    int count, x[32], y[32];
} Polygon;

static void polygon_add(Polygon *polygon, int x, int y)
{
    polygon->x[polygon->count] = x;
    polygon->y[polygon->count++] = y;
}

// Sixteen directions, counter-clockwise, of about 1024.
static const int directions[16][2] = {
    {1024, 0},  {946, 392},   {724, 724},   {392, 946},   {0, 1024},  {-392, 946}, {-724, 724}, {-946, 392},
    {-1024, 0}, {-946, -392}, {-724, -724}, {-392, -946}, {0, -1024}, {392, -946}, {724, -724}, {946, -392}};

// Around the origin `turns` times (clockwise where negative), at another distance in each direction.
static Polygon polygon_around(int turns, uint64_t *random)
{
    Polygon polygon = {0};
    int sign = turns < 0 ? -1 : 1;
    for (int i = 0; i<16 * sign * turns; i += turns * turns> 1 ? 3 : 1) {
        const int *to = directions[(16 + sign * (i % 16)) % 16];
        int reach = input_between(random, 4, 16);
        polygon_add(&polygon, to[0] * reach / 16, to[1] * reach / 16);
    }
    return polygon;
}

// Whether a point has the height of a corner or lies on the line of an edge: what a border's rule decides.
static bool on_a_border(const Polygon *polygon, int x, int y)
{
    for (int i = 0; i < polygon->count; i++) {
        int next = (i + 1) % polygon->count;
        int64_t ax = polygon->x[i] - x, ay = polygon->y[i] - y;
        int64_t bx = polygon->x[next] - x, by = polygon->y[next] - y;
        if (ay == 0 || ax * by == bx * ay)
            return true;
    }
    return false;
}

static void winding_input(Input *input, const Polygon *polygon, double centre, double unit)
{
    input_add(input, polygon->count);
    for (int i = 0; i < polygon->count; i++) {
        input_add(input, centre + unit * polygon->x[i]);
        input_add(input, centre + unit * polygon->y[i]);
    }
    input->head = input->count;
    input->stride = 2;
}

static void points_off_the_border(Input *input, const Polygon *polygon, int count, double centre, double unit,
                                  uint64_t *random)
{
    for (int i = 0; i < count; i++) {
        int x, y;
        do {
            x = input_between(random, -1024, 1024);
            y = input_between(random, -1024, 1024);
        } while (on_a_border(polygon, x, y));
        input_add(input, centre + unit * x);
        input_add(input, centre + unit * y);
    }
}

static void winding_simple(Input *input, const Shape *shape, uint64_t *random)
{
    Polygon polygon = polygon_around(1, random);
    winding_input(input, &polygon, 0, 1.0 / 64);
    points_off_the_border(input, &polygon, shape->size[0], 0, 1.0 / 64, random);
}

// Twice or three times around, and clockwise.
static void winding_overlapping(Input *input, const Shape *shape, uint64_t *random)
{
    Polygon polygon = polygon_around(-input_between(random, 2, 3), random);
    winding_input(input, &polygon, 0, 1.0 / 64);
    points_off_the_border(input, &polygon, shape->size[0], 0, 1.0 / 64, random);
}

// Far from the origin, where neighbouring float32 numbers lie 1/8 apart; points close to an edge's line, where rounding shows.
static void winding_far(Input *input, const Shape *shape, uint64_t *random)
{
    enum { FAR = 1 << 20 };
    Polygon polygon = polygon_around(1, random);
    winding_input(input, &polygon, FAR, 1.0 / 8);
    for (int i = 0; i < shape->size[0]; i++) {
        int x, y;
        do { // beside the middle of an edge, a step or two
            int at = input_between(random, 0, polygon.count - 1), next = (at + 1) % polygon.count;
            x = (polygon.x[at] + polygon.x[next]) / 2 + input_between(random, -2, 2);
            y = (polygon.y[at] + polygon.y[next]) / 2 + input_between(random, -2, 2);
        } while (on_a_border(&polygon, x, y));
        input_add(input, FAR + x / 8.0);
        input_add(input, FAR + y / 8.0);
    }
}

// A polygon of small whole numbers with level and upright edges, and every point of the lattice about it: most lie on a border or at a corner's height.
static void winding_border(Input *input, const Shape *shape, uint64_t *random)
{
    Polygon polygon = {0};
    int side = shape->size[0], left = input_between(random, 1, 2),
        right = side - 2 - input_between(random, 0, 1);
    int middle = input_between(random, left + 2, right - 2), top = shape->size[1] - 2;
    polygon_add(&polygon, left, 1);
    polygon_add(&polygon, middle, 3);
    polygon_add(&polygon, right, 1);
    polygon_add(&polygon, right, top - 2);
    polygon_add(&polygon, right - 2, top);
    polygon_add(&polygon, middle, top - 3);
    polygon_add(&polygon, left + 1, top - 3);
    polygon_add(&polygon, left + 1, top);
    polygon_add(&polygon, left, top);
    winding_input(input, &polygon, 0, 1);
    for (int y = 0; y < shape->size[1]; y++)
        for (int x = 0; x < side; x++) {
            input_add(input, x);
            input_add(input, y);
        }
}

const Generator inputs_01_winding[] = {{"winding_simple", winding_simple},
                                       {"winding_overlapping", winding_overlapping},
                                       {"winding_far", winding_far},
                                       {"winding_border", winding_border},
                                       {NULL, NULL}};
