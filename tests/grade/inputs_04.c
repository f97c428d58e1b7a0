// inputs_04: what chapter 04's exercises are given.
#include "inputs.h"

// --- 04.1: a lamp and a stretch of a ray; then x. Lengths are whole numbers of 1/16 m.
typedef struct Sight {
    int nearest, foot, radius, from, length; // 1/16 m
} Sight;

static void sights(Input *input, const Shape *shape, uint64_t *random, Sight (*draw)(uint64_t *random, int i))
{
    input->stride = 6;
    for (int i = 0; i < shape->size[0]; i++) {
        Sight sight = draw(random, i);
        const int lengths[5] = {sight.nearest, sight.foot, sight.radius, sight.from,
                                sight.from + sight.length};
        for (int k = 0; k < 5; k++)
            input_add(input, lengths[k] / 16.0);
        input_add(input, input_between(random, 2, 30) / 32.0); // no end: there t is from or to by any rule
    }
}

// Half a metre or more beside the ray, abreast of the stretch or up to 4 m before or behind it.
static Sight draw_beside(uint64_t *random, int i)
{
    (void)i;
    Sight sight = {.radius = 1};
    sight.nearest = input_between(random, 8, 64);
    sight.from = input_between(random, 4, 64);
    sight.length = input_between(random, 16, 64);
    sight.foot = sight.from + input_between(random, -64, sight.length + 64);
    return sight;
}

// On the ray: within the stretch for every second, else up to 2 m before or behind it.
static Sight draw_on_ray(uint64_t *random, int i)
{
    Sight sight = {.nearest = 0};
    sight.radius = input_between(random, 2, 8);
    sight.from = input_between(random, 40, 64);
    sight.length = input_between(random, 16, 32);
    int within = input_between(random, 4, sight.length - 4), off = input_between(random, 4, 32);
    sight.foot = sight.from + (i % 2 ? within : i % 4 ? -off : sight.length + off);
    return sight;
}

// So far before or behind that it sees the stretch under 4e-6 rad at most.
static Sight draw_far(uint64_t *random, int i)
{
    Sight sight = {.radius = 1};
    sight.nearest = input_between(random, 16, 32);
    sight.from = input_between(random, 16, 64);
    sight.length = input_between(random, 2, 4);
    sight.foot = 16 * input_between(random, 384, 512) * (i % 2 ? 1 : -1);
    return sight;
}

static void sight_beside(Input *input, const Shape *shape, uint64_t *random)
{
    sights(input, shape, random, draw_beside);
}

static void sight_on_ray(Input *input, const Shape *shape, uint64_t *random)
{
    sights(input, shape, random, draw_on_ray);
}

static void sight_far(Input *input, const Shape *shape, uint64_t *random)
{
    sights(input, shape, random, draw_far);
}

// --- 04.2: extinction, both ends of a stretch, both ends' light. Optical depths are products of short binary numbers.
static double two_to(int exponent)
{
    double power = 1;
    for (; exponent > 0; exponent--)
        power *= 2;
    for (; exponent < 0; exponent++)
        power /= 2;
    return power;
}

// Every second stretch is lit at its far end alone, where little of the light comes back.
static void add_fading(Input *input, double sigma, double from, double length, bool far_end, uint64_t *random)
{
    int near_light = input_between(random, 4, 8), far_light = input_between(random, 0, 2);
    input_add(input, sigma);
    input_add(input, from);
    input_add(input, from + length);
    input_add(input, far_end ? 0 : near_light / 8.0);
    input_add(input, far_end ? 1 : far_light / 8.0);
}

// σ(b - a) from 1/2 to 8.
static void fading_ordinary(Input *input, const Shape *shape, uint64_t *random)
{
    input->stride = 5;
    for (int i = 0; i < shape->size[0]; i++) {
        double sigma = two_to(input_between(random, -2, 2));
        double from = input_between(random, 1, 8) / 8.0 / sigma;
        add_fading(input, sigma, from, input_between(random, 8, 128) / 16.0 / sigma, i % 2, random);
    }
}

