// inputs_02: what chapter 02's exercises are given.
#include "inputs.h"

// --- 02.1: a texel's size, a normal and a way to the light, both of whole numbers
typedef struct Angle {
    int64_t cosine, lengths; // dot product, and the square of both lengths' product: cos² = cosine² / lengths
} Angle;

static Angle draw_angle(int vectors[6], uint64_t *random)
{
    enum { REACH = 63 };
    int64_t dot = 0, normal = 0, light = 0;
    for (int k = 0; k < 6; k++)
        vectors[k] = input_between(random, -REACH, REACH);
    for (int k = 0; k < 3; k++) {
        dot += vectors[k] * vectors[3 + k];
        normal += vectors[k] * vectors[k];
        light += vectors[3 + k] * vectors[3 + k];
    }
    return (Angle){dot, normal * light};
}

// From 15° to 60°: neither where float32 loses the sine of a small angle nor where the slope is all.
static bool is_facing(Angle angle)
{
    int64_t square = angle.cosine * angle.cosine;
    return angle.cosine > 0 && 4 * square >= angle.lengths && 1000 * square <= 933 * angle.lengths;
}

// cos θ from 1/50 to 1/10.
static bool is_grazing(Angle angle)
{
    int64_t square = angle.cosine * angle.cosine;
    return angle.cosine > 0 && 2500 * square >= angle.lengths && 100 * square <= angle.lengths;
}

static bool is_behind(Angle angle)
{
    return angle.lengths > 0 && angle.cosine <= 0;
}

static void biases(Input *input, const Shape *shape, uint64_t *random, bool (*wanted)(Angle))
{
    input->stride = 7;
    for (int i = 0; i < shape->size[0]; i++) {
        int vectors[6];
        while (!wanted(draw_angle(vectors, random)))
            continue;
        input_add(input, input_between(random, 1, 64) / 1024.0);
        for (int k = 0; k < 6; k++)
            input_add(input, vectors[k]);
    }
}

static void bias_facing(Input *input, const Shape *shape, uint64_t *random)
{
    biases(input, shape, random, is_facing);
}

static void bias_grazing(Input *input, const Shape *shape, uint64_t *random)
{
    biases(input, shape, random, is_grazing);
}

static void bias_behind(Input *input, const Shape *shape, uint64_t *random)
{
    biases(input, shape, random, is_behind);
}

// --- 02.2: receivers in a spot's map. Sizes, tangents and depths are powers of two and all else small whole numbers of 1/64, so that places are exact
// and a ray along a plane has a product of exactly 0.
typedef struct Receiver {
    int texels;
    double tangent, point[3];
    int normal[3];
} Receiver;

static Receiver draw_receiver(uint64_t *random, int reach)
{
    Receiver receiver = {.texels = 8 << input_between(random, 0, 2),
                         .tangent = 1.0 / input_between(random, 1, 2)};
    receiver.point[2] = 1 << input_between(random, 0, 2);
    for (int k = 0; k < 2; k++) // inside the outermost two texels' ring, off the borders between texels
        receiver.point[k] =
            (input_between(random, -40, 39) + 0.25) / 64 * receiver.point[2] * receiver.tangent;
    for (int k = 0; k < 3; k++)
        receiver.normal[k] = input_between(random, -reach, reach);
    return receiver;
}

// The product of the normal and the ray of a neighbour, -1 to 1 texels off; the texel is found by the same exact numbers as the exercise's.
static double along_normal(const Receiver *receiver, int right, int up)
{
    const int off[2] = {right, up};
    double product = receiver->normal[2];
    for (int k = 0; k < 2; k++) {
        double place = receiver->point[k] / (receiver->point[2] * receiver->tangent);
        int texel = (int)((0.5 * place + 0.5) * receiver->texels);
        product += receiver->normal[k] * receiver->tangent *
                   ((2.0 * (texel + off[k]) + 1.0) / receiver->texels - 1.0);
    }
    return product;
}

typedef struct Plane {
    double facing, lengths; // normal · point; the squares of both lengths multiplied
    bool met;               // by all nine rays, before the light, at no more than 8 times the point's depth
    bool missed;            // by one of them clearly, or exactly
} Plane;

static Plane plane_of(const Receiver *receiver)
{
    Plane plane = {.met = true};
    double normal = 0, point = 0;
    for (int k = 0; k < 3; k++) {
        plane.facing += receiver->normal[k] * receiver->point[k];
        normal += receiver->normal[k] * receiver->normal[k];
        point += receiver->point[k] * receiver->point[k];
    }
    plane.lengths = normal * point;
    for (int k = 0; k < 9; k++) {
        double product = along_normal(receiver, k % 3 - 1, k / 3 - 1), depth = receiver->point[2];
        bool before = product * plane.facing > 0;
        double farther = plane.facing / depth / 8;
        plane.met = plane.met && before && product * product >= farther * farther;
        plane.missed = plane.missed || !before;
    }
    return plane;
}

static bool is_tilted(const Plane *plane)
{
    return plane->met && 4 * plane->facing * plane->facing >= plane->lengths;
}

// The angle between ray and plane is at most 15°.
static bool is_flat(const Plane *plane)
{
    return plane->met && 15 * plane->facing * plane->facing <= plane->lengths;
}

