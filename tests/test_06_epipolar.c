// 06 epipolar: the space itself: GLSL's angles against double precision, the frame wherever the light stands, what of the space a picture sees.
#include "../chapters/06_epipolar_vsv/epipolar.h"

#include <criterion/criterion.h>
#include <stdlib.h>
#include <string.h>

static const double PI = 3.14159265358979323846;

static double uniform(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) * 0x1p-53;
}
static vec3 random_vec3(uint64_t *state, double size)
{
    const double x = uniform(state), y = uniform(state), z = uniform(state);
    return vec3_make((float)(size * (2 * x - 1)), (float)(size * (2 * y - 1)), (float)(size * (2 * z - 1)));
}
static Camera camera_at(vec3 eye, vec3 target)
{
    return (Camera){.eye = eye, .target = target, .up = vec3_make(0, 1, 0), .vertical_fov_rad = 0.9f};
}

// In double, from the float inputs alone. θ about the frame's own axes.
typedef struct Exact {
    double alpha, theta, phi, along;
} Exact;
static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
static double cross_length(const double a[3], const double b[3])
{
    return hypot(hypot(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2]), a[0] * b[1] - a[1] * b[0]);
}
static Exact exact_of(const EpipolarFrame *frame, vec3 point)
{
    double axis[3], up[3], side[3], p[3], from_light[3], back[3];
    for (int k = 0; k < 3; k++) {
        axis[k] = (double)frame->axis[k];
        up[k] = (double)frame->up[k];
        side[k] = (double)frame->side[k];
        p[k] = (double)point[k];
        from_light[k] = p[k] - (frame->at_infinity ? 0.0 : (double)frame->distance * axis[k]);
        back[k] = -axis[k];
    }
    const double beside = cross_length(axis, p);
    return (Exact){.alpha = atan2(beside, dot(axis, p)),
                   .theta = atan2(dot(side, p), dot(up, p)),
                   .phi = frame->at_infinity ? beside
                                             : atan2(cross_length(back, from_light), dot(back, from_light)),
                   .along = sqrt(dot(p, p))};
}

typedef struct Results {
    float epipolar[3], along, back[3], unused, printed[2], unused2[2], again[4];
} Results;
static Results *convert(const EpipolarFrame *frame, const EpipolarRange *range, const vec4 *points,
                        size_t count, const char *definitions, const float *borders)
{
    Results *results = memory_new(count, sizeof *results, "results");
    shader_search_first("tests/data/epipolar");
    Shader *shader = shader_open("convert", definitions, "convert.comp");
    GLuint in = gl_buffer(.label = "points", .bytes = count * sizeof *points, .data = points);
    GLuint out = gl_buffer(.label = "results", .bytes = count * sizeof *results);
    GLuint table =
        gl_buffer(.label = "borders", .bytes = borders ? ((size_t)range->theta + 1) * 4 : 0, .data = borders);
    epipolar_set(shader, frame, range);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, in);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, out);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, table);
    shader_use(shader);
    gl.DispatchCompute((GLuint)(count + 7) / 8, 1, 1);
    gl.MemoryBarrier(GL_ALL_BARRIER_BITS);
    gl_buffer_read(out, 0, count * sizeof *results, results);
    gl_buffer_delete(&in);
    gl_buffer_delete(&out);
    gl_buffer_delete(&table);
    shader_close(shader);
    return results;
}

// Points at random, and points whose angle to the axis at the eye, or at the light, is 10^-1 to 10^-6 short of 0 or π.
enum { POINTS = 1024 };
static void points_of(const EpipolarFrame *frame, vec4 points[POINTS])
{
    uint64_t state = 7;
    for (int i = 0; i < POINTS; i++) {
        vec3 p = random_vec3(&state, 8.0);
        if (i % 4 != 0) {
            const float small = powf(10.0f, -1.0f - (float)(i / 4 % 6)),
                        away = 0.3f + (float)uniform(&state) * 6;
            const float turn = 6.0f * (float)uniform(&state), sign = i % 4 == 1 ? -1.0f : 1.0f;
            const vec3 beside = cosf(turn) * frame->up + sinf(turn) * frame->side;
            const float start = i % 4 == 3 && !frame->at_infinity ? frame->distance : 0.0f;
            p = (start + sign * away) * frame->axis + small * away * beside;
        }
        points[i] = p;
    }
}

