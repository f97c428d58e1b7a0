// linear: matrices and cameras against points worked out by hand, and where scales are extreme.
#include "linear.h"

#include <criterion/criterion.h>

// Rounding a double result to float once, of numbers near 1; a few ulp for the test's own float arithmetic.
static const float ULPS = 1e-6f;
static const float PI = 3.14159265f;

static void expect_near(vec3 got, vec3 expected, float tolerance, const char *what)
{
    cr_assert(vec3_is_finite(got) && vec3_length(got - expected) <= tolerance,
              "%s: (%g %g %g), expected (%g %g %g)", what, (double)got[0], (double)got[1], (double)got[2],
              (double)expected[0], (double)expected[1], (double)expected[2]);
}

static Camera camera_at(vec3 eye, vec3 target)
{
    return (Camera){.eye = eye,
                    .target = target,
                    .up = vec3_make(0, 1, 0),
                    .vertical_fov_rad = PI / 2,
                    .near_distance = 1,
                    .far_distance = 3};
}

Test(linear, normalize_is_safe_at_every_scale)
{
    const float scales[] = {1e-45f, 1e-30f, 1e-6f, 1, 1e6f, 1e30f, 3e38f};
    for (size_t i = 0; i < sizeof scales / sizeof *scales; i++)
        expect_near(vec3_normalize(vec3_make(0, -scales[i], 0)), vec3_make(0, -1, 0), ULPS, "an axis");
    expect_near(vec3_normalize(vec3_make(3e30f, 0, 4e30f)), vec3_make(0.6f, 0, 0.8f), ULPS, "3-4-5");
    cr_assert_eq(vec3_length(vec3_normalize(vec3_make(0, 0, 0))), 0, "zero stays zero");
    cr_assert(vec3_is_finite(vec3_make(1, 2, 3)) && !vec3_is_finite(vec3_make(1, NAN, 3)),
              "NaN is not finite");
    cr_assert(!vec3_is_finite(vec3_make(1, 2, -INFINITY)), "Inf is not finite");
}

Test(linear, smallest_and_largest_are_a_component_each)
{
    vec3 a = vec3_make(1, -2, 3), b = vec3_make(-1, 2, 3.5f);
    expect_near(vec3_min(a, b), vec3_make(-1, -2, 3), 0, "min");
    expect_near(vec3_max(a, b), vec3_make(1, 2, 3.5f), 0, "max");
}

Test(linear, perspective_puts_the_frustum_on_the_clip_cube)
{
    mat4 m = camera_projection(camera_at(vec3_make(0, 0, 0), vec3_make(0, 0, -1)),
                               2); // 90° high, twice as wide, 1 to 3
    expect_near(mat4_transform_point(m, vec3_make(0, 0, -1)), vec3_make(0, 0, -1), ULPS, "near plane");
    expect_near(mat4_transform_point(m, vec3_make(0, 0, -3)), vec3_make(0, 0, 1), ULPS, "far plane");
    expect_near(mat4_transform_point(m, vec3_make(2, 1, -1)), vec3_make(1, 1, -1), ULPS, "near corner");
    expect_near(mat4_transform_point(m, vec3_make(-6, -3, -3)), vec3_make(-1, -1, 1), ULPS, "far corner");
    vec4 clip = mat4_transform(m, (vec4){0, 0, -2, 1});
    cr_assert_float_eq(clip[3], 2, ULPS, "w is the distance along the view");
}

Test(linear, orthographic_puts_the_box_on_the_clip_cube)
{
    mat4 m = mat4_orthographic(-2, 4, -1, 1, 10, 30);
    expect_near(mat4_transform_point(m, vec3_make(-2, -1, -10)), vec3_make(-1, -1, -1), ULPS, "near corner");
    expect_near(mat4_transform_point(m, vec3_make(4, 1, -30)), vec3_make(1, 1, 1), ULPS, "far corner");
}

