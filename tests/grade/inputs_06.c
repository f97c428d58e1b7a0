// inputs_06: what chapter 06's exercises are given.
#include "inputs.h"

#include <math.h>
#include <stdlib.h>

// --- 06.1: a light and a point of whole numbers, or of halves, quarters, … of them. Components of the light have at most 13 bits, and the products of light
// and point at most 24: their cross product is exact in float32.
typedef struct Place {
    double x[3];
} Place;

static Place draw_place(uint64_t *random, int reach)
{
    Place place;
    for (int k = 0; k < 3; k++)
        place.x[k] = input_between(random, -reach, reach);
    return place;
}

static double dot(Place a, Place b)
{
    return a.x[0] * b.x[0] + a.x[1] * b.x[1] + a.x[2] * b.x[2];
}

static Place sum(double s, Place a, double t, Place b)
{
    Place c;
    for (int k = 0; k < 3; k++)
        c.x[k] = s * a.x[k] + t * b.x[k];
    return c;
}

// Whether the angle between them is between `least` and π - least, by the square of its cosine.
static bool is_between(Place a, Place b, double most_cosine_squared)
{
    double cosine = dot(a, b);
    return cosine * cosine < most_cosine_squared * dot(a, a) * dot(b, b);
}

static void add_places(Input *input, Place light, Place point)
{
    for (int k = 0; k < 3; k++)
        input_add(input, light.x[k]);
    for (int k = 0; k < 3; k++)
        input_add(input, point.x[k]);
}

// All three angles between 30° and 150°, no side much shorter than another.
static void angles_anywhere(Input *input, const Shape *shape, uint64_t *random)
{
    enum { REACH = 63 };
    input->stride = 6;
    for (int i = 0; i < shape->size[0]; i++) {
        Place light, point, way;
        do {
            light = draw_place(random, REACH);
            point = draw_place(random, REACH);
            way = sum(1, point, -1, light);
        } while (dot(light, light) < 400 || !is_between(light, point, 0.75) ||
                 !is_between(light, way, 0.75) || !is_between(point, way, 0.75));
        add_places(input, light, point);
    }
}

// By turns far beyond the light, far behind the eye, and between them: some 10^-5 to 10^-4 of the distance off the axis.
static void angles_needle(Input *input, const Shape *shape, uint64_t *random)
{
    enum { REACH = 127 };
    static const double along[3] = {256, -256, 0.5}, off[3] = {1, 1, 1.0 / 256};
    input->stride = 6;
    for (int i = 0; i < shape->size[0]; i++) {
        Place light, beside;
        do {
            light = draw_place(random, REACH);
            beside = draw_place(random, 3);
        } while (dot(light, light) < 64.0 * 64.0 || dot(beside, beside) == 0 ||
                 !is_between(light, beside, 0.75));
        add_places(input, light, sum(along[i % 3], light, off[i % 3], beside));
    }
}

// Some kilometres from the eye, at most two metres from the light; neither on the axis nor nearly.
static void angles_near_light(Input *input, const Shape *shape, uint64_t *random)
{
    enum { REACH = 2047 };
    input->stride = 6;
    for (int i = 0; i < shape->size[0]; i++) {
        Place light, beside;
        do {
            light = draw_place(random, REACH);
            beside = draw_place(random, 7);
        } while (dot(light, light) < 1500.0 * 1500.0 || dot(beside, beside) == 0 ||
                 !is_between(light, beside, 0.75));
        add_places(input, light, sum(1, light, 0.25, beside));
    }
}

// On the axis to the last bit: behind the eye, at it, between, at the light, beyond; the light in the octants of all positive and all negative
// coordinates by turns.
static void angles_on_axis(Input *input, const Shape *shape, uint64_t *random)
{
    enum { REACH = 127 };
    static const double along[6] = {-1.5, 0, 0.25, 1, 2.5, 64};
    input->stride = 6;
    for (int i = 0; i < shape->size[0]; i++) {
        Place light;
        for (int k = 0; k < 3; k++)
            light.x[k] = input_between(random, 1, REACH) * (i / 6 % 2 ? -1 : 1);
        add_places(input, light, sum(along[i % 6], light, 0, light));
    }
}

// --- 06.2: triangles of (θ, φ) in eighths of a voxel
enum { EIGHTHS = 8, SLICES = 32, PHI = 16, TURN = EIGHTHS * SLICES };

typedef struct Seam {
    int theta[3], phi[3]; // θ from 0 to TURN
} Seam;

