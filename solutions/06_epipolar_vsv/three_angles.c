// Exercise 06.1: the three angles of eye, light and point, exact at both ends.
//
// The lesson takes α and φ from a unit vector towards the light and from distances along it. That axis is rounded, and so is the distance from eye to
// light; where a point lies close to the axis, or close to a light that is far from the eye, nothing else is left of the angle. Eye, light and point
// are a triangle. Find its three angles so that each is right to a millionth of itself, however thin the triangle is.
//
// INPUT   6 numbers a point: the light, then the point, in metres from the eye
// OUTPUT  3 numbers a point: α at the eye, between light and point; φ at the light, between eye and point; γ at the point, between eye and light;
//         in radians, 0 to π
// Where two of the three coincide, all three angles are 0. The inputs are short binary numbers: differences of them are exact, and so is the cross
// product of light and point.
//
// Check it with: make check EX=06.1
#include "exercise.h"
#include "linear.h"

#include <stdlib.h>

typedef struct Angles {
    float alpha, phi, gamma;
} Angles;

#ifdef SOLUTION
// Twice the triangle's area is the cross product of any two sides, and |a||b| sin of the angle between them; the dot product is |a||b| cos. A corner whose
// side has no length has 0 for both: ±0, and atan2f would make π of a -0.
static float angle(float double_area, float dot)
{
    return double_area == 0.0f && dot == 0.0f ? 0.0f : atan2f(double_area, dot);
}

#endif
static Angles angles_of(vec3 light, vec3 point)
{
#ifdef SOLUTION
    // Of these two alone the products are short enough to be exact.
    float double_area = vec3_length(vec3_cross(light, point));
    return (Angles){.alpha = angle(double_area, vec3_dot(light, point)),
                    .phi = angle(double_area, vec3_dot(light, light - point)),
                    .gamma = angle(double_area, vec3_dot(point, point - light))};
#else
    // Yours: this is no triangle at all.
    (void)light, (void)point;
    return (Angles){.alpha = -1.0f, .phi = -1.0f, .gamma = -1.0f};
#endif
}

int main(int argc, char **argv)
{
    Exercise exercise = exercise_open(argc, argv);
    size_t points = exercise.count / 6;
    float *output = memory_new(3 * points, sizeof *output, "angles");
    for (size_t i = 0; i < points; i++) {
        const float *in = exercise.input + 6 * i;
        Angles angles = angles_of(vec3_make(in[0], in[1], in[2]), vec3_make(in[3], in[4], in[5]));
        output[3 * i] = angles.alpha;
        output[3 * i + 1] = angles.phi;
        output[3 * i + 2] = angles.gamma;
    }
    int status = exercise_close(&exercise, output, 3 * points);
    free(output);
    return status;
}