// From 0 to 2^-4: a long stretch in mist that is thin, or a short one. The second is thick enough that to leave out what is not constant shows.
static void fading_thin(Input *input, const Shape *shape, uint64_t *random)
{
    input->stride = 5;
    for (int i = 0; i < shape->size[0]; i++) {
        bool short_stretch = i % 4 >= 2;
        double mantissa = input_between(random, 8, 15) / 8.0;
        double small = two_to(-input_between(random, 11, 17)), thin = two_to(-input_between(random, 13, 30));
        double sigma = short_stretch ? mantissa / 2 : mantissa * (i == 1 ? two_to(-7) : thin);
        if (i == 0 || i == 4)
            sigma = i == 0 ? 0 : two_to(-32);
        add_fading(input, sigma, input_between(random, 8, 24) / 8.0, short_stretch ? small : 4, i % 2,
                   random);
    }
}

// From 2^8 to 2^17, all that matters of it at the near end.
static void fading_thick(Input *input, const Shape *shape, uint64_t *random)
{
    input->stride = 5;
    for (int i = 0; i < shape->size[0]; i++) {
        double sigma = two_to(input_between(random, 0, 8)),
               mantissa = (2 * input_between(random, 4, 7) + 1) / 8.0;
        double depth =
            mantissa *
            two_to(i % 4 == 3 ? 16 : input_between(random, 8, 15)); // no power of 2: quotients round
        double from = input_between(random, 4, 16) / 8.0 / sigma;
        add_fading(input, sigma, from, depth / sigma, i % 2, random);
    }
}

// --- 04.3: g, then the share of light that is turned by less.
static void draws(Input *input, const Shape *shape, uint64_t *random, double (*g_of)(uint64_t *random, int i))
{
    input->stride = 2;
    for (int i = 0; i < shape->size[0]; i++) {
        double g = g_of(random, i);
        input_add(input, i % 2 ? g : -g);
        input_add(input, input_between(random, 32, 224) / 256.0);
    }
}

static double broad_g(uint64_t *random, int i)
{
    (void)i;
    return input_between(random, 16, 32) / 64.0;
}

static double peaked_g(uint64_t *random, int i)
{
    return 1 - input_between(random, 1, i < 8 ? 4 : 40) / 4096.0;
}

// 0; about 1/2000; and down to a millionth, up to 1/64.
static double even_g(uint64_t *random, int i)
{
    if (i < 2)
        return 0;
    double mantissa = input_between(random, 8, 15) / 8.0;
    return mantissa * two_to(i < 8 ? -11 : -input_between(random, 7, 20));
}

static void turn_broad(Input *input, const Shape *shape, uint64_t *random)
{
    draws(input, shape, random, broad_g);
}

static void turn_peaked(Input *input, const Shape *shape, uint64_t *random)
{
    draws(input, shape, random, peaked_g);
}

static void turn_even(Input *input, const Shape *shape, uint64_t *random)
{
    draws(input, shape, random, even_g);
}

// The first or the last 2^-14 of the light and less, of peaks as sharp as 1 - 2^-16. The odd 2^-24 of g is lost in 1 + g.
static void turn_ends(Input *input, const Shape *shape, uint64_t *random)
{
    input->stride = 2;
    for (int i = 0; i < shape->size[0]; i++) {
        double g = 1 - (2 * input_between(random, 128, 511) + 1) * two_to(-24);
        double end = two_to(-input_between(random, 14, 22));
        input_add(input, i % 2 ? g : -g);
        input_add(input, i % 4 < 2 ? end : 1 - end);
    }
}

// --- 04.4: rays and their shadows, in 1/256 m. A ray ends at 16 m.
enum { METRE = 256, END = 16 * METRE, SHADOWS = 6 };

typedef struct Shaded {
    int nearest, foot, shadows[SHADOWS][2];
} Shaded;

static void add_shaded(Input *input, const Shaded *shaded)
{
    input->stride = 3 + 2 * SHADOWS;
    input_add(input, (double)shaded->nearest / METRE);
    input_add(input, (double)shaded->foot / METRE);
    input_add(input, (double)END / METRE);
    for (int k = 0; k < SHADOWS; k++)
        for (int side = 0; side < 2; side++)
            input_add(input, (double)shaded->shadows[k][side] / METRE);
}