// What rounding the point itself may change: 2^-23 of its length at right angles to the axis, seen from eye or light; atan(y, x) is off by up to 3.4e-6 here, of
// small angles by no more than that share.
static void check_conversions(const Light *light)
{
    gl_open(GL_PLATFORM_OSMESA, 16, 16, "test");
    const Camera camera = camera_at(vec3_make(0.3f, 0.7f, 2), vec3_make(0, 0, -3));
    const EpipolarFrame frame = epipolar_frame(&camera, light);
    EpipolarRange range = epipolar_range_full(64, 64, 128);
    range.phi_most = frame.at_infinity ? 20.0f : range.phi_most;
    vec4 points[POINTS];
    points_of(&frame, points);
    const char *definitions = frame.at_infinity ? "EPIPOLE_AT_INFINITY 1" : "EPIPOLE_AT_INFINITY 0";
    Results *got = convert(&frame, &range, points, POINTS, definitions, NULL);
    for (int i = 0; i < POINTS; i++) {
        const Exact exact = exact_of(&frame, points[i]);
        const double from_light = (double)vec3_length(points[i] - frame.distance * frame.axis);
        const double reach = frame.at_infinity ? exact.along : fmin(exact.along, from_light);
        const double rounding =
            4e-7 * (exact.along + (frame.at_infinity ? 0 : (double)frame.distance)) / reach;
        const double small_alpha = fmin(exact.alpha, PI - exact.alpha),
                     small_phi = fmin(exact.phi, PI - exact.phi);
        const double phi_error = fabs((double)got[i].epipolar[2] - exact.phi);
        cr_assert(fabs((double)got[i].epipolar[0] - exact.alpha) <= fmin(5e-6, 2e-5 * exact.alpha) + rounding,
                  "alpha %.9g for %.9g", (double)got[i].epipolar[0], exact.alpha);
        cr_assert(phi_error <=
                      (frame.at_infinity ? 1e-6 * exact.along : fmin(5e-6, 2e-5 * exact.phi) + rounding),
                  "phi %.9g for %.9g", (double)got[i].epipolar[2], exact.phi);
        if (small_alpha > 1e-3) { // θ is the angle of what is at right angles to the axis
            double turn = fabs((double)got[i].epipolar[1] - exact.theta);
            turn = fmin(turn, 2 * PI - turn);
            cr_assert(turn <= 5e-6 + 2e-7 / sin(small_alpha), "theta %g for %g", (double)got[i].epipolar[1],
                      exact.theta);
        }
        // Back: how far along is known as well as the angle in which both rays meet.
        const double third = frame.at_infinity ? small_alpha : PI - exact.alpha - exact.phi;
        if (fmin(third, fmin(small_alpha, frame.at_infinity ? 1.0 : small_phi)) > 1e-2) {
            const float off =
                vec3_length(vec3_make(got[i].back[0], got[i].back[1], got[i].back[2]) - points[i]);
            cr_assert((double)off <= 3e-5 * exact.along / sin(third) / sin(fmin(small_alpha, 1.5)) + 1e-5,
                      "%g off of %g, third angle %g", (double)off, exact.along, third);
        }
        for (int k = 0; k < 3; k++) // to a place in the grid and back
            cr_assert(fabsf(got[i].again[k] - got[i].epipolar[k]) <= 3e-6f * (k == 2 ? range.phi_most : 6.3f),
                      "axis %d", k);
    }
    free(got);
    gl_close();
}
Test(epipolar, conversions_with_the_light_ahead)
{
    check_conversions(&(Light){.kind = LIGHT_POINT, .position = vec3_make(0.1f, 0.4f, -2)});
}
Test(epipolar, conversions_with_the_light_beside)
{
    check_conversions(&(Light){.kind = LIGHT_SPOT, .position = vec3_make(4, 2, 1.5f)});
}
Test(epipolar, conversions_with_the_light_behind)
{
    check_conversions(&(Light){.kind = LIGHT_POINT, .position = vec3_make(0.9f, 2, 5)});
}
Test(epipolar, conversions_with_the_epipole_at_infinity)
{
    check_conversions(
        &(Light){.kind = LIGHT_DIRECTIONAL, .direction = vec3_normalize(vec3_make(0.3f, -1, 0.2f))});
}