// From one θ to another the short way; 0 where neither way is shorter than by a slice.
static int turn(int from, int to)
{
    int straight = ((to - from) % TURN + TURN) % TURN;
    return abs(straight - TURN / 2) < EIGHTHS ? 0 : straight > TURN / 2 ? straight - TURN : straight;
}

typedef enum Around { AWAY, OVER_SEAM, PIERCED, NONE } Around;

// What the seam and the axis are to a triangle; NONE where an edge has no short way or a middle of a voxel lies on an edge.
static Around around(const Seam *seam)
{
    int whole = 0;
    bool over = false;
    for (int i = 0; i < 3; i++) {
        int k = (i + 1) % 3, way = turn(seam->theta[i], seam->theta[k]), rise = seam->phi[k] - seam->phi[i];
        if (way == 0)
            return NONE;
        whole += way;
        over = over || seam->theta[i] + way < 0 || seam->theta[i] + way >= TURN;
        for (int theta = EIGHTHS / 2; theta < 3 * TURN; theta += EIGHTHS)
            for (int phi = EIGHTHS / 2; phi < EIGHTHS * PHI; phi += EIGHTHS)
                if (rise * (theta - TURN - seam->theta[i]) == way * (phi - seam->phi[i]))
                    return NONE;
    }
    return whole ? PIERCED : over ? OVER_SEAM : AWAY;
}

static void seams(Input *input, uint64_t *random, Around wanted, int count)
{
    input->stride = 6;
    for (int i = 0; i < count; i++) {
        Seam seam;
        bool wide;
        do {
            for (int k = 0; k < 3; k++) {
                seam.theta[k] = input_between(random, 0, TURN - 1);
                seam.phi[k] = input_between(random, 2 * EIGHTHS, EIGHTHS * PHI - 4);
            }
            int a = turn(seam.theta[0], seam.theta[1]), b = turn(seam.theta[0], seam.theta[2]);
            // at least eight voxels: a triangle is to be seen
            wide = abs(a * (seam.phi[2] - seam.phi[0]) - b * (seam.phi[1] - seam.phi[0])) >
                   16 * EIGHTHS * EIGHTHS;
        } while (!wide || around(&seam) != wanted);
        for (int k = 0; k < 3; k++) {
            input_add(input, (double)seam.theta[k] / EIGHTHS);
            input_add(input, (double)seam.phi[k] / EIGHTHS);
        }
    }
}

static void seam_away(Input *input, const Shape *shape, uint64_t *random)
{
    (void)shape;
    seams(input, random, AWAY, 3);
}

static void seam_over(Input *input, const Shape *shape, uint64_t *random)
{
    (void)shape;
    seams(input, random, OVER_SEAM, 2);
}

static void seam_pierced(Input *input, const Shape *shape, uint64_t *random)
{
    (void)shape;
    seams(input, random, PIERCED, 1);
}

// --- 06.3: rays of 128 voxels, 32 a word
enum { VOXELS = 128, WORD = 32 };

static void add_ray(Input *input, const bool surface[VOXELS])
{
    for (int k = 0; k < VOXELS; k++)
        input_add(input, surface[k]);
}

// The first surface in the last word, in its lower half, and up to two more behind it: no word has anything to hand on.
static void scan_one_word(Input *input, const Shape *shape, uint64_t *random)
{
    input->stride = VOXELS;
    for (int ray = 0; ray < shape->size[2]; ray++) {
        bool surface[VOXELS] = {false};
        int first = VOXELS - WORD + input_between(random, 0, 11);
        surface[first] = true;
        for (int i = 0; i < 2; i++)
            surface[input_between(random, first, VOXELS - 1)] = true;
        add_ray(input, surface);
    }
}

// The first surface in one of the first two words, not in its last voxel; nothing in the next word; perhaps more after that.
static void scan_carried(Input *input, const Shape *shape, uint64_t *random)
{
    input->stride = VOXELS;
    for (int ray = 0; ray < shape->size[2]; ray++) {
        bool surface[VOXELS] = {false};
        int word = ray % 2;
        surface[word * WORD + input_between(random, 0, WORD - 2)] = true;
        if (ray % 3)
            surface[input_between(random, (word + 2) * WORD, VOXELS - 1)] = true;
        add_ray(input, surface);
    }
}

// One surface at the last voxel of a word, or at the first; the ray's two ends; and rays without any.
static void scan_borders(Input *input, const Shape *shape, uint64_t *random)
{
    input->stride = VOXELS;
    for (int ray = 0; ray < shape->size[2]; ray++) {
        bool surface[VOXELS] = {false};
        int word = input_between(random, 0, 3);
        if (ray % 4 < 3)
            surface[ray % 4 == 0   ? (word % 2 + 1) * WORD - 1
                    : ray % 4 == 1 ? word * WORD
                                   : (ray % 8 < 4 ? VOXELS - 1 : 0)] = true;
        add_ray(input, surface);
    }
}