static bool is_limit(const Plane *plane)
{
    return plane->missed && plane->facing != 0;
}

static void planes(Input *input, const Shape *shape, uint64_t *random, int reach,
                   bool (*wanted)(const Plane *))
{
    for (int i = 0; i < shape->size[2]; i++) {
        Receiver receiver;
        Plane plane;
        do {
            receiver = draw_receiver(random, reach);
            plane = plane_of(&receiver);
        } while (plane.lengths == 0 || !wanted(&plane));
        input_add(input, receiver.texels);
        input_add(input, receiver.tangent);
        for (int k = 0; k < 3; k++)
            input_add(input, receiver.point[k]);
        for (int k = 0; k < 3; k++)
            input_add(input, receiver.normal[k]);
    }
}

static void plane_tilted(Input *input, const Shape *shape, uint64_t *random)
{
    planes(input, shape, random, 15, is_tilted);
}

static void plane_grazing(Input *input, const Shape *shape, uint64_t *random)
{
    planes(input, shape, random, 15, is_flat);
}

static void plane_limit(Input *input, const Shape *shape, uint64_t *random)
{
    planes(input, shape, random, 15, is_limit);
}

// --- 02.3: a map of depths, then receivers. Depths are whole numbers of 1/16 m.
enum { MAP = 12, FLOOR = 8 * 16 };

static void map_head(Input *input, uint64_t *random, int low, int high, int holes)
{
    input->head = 2 + MAP * MAP;
    input->stride = 4;
    input_add(input, input_between(random, 1, 8) / 8.0);
    input_add(input, MAP);
    for (int i = 0; i < MAP * MAP; i++)
        input_add(input,
                  (input_between(random, 0, 99) < holes ? FLOOR : input_between(random, low, high)) / 16.0);
}

// Whether a texel whose centre lies well inside the square is clearly nearer: so every receiver of a check has a blocker whatever the rules at borders.
static bool is_blocked(const Input *input, const double receiver[4])
{
    for (int i = 0; i < MAP * MAP; i++) {
        int column = i % MAP, row = i / MAP;
        double right = column + 0.5 - receiver[0], up = row + 0.5 - receiver[1], inside = receiver[3] - 0.25;
        if (right * right < inside * inside && up * up < inside * inside &&
            (double)input->values[2 + i] < receiver[2] - 1.0 / 64)
            return true;
    }
    return false;
}

static void add_receiver(Input *input, const double receiver[4])
{
    for (int k = 0; k < 4; k++)
        input_add(input, receiver[k]);
}

// Things at 2 to 6 m over a floor at 8; receivers between 3 and 8 m, equal to no depth, their squares' borders on no centre.
static void lamp_soft(Input *input, const Shape *shape, uint64_t *random)
{
    map_head(input, random, 2 * 16, 6 * 16, 40);
    for (int i = 0; i < shape->size[0]; i++) {
        double receiver[4];
        do {
            for (int k = 0; k < 2; k++)
                receiver[k] = input_between(random, 3 * 8, 9 * 8) / 8.0 + 1.0 / 16;
            receiver[2] = input_between(random, 3 * 16, FLOOR - 1) / 16.0 + 1.0 / 32;
            receiver[3] = input_between(random, 8, 24) / 8.0;
        } while (!is_blocked(input, receiver));
        add_receiver(input, receiver);
    }
}

// Nothing is nearer to the lamp than any receiver.
static void lamp_none(Input *input, const Shape *shape, uint64_t *random)
{
    map_head(input, random, 6 * 16, 7 * 16, 40);
    for (int i = 0; i < shape->size[0]; i++) {
        double x = input_between(random, 3 * 8, 9 * 8) / 8.0, y = input_between(random, 3 * 8, 9 * 8) / 8.0;
        double depth = input_between(random, 3 * 16, 6 * 16) / 16.0 - 1.0 / 32,
               radius = input_between(random, 8, 24) / 8.0;
        add_receiver(input, (const double[]){x, y, depth, radius});
    }
}

// Receivers at texels' centres with whole radii, so that centres lie on the square's border, and at depths of which the map is full.
static void lamp_border(Input *input, const Shape *shape, uint64_t *random)
{
    map_head(input, random, 3 * 16, 3 * 16 + 3, 20);
    for (int i = 0; i < shape->size[0]; i++) {
        double receiver[4];
        do {
            for (int k = 0; k < 2; k++)
                receiver[k] = input_between(random, 3, 8) + 0.5;
            receiver[2] = input_between(random, 3 * 16 + 1, 3 * 16 + 3) / 16.0;
            receiver[3] = input_between(random, 1, 2);
        } while (!is_blocked(input, receiver));
        add_receiver(input, receiver);
    }
}

const Generator inputs_02[] = {{"bias_facing", bias_facing},     {"bias_grazing", bias_grazing},
                               {"bias_behind", bias_behind},     {"plane_tilted", plane_tilted},
                               {"plane_grazing", plane_grazing}, {"plane_limit", plane_limit},
                               {"lamp_soft", lamp_soft},         {"lamp_none", lamp_none},
                               {"lamp_border", lamp_border},     {NULL, NULL}};