// In order, none touching the next; every second ray passes the lamp in the light, so near that the lamp sees more than a right angle of it.
static void shadows_apart(Input *input, const Shape *shape, uint64_t *random)
{
    for (int i = 0; i < shape->size[0]; i++) {
        Shaded shaded = {.nearest = input_between(random, 2 * METRE, 3 * METRE), .foot = END / 2};
        int at = input_between(random, METRE / 2, METRE) + (i % 2 ? 11 * METRE : 0);
        for (int k = 0; k < (i % 2 ? 2 : SHADOWS); k++) {
            shaded.shadows[k][0] = at;
            shaded.shadows[k][1] = at + input_between(random, METRE / 4, METRE);
            at = shaded.shadows[k][1] + input_between(random, METRE / 4, METRE);
        }
        add_shaded(input, &shaded);
    }
}

// In no order: one holds another, two overlap, one begins behind the eye and one ends beyond the ray's end. Every
// fourth ray again has more than a right angle of light.
static Shaded draw_overlapping(uint64_t *random, bool wide)
{
    Shaded shaded = {.nearest = 0};
    shaded.nearest =
        wide ? input_between(random, METRE, 3 * METRE / 2) : input_between(random, 2 * METRE, 4 * METRE);
    shaded.foot = wide ? 15 * METRE / 2 : input_between(random, 6 * METRE, 10 * METRE);
    const int outer = input_between(random, 2 * METRE, (wide ? 3 : 5) * METRE);
    const int late = input_between(random, (wide ? 11 : 8) * METRE, 12 * METRE);
    const int first = input_between(random, METRE / 4, METRE), last = input_between(random, METRE / 4, METRE);
    const int places[SHADOWS][2] = {{outer, outer + 2 * METRE},
                                    {outer + METRE / 4, outer + METRE},
                                    {late, late + METRE},
                                    {late + METRE / 2, late + 2 * METRE},
                                    {-METRE, first},
                                    {END - last, END + METRE}};
    const int turned = input_between(random, 1, SHADOWS - 1); // and backwards: never in order
    for (int k = 0; k < SHADOWS; k++)
        for (int side = 0; side < 2; side++)
            shaded.shadows[k][side] = places[(turned + SHADOWS - k) % SHADOWS][side];
    return shaded;
}

static void shadows_overlapping(Input *input, const Shape *shape, uint64_t *random)
{
    for (int i = 0; i < shape->size[0]; i++) {
        Shaded shaded = draw_overlapping(random, i % 4 == 0);
        add_shaded(input, &shaded);
    }
}

// Close by the lamp in shadow, then a few millimetres of light far behind it, and shadow again to the end.
static void shadows_sliver(Input *input, const Shape *shape, uint64_t *random)
{
    for (int i = 0; i < shape->size[0]; i++) {
        Shaded shaded = {.nearest = input_between(random, 4, 16)};
        shaded.foot = input_between(random, METRE, 2 * METRE);
        shaded.shadows[0][1] = input_between(random, 10 * METRE, 15 * METRE);
        shaded.shadows[1][0] = shaded.shadows[0][1] + input_between(random, 1, 4);
        shaded.shadows[1][1] = END;
        add_shaded(input, &shaded);
    }
}

// The lamp on the ray: in a shadow, behind the eye, or beyond the end.
static void shadows_on_ray(Input *input, const Shape *shape, uint64_t *random)
{
    for (int i = 0; i < shape->size[0]; i++) {
        int within = input_between(random, 4 * METRE, 12 * METRE),
            off = input_between(random, METRE, 4 * METRE);
        Shaded shaded = {.foot = i % 3 == 0 ? within : i % 3 == 1 ? -off : END + off};
        shaded.shadows[0][0] = within - input_between(random, METRE, 2 * METRE);
        shaded.shadows[0][1] = within + input_between(random, METRE, 2 * METRE);
        add_shaded(input, &shaded);
    }
}

const Generator inputs_04[] = {{"sight_beside", sight_beside},
                               {"sight_on_ray", sight_on_ray},
                               {"sight_far", sight_far},
                               {"fading_ordinary", fading_ordinary},
                               {"fading_thin", fading_thin},
                               {"fading_thick", fading_thick},
                               {"turn_broad", turn_broad},
                               {"turn_peaked", turn_peaked},
                               {"turn_even", turn_even},
                               {"turn_ends", turn_ends},
                               {"shadows_apart", shadows_apart},
                               {"shadows_overlapping", shadows_overlapping},
                               {"shadows_sliver", shadows_sliver},
                               {"shadows_on_ray", shadows_on_ray},
                               {NULL, NULL}};