// --- 06.4: distance, α, from, to, and bits in words of 16
static const double PI = 3.14159265358979323846, FINE = 65536; // angles are whole numbers of 1/FINE

static double fine(double angle)
{
    return floor(angle * FINE) / FINE;
}

// φ this far into a row of VOXELS voxels over [0, π].
static double phi_at(double voxel)
{
    return fine(voxel * PI / VOXELS);
}

static void add_sight(Input *input, uint64_t *random, double alpha, double from, double to,
                      const bool dark[VOXELS])
{
    input->stride = 4 + VOXELS / 16;
    input_add(input, input_between(random, 16, 160) / 16.0);
    input_add(input, alpha);
    input_add(input, from);
    input_add(input, to);
    for (int k = 0; k < VOXELS; k += 16) {
        int word = 0;
        for (int i = 0; i < 16; i++)
            word |= dark[k + i] << i;
        input_add(input, word);
    }
}

static void blue_lit(Input *input, const Shape *shape, uint64_t *random)
{
    for (int ray = 0; ray < shape->size[0]; ray++) {
        const bool dark[VOXELS] = {false};
        double alpha = input_between(random, 64, 2048) / 1024.0;
        int most = (int)((PI - alpha) / PI * VOXELS); // voxels that the ray has
        double from = input_between(random, 0, 10) + input_between(random, 4, 12) / 16.0,
               to = input_between(random, most / 2, most - 2) + input_between(random, 4, 12) / 16.0;
        add_sight(input, random, alpha, phi_at(from), phi_at(to), dark);
    }
}

// Runs of 3 to 20 voxels, by turns lit and dark; the ray begins and ends in lit ones.
static void blue_runs(Input *input, const Shape *shape, uint64_t *random)
{
    for (int ray = 0; ray < shape->size[0]; ray++) {
        bool dark[VOXELS] = {false};
        double alpha = input_between(random, 64, 1024) / 1024.0;
        int begin = input_between(random, 0, 6), end = input_between(random, 72, 80);
        bool now = false;
        for (int k = begin + 1; k < end;) {
            for (int run = input_between(random, 3, 20); run > 0 && k < end; run--)
                dark[k++] = now;
            now = !now;
        }
        add_sight(input, random, alpha, phi_at(begin + input_between(random, 4, 12) / 16.0),
                  phi_at(end + input_between(random, 4, 12) / 16.0), dark);
    }
}

// From one lit voxel into the next but one or two; dark between.
static void blue_ends(Input *input, const Shape *shape, uint64_t *random)
{
    for (int ray = 0; ray < shape->size[0]; ray++) {
        bool dark[VOXELS];
        double alpha = input_between(random, 64, 1024) / 1024.0;
        int begin = input_between(random, 0, 70), end = begin + input_between(random, 2, 3);
        for (int k = 0; k < VOXELS; k++)
            dark[k] = k != begin && k != end;
        add_sight(input, random, alpha, phi_at(begin + input_between(random, 2, 6) / 16.0),
                  phi_at(end + input_between(random, 5, 10) / 16.0), dark);
    }
}

// 1/65536 to 4/65536 rad within a lit voxel, also of rays that lead away from the light.
static void blue_short(Input *input, const Shape *shape, uint64_t *random)
{
    for (int ray = 0; ray < shape->size[0]; ray++) {
        bool dark[VOXELS];
        double alpha = input_between(random, 256, 2816) / 1024.0;
        int most = (int)((PI - alpha) / PI * VOXELS), lit = input_between(random, 0, most - 2);
        for (int k = 0; k < VOXELS; k++)
            dark[k] = k != lit;
        double from = phi_at(lit + input_between(random, 4, 12) / 16.0);
        add_sight(input, random, alpha, from, from + input_between(random, 1, 4) / FINE, dark);
    }
}

const Generator inputs_06[] = {{"angles_anywhere", angles_anywhere},
                               {"angles_needle", angles_needle},
                               {"angles_near_light", angles_near_light},
                               {"angles_on_axis", angles_on_axis},
                               {"seam_away", seam_away},
                               {"seam_over", seam_over},
                               {"seam_pierced", seam_pierced},
                               {"scan_one_word", scan_one_word},
                               {"scan_carried", scan_carried},
                               {"scan_borders", scan_borders},
                               {"blue_lit", blue_lit},
                               {"blue_runs", blue_runs},
                               {"blue_ends", blue_ends},
                               {"blue_short", blue_short},
                               {NULL, NULL}};
