// Exercise 04.4: lit stretches without cancellation.
//
// Objects throw shadows on a ray through clear mist, and shadow volumes come as they come: in any order, one inside another, and reaching
// beyond the ray's ends. The ray is lit where no shadow covers it. In mist that is so thin that nothing is lost on the way, its airlight is
//     L = ∫ dt / (h² + (t - f)²) over what is lit of [0, end],
// h the lamp's distance from the ray's line, f the foot. To sum signed integrals from the eye to each border is easy, and loses what matters: after
// a ray has passed close by the lamp, a lit millimetre is the difference of two large numbers.
//
// INPUT   15 numbers a ray: h, f, end; then 6 shadows, each from, to in metres from the eye (no shadow where from >= to)
// OUTPUT  1 number a ray: L in 1/m
// No lit stretch holds the lamp itself: where h = 0 the foot is in shadow, or not between 0 and end.
//
// Check it with: make check EX=04.4
#include "exercise.h"

#include <math.h>
#include <stdlib.h>

enum { SHADOWS = 6, NUMBERS = 3 + 2 * SHADOWS };

typedef struct Ray {
    float nearest, foot, end;  // h, f
    float shadows[SHADOWS][2]; // from, to
} Ray;

// The airlight of the stretch from a to b, both lit and what lies between.
static float stretch(const Ray *ray, float a, float b)
{
#ifdef SOLUTION
    // h times it is the angle under which the lamp sees the stretch: one angle, between two vectors, not the difference of two.
    float h = ray->nearest, before = a - ray->foot, behind = b - ray->foot, length = b - a;
    if (h == 0.0f)
        return length / (before * behind);
    return atan2f(h * length, h * h + before * behind) / h;
#else
    // Yours: this takes each metre for as bright as any other.
    (void)ray;
    return b - a;
#endif
}

static float airlight(const Ray *ray)
{
#ifdef SOLUTION
    float sum = 0.0f, at = 0.0f;
    while (at < ray->end) {
        float
            shaded_to = at,
            next =
                ray->end; // of the shadows that hold `at`, the farthest end; of the others, the nearest beginning
        for (int i = 0; i < SHADOWS; i++) {
            float from = ray->shadows[i][0], to = ray->shadows[i][1];
            if (from <= at)
                shaded_to = fmaxf(shaded_to, to);
            else if (from < to)
                next = fminf(next, from);
        }
        if (shaded_to == at) {
            sum += stretch(ray, at, next);
            at = next;
        } else {
            at = shaded_to;
        }
    }
    return sum;
#else
    // Yours: this knows no shadow.
    return stretch(ray, 0.0f, ray->end);
#endif
}

int main(int argc, char **argv)
{
    Exercise exercise = exercise_open(argc, argv);
    size_t rays = exercise.count / NUMBERS;
    float *output = memory_new(rays, sizeof *output, "airlight");
    for (size_t r = 0; r < rays; r++) {
        const float *in = exercise.input + NUMBERS * r;
        Ray ray = {.nearest = in[0], .foot = in[1], .end = in[2]};
        for (int i = 0; i < 2 * SHADOWS; i++)
            ray.shadows[i / 2][i % 2] = in[3 + i];
        output[r] = airlight(&ray);
    }
    int status = exercise_close(&exercise, output, rays);
    free(output);
    return status;
}
