// epipolar: see epipolar.h.
#include "epipolar.h"

#include <stdlib.h>

static const double PI = 3.14159265358979323846;

typedef struct Vector {
    double x[3];
} Vector;
static Vector vector_of(vec3 v)
{
    return (Vector){{(double)v[0], (double)v[1], (double)v[2]}};
}
static Vector sum(double s, Vector a, double t, Vector b)
{
    return (Vector){{s * a.x[0] + t * b.x[0], s * a.x[1] + t * b.x[1], s * a.x[2] + t * b.x[2]}};
}
static double dot(Vector a, Vector b)
{
    return a.x[0] * b.x[0] + a.x[1] * b.x[1] + a.x[2] * b.x[2];
}
static Vector cross(Vector a, Vector b)
{
    return (Vector){{a.x[1] * b.x[2] - a.x[2] * b.x[1], a.x[2] * b.x[0] - a.x[0] * b.x[2],
                     a.x[0] * b.x[1] - a.x[1] * b.x[0]}};
}
static double length(Vector a)
{
    return hypot(hypot(a.x[0], a.x[1]), a.x[2]);
}
static Vector unit(Vector a)
{
    const double scale = length(a);
    return scale > 0.0 ? sum(1.0 / scale, a, 0.0, a) : a;
}
static vec3 to_vec3(Vector a)
{
    return vec3_make((float)a.x[0], (float)a.x[1], (float)a.x[2]);
}
static double angle(Vector a, Vector b)
{
    return atan2(length(cross(a, b)), dot(a, b));
}

// The camera's right, up and forward.
static void camera_axes(const Camera *camera, Vector axes[3])
{
    const mat4 view = camera_view(*camera);
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 3; i++)
            axes[k].x[i] = (k == 2 ? -1.0 : 1.0) * (double)view.column[i][k];
}

//[frame
// Wyman takes cross(toLight, (0, 0, -1)) for a second axis, which vanishes for a light straight ahead or behind; his text's "camera's up" does for one above. No
// single vector will do (a sphere has no field of directions without a hole): so it is the camera's axis that is nearest to a right angle, up first.
EpipolarFrame epipolar_frame(const Camera *camera, const Light *light)
{
    Vector axes[3];
    camera_axes(camera, axes);
    const bool at_infinity = light->kind == LIGHT_DIRECTIONAL;
    const Vector way = at_infinity ? sum(-1.0, vector_of(light->direction), 0.0, axes[0])
                                   : sum(1.0, vector_of(light->position), -1.0, vector_of(camera->eye));
    const double distance = length(way);
    const Vector axis = unit(distance > 0.0 ? way : axes[2]);
    static const int order[3] = {1, 0, 2};
    int chosen = 1;
    for (int i = 1; i < 3; i++)
        if (fabs(dot(axes[order[i]], axis)) + 0.3 < fabs(dot(axes[chosen], axis)))
            chosen = order[i];
    const Vector up = unit(sum(1.0, axes[chosen], -dot(axes[chosen], axis), axis));
    return (EpipolarFrame){.eye = camera->eye,
                           .axis = to_vec3(axis),
                           .up = to_vec3(up),
                           .side = to_vec3(cross(axis, up)),
                           .distance = at_infinity ? INFINITY : (float)distance,
                           .at_infinity = at_infinity};
}
//]

EpipolarRange epipolar_range_full(int alpha, int theta, int phi)
{
    const float pi = (float)PI;
    return (EpipolarRange){.alpha_most = pi,
                           .theta_least = -pi,
                           .theta_span = 2.0f * pi,
                           .phi_most = pi,
                           .alpha = alpha,
                           .theta = theta,
                           .phi = phi};
}

// The picture's corners as unit directions, in order round it.
static void picture_corners(const Camera *camera, float aspect, Vector corners[4])
{
    Vector axes[3];
    camera_axes(camera, axes);
    const double half = tan(0.5 * (double)camera->vertical_fov_rad);
    for (int i = 0; i < 4; i++) {
        const double x = (i == 1 || i == 2 ? half : -half) * (double)aspect, y = i >= 2 ? half : -half;
        corners[i] = unit(sum(1.0, axes[2], 1.0, sum(x, axes[0], y, axes[1])));
    }
}
static double theta_of(const EpipolarFrame *frame, Vector way)
{
    return atan2(dot(vector_of(frame->side), way), dot(vector_of(frame->up), way));
}
static double nearest_turn(double difference) // the same angle in [-π, π]
{
    return difference - 2.0 * PI * round(difference / (2.0 * PI));
}
static bool inside_picture(const Vector corners[4], Vector way)
{
    bool inside = true;
    for (int i = 0; i < 4; i++)
        inside = inside && dot(cross(corners[(i + 1) % 4], corners[i]), way) > -1e-7;
    return inside;
}

//[alpha
// The angle to the axis is least and greatest at corners, or where an edge (a part of a great circle) passes the axis or its antipode nearest.
static void alpha_seen(Vector axis, const Vector corners[4], double *least, double *most)
{
    *least = PI;
    *most = 0.0;
    for (int i = 0; i < 4; i++) {
        const Vector from = corners[i], to = corners[(i + 1) % 4], normal = unit(cross(from, to));
        const Vector foot = unit(sum(1.0, axis, -dot(axis, normal), normal));
        *least = fmin(*least, angle(axis, from));
        *most = fmax(*most, angle(axis, from));
        const double before = dot(cross(from, foot), normal), behind = dot(cross(foot, to), normal);
        if (before >= 0.0 && behind >= 0.0)
            *least = fmin(*least, angle(axis, foot));
        if (before <= 0.0 && behind <= 0.0)
            *most = fmax(*most, angle(axis, sum(-1.0, foot, 0.0, foot)));
    }
    if (inside_picture(corners, axis))
        *least = 0.0;
    if (inside_picture(corners, sum(-1.0, axis, 0.0, axis)))
        *most = PI;
}
//]