// Wyman 2011, section 2.1, prints clamped arc cosines. Near 0 and π they are off by more than the angle; ours are not.
Test(epipolar, printed_arc_cosines_fail_near_their_ends)
{
    gl_open(GL_PLATFORM_OSMESA, 16, 16, "test");
    const Camera camera = camera_at(vec3_make(0, 0, 0), vec3_make(0, 0, -1));
    const Light light = {.kind = LIGHT_POINT, .position = vec3_make(0, 0, -2)};
    const EpipolarFrame frame = epipolar_frame(&camera, &light);
    const EpipolarRange range = epipolar_range_full(64, 64, 128);
    const vec4 points[2] = {vec3_make(1e-4f, 0, -1), vec3_make(0, 1e-4f, -4)};
    Results *got = convert(&frame, &range, points, 2, NULL, NULL);
    for (int i = 0; i < 2; i++) {
        const Exact exact = exact_of(&frame, points[i]);
        const double angle[2] = {exact.alpha, exact.phi};
        for (int k = 0; k < 2; k++) {
            const double small = fmin(angle[k], PI - angle[k]);
            const double ours = fabs((double)got[i].epipolar[k ? 2 : 0] - angle[k]),
                         printed = fabs((double)got[i].printed[k] - angle[k]);
            // near π a float itself is known to 2.4e-7 only
            cr_assert(ours < 0.01 * small, "ours is off by %g of %g", ours, small);
            cr_assert(printed > 0.5 * small, "as printed: off by %g of %g", printed, small);
        }
    }
    free(got);
    gl_close();
}

// Three unit vectors at right angles, wherever the light stands.
static void check_frame(const char *where, const EpipolarFrame *frame)
{
    const vec3 *const axes[3] = {&frame->axis, &frame->up, &frame->side};
    for (int i = 0; i < 3; i++) {
        cr_assert(fabsf(vec3_length(*axes[i]) - 1.0f) < 1e-6f, "%s: vector %d is %g long", where, i,
                  (double)vec3_length(*axes[i]));
        cr_assert(fabsf(vec3_dot(*axes[i], *axes[(i + 1) % 3])) < 1e-6f, "%s: %d and its next", where, i);
    }
    cr_assert(vec3_dot(vec3_cross(frame->axis, frame->up), frame->side) > 0.99f, "%s: left-handed", where);
}
Test(epipolar, frames_stand_wherever_the_light_does)
{
    static const float ways[][3] = {{0, 0, -1},    {0, 0, 1},      {0, 1, 0},    {0, -1, 0},
                                    {1, 0, 0},     {-1, 0, 0},     {0, 0, 0},    {0, 1e-6f, -1},
                                    {1e-6f, 1, 0}, {1e-20f, 0, 0}, {1e6f, 1, 0}, {1, 1, -1}};
    const Camera camera = camera_at(vec3_make(0, 0, 0), vec3_make(0, 0, -1));
    for (size_t i = 0; i < sizeof ways / sizeof *ways; i++) {
        const vec3 way = vec3_make(ways[i][0], ways[i][1], ways[i][2]);
        const Light point = {.kind = LIGHT_POINT, .position = way},
                    sun = {.kind = LIGHT_DIRECTIONAL, .direction = -vec3_normalize(way)};
        char *where =
            text_format("light towards (%g, %g, %g)", (double)way[0], (double)way[1], (double)way[2]);
        const EpipolarFrame frame = epipolar_frame(&camera, &point);
        check_frame(where, &frame);
        cr_assert(fabsf(vec3_dot(frame.axis, way) - frame.distance) <= 1e-6f * frame.distance, "%s", where);
        if (vec3_length(way) > 0) {
            const EpipolarFrame far = epipolar_frame(&camera, &sun);
            check_frame(where, &far);
            cr_assert(far.at_infinity);
        }
        free(where);
        // as printed: up = normalize(cross(toLight, (0, 0, -1)))
        if (i < 2)
            cr_assert_eq(vec3_length(vec3_cross(way, vec3_make(0, 0, -1))), 0.0f, "the printed frame stands");
    }
}