Test(linear, product_applies_the_right_factor_first)
{
    mat4 turn =
        mat4_look_at(vec3_make(0, 0, 0), vec3_make(1, 0, 0), vec3_make(0, 1, 0)); // world x becomes -z
    mat4 view =
        mat4_look_at(vec3_make(0, 0, 5), vec3_make(0, 0, 0), vec3_make(0, 1, 0)); // world moves by -5 z
    expect_near(mat4_transform_point(mat4_multiply(view, turn), vec3_make(1, 0, 0)), vec3_make(0, 0, -6),
                ULPS, "turned, then moved");
    expect_near(mat4_transform_point(mat4_multiply(turn, view), vec3_make(1, 0, 0)), vec3_make(-5, 0, -1),
                5 * ULPS, "moved, then turned");
}

Test(linear, view_looks_down_minus_z_with_any_up)
{
    const vec3 ups[] = {vec3_make(0, 1, 0), vec3_make(0, 0, 1),       vec3_make(1, 0, 0),
                        vec3_make(0, 0, 0), vec3_make(0, 0, -1e-20f), vec3_make(1e-9f, 0, 1)};
    vec3 eye = vec3_make(1, 2, 3),
         target = vec3_make(1, 2, -7); // parallel to the second, fifth and (nearly) the last
    for (size_t i = 0; i < sizeof ups / sizeof *ups; i++) {
        mat4 view = mat4_look_at(eye, target, ups[i]);
        expect_near(mat4_transform_point(view, eye), vec3_make(0, 0, 0), 5 * ULPS, "the eye is the origin");
        expect_near(mat4_transform_point(view, target), vec3_make(0, 0, -10), 10 * ULPS,
                    "the target is ahead");
        for (int a = 0; a < 3; a++)
            for (int b = 0; b < 3; b++)
                cr_assert_float_eq(vec3_dot(view.column[a], view.column[b]), a == b, ULPS,
                                   "up %zu: axes %d %d", i, a, b);
        cr_assert_float_eq(vec3_dot(vec3_cross(view.column[0], view.column[1]), view.column[2]), 1, ULPS,
                           "up %zu: right-handed", i);
    }
    cr_assert(vec3_is_finite(mat4_look_at(eye, eye, ups[0]).column[3]), "eye = target still gives a view");
}

Test(linear, inverse_undoes_at_extreme_scales)
{
    const float scales[] = {1e-6f, 1, 1e6f};
    for (size_t i = 0; i < 3; i++) {
        float s = scales[i];
        mat4 box = mat4_orthographic(-s, s, -2 * s, s, s, 3 * s);
        vec3 point = s * vec3_make(0.3f, -0.7f, -1.9f);
        // the box's map to the clip cube and back: errors are a few ulp of the box's size
        expect_near(mat4_transform_point(mat4_inverse(box), mat4_transform_point(box, point)), point,
                    4 * ULPS * s, "box");
        mat4 view = camera_view(camera_at(s * vec3_make(1, 2, 3), s * vec3_make(-1, 0, 0.5f)));
        expect_near(mat4_transform_point(mat4_inverse(view), mat4_transform_point(view, point)), point,
                    8 * ULPS * s, "view");
    }
    mat4 deep = mat4_perspective(1, 1.5f, 1e-3f, 1e6f);
    // depth in [-1, 1] has 2⁻²⁴ / near = 6e-5 of 1/distance left in float: points well before 10⁴ m come back
    expect_near(
        mat4_transform_point(mat4_inverse(deep), mat4_transform_point(deep, vec3_make(0.01f, 0.02f, -0.1f))),
        vec3_make(0.01f, 0.02f, -0.1f), 1e-5f, "near 10⁻³, far 10⁶");
    cr_assert_float_eq(mat4_transform_point(deep, vec3_make(0, 0, -1e-3f))[2], -1, ULPS,
                       "near plane of a deep view");
    cr_assert_float_eq(mat4_transform_point(deep, vec3_make(0, 0, -1e6f))[2], 1, ULPS,
                       "far plane of a deep view");
    mat4 flat = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 1}}};
    cr_assert(!isfinite(mat4_inverse(flat).column[2][2]), "a singular matrix has no finite inverse");
}

