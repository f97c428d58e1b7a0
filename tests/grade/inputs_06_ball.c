// inputs_06_ball: what exercise 06.6 is given: lights and middles of whole metres, radii of sixteenths. All products that tell whether a ball holds the eye, the
// light, or a point of the axis have at most 24 bits: what is decided here is decided likewise in float32.
#include "inputs.h"

#include <math.h>

enum { LIGHT = 18, MIDDLE = 60, RADIUS = 255, SIXTEENTH = 16, SQUARE = SIXTEENTH * SIXTEENTH };

typedef struct Ball {
    int light[3], middle[3], radius; // the radius in sixteenths
    double axis, along, off; // the axis' square; dot product of light and middle; the cross product's square
    double from_eye, from_light, clear,
        at; // squares of distances; off² less radius² · axis, and the radius' square: all by SQUARE
} Ball;

static double square(double x)
{
    return x * x;
}

static void set_radius(Ball *ball, int radius)
{
    ball->radius = radius;
    ball->at = square(radius);
    ball->clear = SQUARE * ball->off - ball->at * ball->axis;
}

static Ball draw(uint64_t *random)
{
    Ball ball = {0};
    for (int k = 0; k < 3; k++) {
        ball.light[k] = input_between(random, -LIGHT, LIGHT);
        ball.middle[k] = input_between(random, -MIDDLE, MIDDLE);
    }
    const int *a = ball.light, *b = ball.middle;
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        ball.off += square(a[i] * b[j] - a[j] * b[i]);
        ball.axis += a[k] * a[k];
        ball.along += a[k] * b[k];
        ball.from_eye += SQUARE * b[k] * b[k];
        ball.from_light += SQUARE * square(b[k] - a[k]);
    }
    set_radius(&ball, input_between(random, 4, RADIUS));
    return ball;
}

static void add(Input *input, const Ball *ball)
{
    input->stride = 7;
    for (int k = 0; k < 3; k++)
        input_add(input, ball->light[k]);
    for (int k = 0; k < 3; k++)
        input_add(input, ball->middle[k]);
    input_add(input, (double)ball->radius / SIXTEENTH);
}

// Where along the axis' line: 0 behind the eye, 1 between eye and light, 2 beyond the light.
static int stretch(const Ball *ball)
{
    return ball->along < 0 ? 0 : ball->along < ball->axis ? 1 : 2;
}
static bool is_short(const Ball *ball) // products of at most 24 bits
{
    const double most = 16777216;
    return ball->axis >= 100 && SQUARE * ball->off < most && ball->at * ball->axis < most;
}
static bool is_outside(double away, const Ball *ball)
{
    return away > 2 * ball->at;
}
static bool is_within(double away, const Ball *ball)
{
    return 2 * away < ball->at;
}

// Beside the axis, 1.2 to 3 radii off; the middle at angles from 30° to 150°.
static void ball_anywhere(Input *input, const Shape *shape, uint64_t *random)
{
    for (int i = 0; i < shape->size[0]; i++) {
        Ball ball;
        double off, beyond;
        do {
            ball = draw(random);
            off = SQUARE * ball.off;
            beyond = ball.along - ball.axis;
        } while (!is_short(&ball) || off < 1.44 * ball.at * ball.axis || off > 9 * ball.at * ball.axis ||
                 ball.along * ball.along > 3 * ball.off || beyond * beyond > 3 * ball.off);
        add(input, &ball);
    }
}

// The axis passes by at a millionth to some hundred-thousandths of the radius' square: behind the eye, between, beyond the light by turns.
static void ball_grazing(Input *input, const Shape *shape, uint64_t *random)
{
    for (int i = 0; i < shape->size[0]; i++) {
        Ball ball;
        double hair;
        do {
            ball = draw(random);
            set_radius(&ball, (int)fmin(sqrt(SQUARE * ball.off / fmax(ball.axis, 1)),
                                        RADIUS)); // the largest that fits
            hair = ball.clear / fmax(ball.at * ball.axis, 1);
        } while (!is_short(&ball) || hair < 1e-6 || hair > 6e-5 || !is_outside(ball.from_eye, &ball) ||
                 !is_outside(ball.from_light, &ball) || stretch(&ball) != i % 3);
        add(input, &ball);
    }
}

// The axis passes through, the eye and the light lie outside.
static void ball_pierced(Input *input, const Shape *shape, uint64_t *random)
{
    for (int i = 0; i < shape->size[0]; i++) {
        Ball ball;
        do {
            ball = draw(random);
        } while (!is_short(&ball) || 1.5 * SQUARE * ball.off > ball.at * ball.axis ||
                 !is_outside(ball.from_eye, &ball) || !is_outside(ball.from_light, &ball) ||
                 stretch(&ball) != i % 3);
        add(input, &ball);
    }
}

// By turns the eye within, the light, or both.
static void ball_holds(Input *input, const Shape *shape, uint64_t *random)
{
    for (int i = 0; i < shape->size[0]; i++) {
        const bool eye = i % 3 != 1, light = i % 3 != 0;
        Ball ball;
        do {
            ball = draw(random);
        } while (!is_short(&ball) || !(eye ? is_within : is_outside)(ball.from_eye, &ball) ||
                 !(light ? is_within : is_outside)(ball.from_light, &ball));
        add(input, &ball);
    }
}

const Generator inputs_06_ball[] = {{"ball_anywhere", ball_anywhere},
                                    {"ball_grazing", ball_grazing},
                                    {"ball_pierced", ball_pierced},
                                    {"ball_holds", ball_holds},
                                    {NULL, NULL}};