// Every ray of the picture has its angles in the range; and some come near its ends.
Test(epipolar, ranges_hold_what_is_seen)
{
    uint64_t state = 3;
    for (int trial = 0; trial < 200; trial++) {
        const Camera camera = camera_at(random_vec3(&state, 2), random_vec3(&state, 2));
        const Light light = {.kind = trial % 3 ? LIGHT_POINT : LIGHT_DIRECTIONAL,
                             .position = random_vec3(&state, 3),
                             .direction = vec3_normalize(random_vec3(&state, 1))};
        const EpipolarFrame frame = epipolar_frame(&camera, &light);
        const EpipolarRange range = epipolar_range_seen(&frame, &camera, 1.5f, 64, 64, 128);
        const mat4 view = camera_view(camera);
        const float half = tanf(0.5f * camera.vertical_fov_rad);
        double least = 9, most = 0, turn_least = 9, turn_most = -9;
        const double middle = (double)range.theta_least + 0.5 * (double)range.theta_span;
        for (int i = 0; i < 61 * 61; i++) {
            const int column = i % 61, row = i / 61;
            const float x = 1.5f * half * ((float)column / 30 - 1), y = half * ((float)row / 30 - 1);
            vec3 ray = {0};
            for (int k = 0; k < 3; k++)
                ray[k] = x * view.column[k][0] + y * view.column[k][1] - view.column[k][2];
            const Exact exact = exact_of(&frame, ray);
            const double turn = remainder(exact.theta - middle, 2 * PI);
            least = fmin(least, exact.alpha);
            most = fmax(most, exact.alpha);
            turn_least = fmin(turn_least, turn);
            turn_most = fmax(turn_most, turn);
        }
        cr_assert(least >= (double)range.alpha_least - 1e-5 && most <= (double)range.alpha_most + 1e-5,
                  "trial %d: alpha [%g, %g] of [%g, %g]", trial, least, most, (double)range.alpha_least,
                  (double)range.alpha_most);
        cr_assert(least <= (double)range.alpha_least + 0.03 && most >= (double)range.alpha_most - 0.03,
                  "trial %d: alpha's range [%g, %g] is wider than [%g, %g]", trial, (double)range.alpha_least,
                  (double)range.alpha_most, least, most);
        cr_assert(fmax(-turn_least, turn_most) <= 0.5 * (double)range.theta_span + 1e-5,
                  "trial %d: theta [%g, %g] of %g", trial, turn_least, turn_most, (double)range.theta_span);
        if (range.theta_span < 3.0f) // a part of the planes: its ends are corners
            cr_assert(turn_most - turn_least >= (double)range.theta_span - 0.03, "trial %d: theta", trial);
    }
}

Test(epipolar, no_point_of_a_box_lies_beyond_its_phi)
{
    uint64_t state = 11;
    int below = 0;
    for (int trial = 0; trial < 300; trial++) {
        const Camera camera = camera_at(random_vec3(&state, 2), random_vec3(&state, 2));
        const Light light = {.kind = trial % 3 ? LIGHT_POINT : LIGHT_DIRECTIONAL,
                             .position = random_vec3(&state, 6),
                             .direction = vec3_normalize(random_vec3(&state, 1))};
        const EpipolarFrame frame = epipolar_frame(&camera, &light);
        const vec3 a = random_vec3(&state, 2), b = random_vec3(&state, 2), lower = vec3_min(a, b),
                   upper = vec3_max(a, b);
        const double most = (double)epipolar_phi_of_box(&frame, lower, upper);
        double got = 0;
        for (int i = 0; i < 200; i++) {
            vec3 p = {0};
            for (int k = 0; k < 3; k++)
                p[k] =
                    lower[k] + (i < 8 ? (float)(i >> k & 1) : (float)uniform(&state)) * (upper[k] - lower[k]);
            got = fmax(got, exact_of(&frame, p - camera.eye).phi);
        }
        cr_assert(got <= most * (1 + 1e-5) + 1e-5, "trial %d: %g beyond %g", trial, got, most);
        below += most < 3.0 || frame.at_infinity;
        if (most < 1.57 || frame.at_infinity)
            cr_assert(got >= most * (1 - 1e-5), "trial %d: %g is less than %g", trial, got, most);
    }
    cr_assert(below > 100, "only %d boxes were bounded", below);
}