EpipolarRange epipolar_range_seen(const EpipolarFrame *frame, const Camera *camera, float aspect, int alpha,
                                  int theta, int phi)
{
    EpipolarRange range = epipolar_range_full(alpha, theta, phi);
    const Vector axis = vector_of(frame->axis), back = sum(-1.0, axis, 0.0, axis);
    Vector corners[4];
    double least, most;
    picture_corners(camera, aspect, corners);
    alpha_seen(axis, corners, &least, &most);
    range.alpha_least = (float)least;
    range.alpha_most = (float)most;
    // Seen past its side, the axis leaves less than π of θ, whose ends are corners.
    if (!inside_picture(corners, axis) && !inside_picture(corners, back)) {
        const double middle = theta_of(frame, sum(1.0, sum(1.0, corners[0], 1.0, corners[2]), 1.0,
                                                  sum(1.0, corners[1], 1.0, corners[3])));
        double before = 0.0, behind = 0.0;
        for (int i = 0; i < 4; i++) {
            const double turn = nearest_turn(theta_of(frame, corners[i]) - middle);
            before = fmin(before, turn);
            behind = fmax(behind, turn);
        }
        range.theta_least = (float)(middle + before);
        range.theta_span = (float)(behind - before);
    }
    return range;
}

//[box
// What lies within an angle below π/2 of a ray, or within a distance of a line, is convex: it holds a box whose corners it holds.
float epipolar_phi_of_box(const EpipolarFrame *frame, vec3 lower, vec3 upper)
{
    const Vector axis = vector_of(frame->axis), eye = vector_of(frame->eye);
    double most = 0.0;
    for (int i = 0; i < 8; i++) {
        const vec3 corner =
            vec3_make(i & 1 ? upper[0] : lower[0], i & 2 ? upper[1] : lower[1], i & 4 ? upper[2] : lower[2]);
        const Vector from_eye = sum(1.0, vector_of(corner), -1.0, eye);
        const double beside = length(cross(axis, from_eye)), along = dot(axis, from_eye);
        most = fmax(most, frame->at_infinity ? beside : atan2(beside, (double)frame->distance - along));
    }
    return (float)(frame->at_infinity || most < 0.5 * PI ? most : PI);
}
//]

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

//[theta
// A plane meets the picture in a line to its border. So planes through all pixels of the border lie at most a pixel apart on it, and nearer everywhere else
// (Engelhardt and Dachsbacher 2010; Baran et al. 2010). Of these planes in order, as many as there are slices are taken evenly.
float *epipolar_theta_borders(const EpipolarFrame *frame, const EpipolarRange *range, const Camera *camera,
                              int width, int height, int *needed)
{
    Vector corners[4];
    picture_corners(camera, (float)width / (float)height, corners);
    const int round_picture[4] = {width, height, width, height};
    const size_t count = 2 * ((size_t)width + (size_t)height) + 2;
    double *turns = memory_new(count, sizeof *turns, "the picture's border");
    const double middle = (double)range->theta_least + 0.5 * (double)range->theta_span;
    size_t used = 0;
    turns[used++] = 0.0;
    for (int side = 0; side < 4; side++) {
        // corners are unit, all of one length: a point between them divides the edge evenly
        for (int i = 0; i < round_picture[side]; i++) {
            const double share = (double)i / round_picture[side];
            const Vector way = sum(1.0 - share, corners[side], share, corners[(side + 1) % 4]);
            const double turn = nearest_turn(theta_of(frame, way) - middle) / (double)range->theta_span;
            turns[used++] = fmin(fmax(turn + 0.5, 0.0), 1.0);
        }
    }
    turns[used++] = 1.0;
    qsort(turns, used, sizeof *turns, compare);
    float *borders = memory_new((size_t)range->theta + 1, sizeof *borders, "slices of theta");
    for (int i = 0; i <= range->theta; i++) {
        const double at = (double)i / range->theta * (double)(used - 1);
        const size_t below = (size_t)fmin(at, (double)(used - 2));
        borders[i] = (float)(turns[below] + (at - (double)below) * (turns[below + 1] - turns[below]));
    }
    free(turns);
    *needed = (int)used - 1;
    return borders;
}
//]

void epipolar_set(const Shader *shader, const EpipolarFrame *frame, const EpipolarRange *range)
{
    const vec3 least = vec3_make(range->alpha_least, range->theta_least, range->phi_least);
    const vec3 most = vec3_make(range->alpha_most, range->theta_least + range->theta_span, range->phi_most);
    const vec3 span =
        vec3_make(fmaxf(most[0] - least[0], 1e-30f), range->theta_span, fmaxf(most[2] - least[2], 1e-30f));
    const int count[3] = {range->alpha, range->theta, range->phi};
    shader_set_vec3(shader, "epipolar_axis", (const float *)&frame->axis);
    shader_set_vec3(shader, "epipolar_up", (const float *)&frame->up);
    shader_set_vec3(shader, "epipolar_side", (const float *)&frame->side);
    shader_set_float(shader, "epipolar_distance", frame->at_infinity ? 0.0f : frame->distance);
    shader_set_vec3(shader, "epipolar_least", (const float *)&least);
    shader_set_vec3(shader, "epipolar_span", (const float *)&span);
    shader_set_ivec3(shader, "epipolar_count", count);
}
