// Chapter 06's ranges of a ball against their own words: the least and the greatest angle over points of the ball, sought in double without any tangent; and
// what is recorded of each known mistake is not that.
#include <criterion/criterion.h>

#include "support_course.h"

#include <math.h>

TestSuite(course_epipolar, .timeout = 60);

static const double PI = 3.14159265358979323846;

typedef struct Scene {
    double light[3], middle[3], radius;
    double ways[3][3]; // unit: along the axis, from it towards the middle, and across both
} Scene;

static void cross(const double *a, const double *b, double *c)
{
    for (int k = 0; k < 3; k++)
        c[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}
static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void unit(const double *a, double *b)
{
    for (int k = 0; k < 3; k++)
        b[k] = a[k] / sqrt(dot(a, a));
}

// An angle of a point that is to be as small as it can be.
typedef double (*Angle)(const Scene *scene, const double *point);

static double between(const double *a, const double *b)
{
    double c[3];
    cross(a, b, c);
    return atan2(sqrt(dot(c, c)), dot(a, b));
}
static double alpha(const Scene *scene, const double *point)
{
    return between(scene->light, point);
}
static double phi(const Scene *scene, const double *point)
{
    double towards_eye[3], way[3];
    for (int k = 0; k < 3; k++) {
        towards_eye[k] = -scene->light[k];
        way[k] = point[k] - scene->light[k];
    }
    return between(towards_eye, way);
}
static double minus_phi(const Scene *scene, const double *point)
{
    return -phi(scene, point);
}
static double minus_turn(const Scene *scene, const double *point) // θ of a point, to one side of the middle's
{
    double across[3];
    cross(scene->light, point, across);
    return -between(scene->ways[2], across);
}

static double at(const Scene *scene, Angle angle, double latitude, double longitude)
{
    const double part[3] = {sin(latitude), cos(latitude) * cos(longitude), cos(latitude) * sin(longitude)};
    double point[3];
    for (int k = 0; k < 3; k++)
        point[k] =
            scene->middle[k] + scene->radius * (part[0] * scene->ways[0][k] + part[1] * scene->ways[1][k] +
                                                part[2] * scene->ways[2][k]);
    return angle(scene, point);
}

// Over the ball's surface, where every extreme lies that is not 0, π or a whole turn: from the best of many points by steps that halve. Latitude and longitude are
// the axis': beside it the angle is a narrow valley, and steps aslant would stay on its walls.
static double least(const Scene *scene, Angle angle)
{
    enum { ROWS = 16, COLUMNS = 32 };
    double u = 0, v = 0, best = INFINITY;
    for (int row = 0; row < ROWS; row++)
        for (int column = 0; column < COLUMNS; column++) {
            const double latitude = ((row + 0.5) / ROWS - 0.5) * PI, longitude = 2 * PI * column / COLUMNS;
            const double value = at(scene, angle, latitude, longitude);
            if (value < best)
                best = value, u = latitude, v = longitude;
        }
    for (double step = PI / ROWS; step > 1e-10;) {
        bool better = false;
        for (int i = 0; i < 9; i++) {
            const int row = i / 3 - 1, column = i % 3 - 1;
            const double latitude = u + row * step, longitude = v + column * step;
            const double value = at(scene, angle, latitude, longitude);
            if (value < best)
                best = value, u = latitude, v = longitude, better = true;
        }
        if (!better)
            step *= 0.5;
    }
    return best;
}

static bool holds(const Scene *scene, const double *point)
{
    double way[3];
    for (int k = 0; k < 3; k++)
        way[k] = point[k] - scene->middle[k];
    return dot(way, way) < scene->radius * scene->radius;
}

// light, middle, radius
static void ranges(const float *in, const float *got, double *wanted)
{
    (void)got;
    Scene scene = {.radius = (double)in[6]};
    for (int k = 0; k < 3; k++) {
        scene.light[k] = (double)in[k];
        scene.middle[k] = (double)in[3 + k];
    }
    const double foot = dot(scene.light, scene.middle) / dot(scene.light, scene.light);
    const bool x = fabs(scene.light[0]) < fabs(scene.light[1]);
    const double off_axis[3] = {x, !x, 0}; // of a middle on the axis, any way off it
    double nearest[3], normal[3];
    for (int k = 0; k < 3; k++)
        nearest[k] = foot * scene.light[k];
    cross(scene.light, scene.middle, normal);
    if (dot(normal, normal) == 0)
        cross(scene.light, off_axis, normal);
    unit(scene.light, scene.ways[0]);
    unit(normal, scene.ways[2]);
    cross(scene.ways[2], scene.ways[0], scene.ways[1]);
    static const double eye[3] = {0, 0, 0};
    const bool pierced = holds(&scene, nearest), eye_within = holds(&scene, eye),
               light_within = holds(&scene, scene.light);
    wanted[0] = eye_within || (pierced && foot > 0) ? 0 : least(&scene, alpha);
    wanted[1] = pierced ? 2 * PI : -2 * least(&scene, minus_turn);
    wanted[2] = light_within || (pierced && foot < 1) ? 0 : least(&scene, phi);
    wanted[3] = light_within || (pierced && foot > 1) ? PI : -least(&scene, minus_phi);
}

Test(course_epipolar, ranges_of_a_ball_are_those_of_its_points)
{
    course_judge("06.6", ranges);
}