// Neighbouring planes, where they meet the picture's border, are at most a pixel apart if there are as many as are needed; and they rise.
Test(epipolar, slices_are_at_most_a_pixel_apart)
{
    enum { SIDE = 40 };
    static const float lights[][3] = {{0.1f, 0.2f, -3}, {3, 0.5f, -1}, {0.4f, 0.1f, 3}, {0, 4, -2}};
    const Camera camera = camera_at(vec3_make(0, 0, 0), vec3_make(0, 0, -1));
    const double half = tan(0.5 * (double)camera.vertical_fov_rad);
    for (size_t n = 0; n < 4; n++) {
        const Light light = {.kind = LIGHT_POINT,
                             .position = vec3_make(lights[n][0], lights[n][1], lights[n][2])};
        const EpipolarFrame frame = epipolar_frame(&camera, &light);
        EpipolarRange range = epipolar_range_seen(&frame, &camera, 1.0f, 64, 64, 128);
        int needed;
        free(epipolar_theta_borders(&frame, &range, &camera, SIDE, SIDE, &needed));
        range.theta = needed;
        float *borders = epipolar_theta_borders(&frame, &range, &camera, SIDE, SIDE, &needed);
        cr_assert(borders[0] == 0.0f && borders[needed] == 1.0f);
        // along the picture's border in tenths of a pixel: how far one slice goes on
        double begun = 0.0, widest = 0.0;
        int last = -1;
        for (int i = 0; i < 40 * SIDE; i++) {
            const double at = 2.0 * (i % (10 * SIDE)) / (10.0 * SIDE) - 1.0;
            const int side = i / (10 * SIDE);
            const double x = side == 0   ? at
                             : side == 1 ? 1
                             : side == 2 ? -at
                                         : -1,
                         y = side == 0   ? -1
                             : side == 1 ? at
                             : side == 2 ? 1
                                         : -at;
            const double theta = exact_of(&frame, vec3_make((float)(half * x), (float)(half * y), -1)).theta;
            const double from_middle =
                remainder(theta - (double)range.theta_least - 0.5 * (double)range.theta_span, 2 * PI);
            const double u = fmin(fmax(from_middle / (double)range.theta_span + 0.5, 0), 1);
            int slice = 0;
            while (slice < needed - 1 && (double)borders[slice + 1] <= u)
                slice++;
            if (slice != last || i % (10 * SIDE) == 0) // round a corner planes turn back
                begun = i / 10.0;
            widest = fmax(widest, i / 10.0 - begun);
            last = slice;
        }
        cr_assert(widest <= 1.15, "light %zu: a slice is %g pixels wide", n,
                  widest); // and a tenth of a pixel
        for (int i = 0; i < needed; i++)
            cr_assert(borders[i] <= borders[i + 1]);
        free(borders);
    }
}

// Borders from a table, φ as the square: places and back are the same function's two directions.
Test(epipolar, warps_come_back)
{
    gl_open(GL_PLATFORM_OSMESA, 16, 16, "test");
    const Camera camera = camera_at(vec3_make(0.3f, 0.7f, 2), vec3_make(0, 0, -3));
    const Light light = {.kind = LIGHT_POINT, .position = vec3_make(0.1f, 0.4f, -2)};
    const EpipolarFrame frame = epipolar_frame(&camera, &light);
    const EpipolarRange range = epipolar_range_full(32, 24, 128);
    vec4 points[POINTS];
    int needed;
    points_of(&frame, points);
    float *borders = epipolar_theta_borders(&frame, &range, &camera, 64, 48, &needed);
    Results *got = convert(&frame, &range, points, POINTS, "WARP 1\nTHETA_TABLE 1", borders);
    for (int i = 0; i < POINTS; i++)
        for (int k = 0; k < 3; k++)
            cr_assert(fabsf(got[i].again[k] - got[i].epipolar[k]) < 1e-4f, "axis %d: %g for %g", k,
                      (double)got[i].again[k], (double)got[i].epipolar[k]);
    free(borders);
    free(got);
    gl_close();
}