Test(linear, quaternion_turns_by_the_right_hand_rule)
{
    quat quarter = quat_rotation(PI / 2, vec3_make(0, 0, 1));
    expect_near(quat_rotate(quarter, vec3_make(1, 0, 5)), vec3_make(0, 1, 5), 5 * ULPS,
                "x becomes y about z");
}

Test(linear, orbit_turns_raises_and_zooms)
{
    Camera camera = camera_at(vec3_make(1, 2, 8), vec3_make(1, 2, 3)), moved; // 5 m before the target
    moved = camera_orbit(camera, PI / 2, 0, 1);
    expect_near(moved.eye, vec3_make(6, 2, 3), 10 * ULPS, "a quarter turn about y takes +z to +x");
    moved = camera_orbit(camera, 0, PI / 6, 2);
    expect_near(moved.eye, vec3_make(1, 7, 3 + 10 * cosf(PI / 6)), 10 * ULPS, "30° up, twice as far");
    moved = camera;
    for (int degree = 0; degree < 360; degree++)
        moved = camera_orbit(moved, PI / 180, 0, 1);
    // each step rounds the eye to half an ulp of 8 (5e-7): at worst 360 of them add up
    expect_near(moved.eye, camera.eye, 2e-4f, "a full turn");
    cr_assert_float_eq(vec3_length(moved.eye - moved.target), 5, 2e-4f, "and its distance");
}

Test(linear, orbit_stops_short_of_the_poles)
{
    for (int side = -1; side <= 1; side += 2) {
        Camera camera = camera_at(vec3_make(0, 0, 5), vec3_make(0, 0, 0));
        for (int i = 0; i < 40; i++)
            camera = camera_orbit(camera, 0.1f, (float)side * 0.3f, 1);
        float height = (float)side * camera.eye[1], aside = hypotf(camera.eye[0], camera.eye[2]);
        cr_assert_float_eq(atan2f(aside, height), 0.01f, 1e-5f, "0.01 rad from the pole, %g",
                           (double)atan2f(aside, height));
        camera = camera_orbit(camera, 0, (float)-side * PI / 2, 1);
        // 90° from 0.01 rad before the pole ends 0.01 rad above the horizon
        cr_assert_float_eq((float)side * camera.eye[1], -5 * sinf(0.01f), 1e-4f, "and comes back down");
    }
    Camera overhead = camera_at(vec3_make(0, 5, 0), vec3_make(0, 0, 0));
    overhead = camera_orbit(overhead, 0.5f, -PI / 4, 1);
    cr_assert_float_eq(overhead.eye[1], 5 * sqrtf(0.5f), 1e-5f,
                       "one that starts on the pole can leave it: 45° down");
}

Test(linear, orbit_holds_at_extreme_scales)
{
    const float scales[] = {1e-6f, 1e6f};
    for (size_t i = 0; i < 2; i++) {
        Camera camera = camera_at(vec3_make(0, 0, scales[i]), vec3_make(0, 0, 0));
        camera = camera_orbit(camera, PI, 0, 1);
        expect_near(camera.eye, vec3_make(0, 0, -scales[i]), ULPS * scales[i], "half a turn");
    }
    Camera on_target = camera_at(vec3_make(1, 1, 1), vec3_make(1, 1, 1));
    expect_near(camera_orbit(on_target, 1, 1, 2).eye, on_target.eye, 0, "on the target: left out");
    Camera far_target = camera_at(vec3_make(0, 0, 1e6f + 1), vec3_make(0, 0, 1e6f));
    expect_near(camera_orbit(far_target, 0, 0, 1e-6f).eye, far_target.eye, 0,
                "a zoom below the target's ulp: left out");
    expect_near(camera_orbit(far_target, 0, 0, INFINITY).eye, far_target.eye, 0,
                "a zoom to infinity: left out");
}
