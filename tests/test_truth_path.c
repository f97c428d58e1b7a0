// The truth's light against closed forms: furnaces, lights, plates that face each other, the reflective shadow map's model of a bounce.
#include "failure.h"
#include "truth_scenes.h"

// Every mean is tested against 3 of its own standard errors with fixed seeds: a right estimator fails one such test in 370 for one seed,
// never for the seeds that stand here, unless the compiler's rounding sends a path elsewhere.

static TruthPicture picture_of(const Truth *truth, const Scene *scene, int size, TruthPathSettings settings)
{
    return truth_radiance(truth, scene, &scene->camera, size, size, &settings);
}

// Σ ρ^i, i ≤ n + 1: what the walls emit, and what of it they have reflected at most n + 1 times.
static double furnace_radiance(double emission, double albedo, int bounces)
{
    double sum = 0.0;
    for (int i = bounces + 1; i >= 0; i--)
        sum = emission + albedo * sum;
    return sum;
}

// By direction every path meets an emitter at every bounce and all are alike: no noise at all, so the closed form holds to rounding.
Test(truth_path, furnace_by_direction_is_exact)
{
    const vec3 emission = vec3_make(1, 0.5f, 2), albedo = vec3_make(0.2f, 0.5f, 0.9f);
    Scene *scene = furnace(emission, albedo);
    Truth *truth = scene_ready(scene);
    const int bounces[] = {0, 1, 2, 5, 12};
    for (size_t i = 0; i < sizeof bounces / sizeof *bounces; i++) {
        TruthPicture picture =
            picture_of(truth, scene, 6,
                       (TruthPathSettings){
                           .samples = 4, .bounces = bounces[i], .emitters = TRUTH_EMITTERS_BY_DIRECTION});
        for (size_t p = 0; p < 36; p++)
            for (int k = 0; k < 3; k++) {
                double expected = furnace_radiance((double)emission[k], (double)albedo[k], bounces[i]),
                       got = (double)channel_of(&picture.mean, p, k);
                // 3·10⁻⁶: a float32 rounding or two at each of 14 surfaces
                cr_assert(fabs(got - expected) < 3e-6 * expected, "%d bounces, channel %d: %.8g, not %.8g",
                          bounces[i], k, got, expected);
                cr_assert(channel_of(&picture.error, p, k) < 1e-6f * (float)expected,
                          "an error where there is none");
            }
        truth_picture_free(&picture);
    }
    scene_end(scene, truth);
}

// The same walls found by area, and by both with the balance heuristic; and all bounces: L_e / (1 − ρ).
Test(truth_path, furnace_by_every_estimator)
{
    const vec3 emission = vec3_make(1, 0.5f, 2), albedo = vec3_make(0.2f, 0.5f, 0.9f);
    Scene *scene = furnace(emission, albedo);
    Truth *truth = scene_ready(scene);
    const TruthPathSettings cases[] = {
        {.samples = 512, .bounces = 0, .emitters = TRUTH_EMITTERS_BOTH, .seed = 1},
        {.samples = 512, .bounces = 2, .emitters = TRUTH_EMITTERS_BOTH, .seed = 2},
        {.samples = 512, .bounces = 2, .emitters = TRUTH_EMITTERS_BY_AREA, .seed = 3},
        {.samples = 4096, .bounces = TRUTH_FULL, .emitters = TRUTH_EMITTERS_BOTH, .seed = 4},
        {.samples = 512, .bounces = TRUTH_FULL, .emitters = TRUTH_EMITTERS_BY_DIRECTION, .seed = 5},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        TruthPicture picture = picture_of(truth, scene, 5, cases[i]);
        for (int k = 0; k < 3; k++) {
            double mean, error, expected = (double)emission[k] / (1.0 - (double)albedo[k]);
            if (cases[i].bounces != TRUTH_FULL)
                expected = furnace_radiance((double)emission[k], (double)albedo[k], cases[i].bounces);
            mean_of(&picture, k, &mean, &error);
            // 2 %: with an error that were larger a missing bounce would pass. By area corners are noisy.
            cr_assert(error > 0.0 && error < 0.02 * expected, "case %zu: error %g of %g", i, error, expected);
            cr_assert(fabs(mean - expected) < 3.0 * error, "case %zu, channel %d: %g, not %g: %.2f errors", i,
                      k, mean, expected, (mean - expected) / error);
        }
        truth_picture_free(&picture);
    }
    scene_end(scene, truth);
}

// --- lights in free space: no noise, so to rounding (10⁻⁶ of float32 coordinates, squared)

static double irradiance_of(const Light *light, vec3 point, vec3 normal)
{
    Scene *scene = scene_begin();
    scene_add_light(scene, *light);
    Truth *truth = scene_ready(scene);
    TruthIrradiance got =
        truth_irradiance(truth, scene, point, normal, &(TruthPathSettings){.samples = 2, .bounces = 3});
    cr_assert(got.error[0] == 0.0, "one light in free space has no noise");
    scene_end(scene, truth);
    return got.mean[0];
}

Test(truth_path, point_light)
{
    const vec3 normal = vec3_make(0, 1, 0);
    for (int scale = -20; scale <= 20; scale += 10)
        for (int i = 0; i < 40; i++) {
            float size = ldexpf(1.0f, scale), x = 0.2f * (float)i - 3.0f, y = 0.15f * (float)i - 0.5f;
            Light light = {.kind = LIGHT_POINT,
                           .position = size * vec3_make(x, y, 0.5f),
                           .intensity = vec3_make(7, 7, 7) * size * size,
                           .radius = 2.0f * size};
            double d = hypot(hypot((double)x, (double)y), 0.5), held = fmax(d, 2.0);
            double expected = fmax(0.0, 7.0 * (double)y / d / (held * held));
            double got = irradiance_of(&light, BLACK, normal);
            cr_assert(fabs(got - expected) < 3e-6 * expected + 1e-12, "2^%d m, %g m away: %.8g, not %.8g",
                      scale, d, got, expected);
        }
}

// Uniform in the cone, nothing outside; both sides of the border by a part in 2000 of the angle.
Test(truth_path, spot_light_ends_at_its_cone)
{
    const float halves[] = {1e-3f, 0.3f, 1.2f, 1.57f, 2.5f};
    for (size_t i = 0; i < sizeof halves / sizeof *halves; i++)
        for (int side = -1; side <= 1; side += 2)
            for (int around = 0; around < 8; around++) {
                double angle = (double)halves[i] * (1.0 + 0.0005 * side), turn = 0.8 * around;
                vec3 way = vec3_make((float)(sin(angle) * cos(turn)), (float)cos(angle),
                                     (float)(sin(angle) * sin(turn)));
                Light light = {.kind = LIGHT_SPOT,
                               .position = BLACK,
                               .direction = vec3_make(0, 1, 0),
                               .intensity = vec3_make(5, 5, 5),
                               .half_angle_rad = halves[i]};
                double got = irradiance_of(&light, 2.0f * way, -way), expected = side < 0 ? 5.0 / 4.0 : 0.0;
                cr_assert(fabs(got - expected) < 3e-6, "half angle %g, %+d: %g, not %g", (double)halves[i],
                          side, got, expected);
            }
}

Test(truth_path, directional_light)
{
    for (int i = -6; i <= 6; i++) {
        double angle = 0.5 * i;
        Light light = {.kind = LIGHT_DIRECTIONAL,
                       .direction = vec3_make((float)sin(angle), (float)-cos(angle), 0),
                       .intensity = vec3_make(3, 3, 3)};
        double got = irradiance_of(&light, vec3_make(100, 5, -3), vec3_make(0, 1, 0));
        cr_assert(fabs(got - fmax(0.0, 3.0 * cos(angle))) < 1e-6, "at %g rad: %g", angle, got);
    }
}

// A plane seen through a picture: albedo/π · E · cos with the vertices' normal, on the side that is seen, and no acne at 89.99°.
Test(truth_path, plane_under_grazing_light_has_no_acne)
{
    for (int i = 0; i < 12; i++) {
        const double from_plane = i % 3 == 0 ? 1.745e-4 : i % 3 == 1 ? 0.1 : 1.2, tilt = 0.37 * i + 0.1;
        const float shift = i >= 6 ? 0x1p18f : 0.0f; // where coordinates are good to 2 cm
        const vec3 x = vec3_make((float)cos(tilt), (float)sin(tilt), 0), z = vec3_make(0.6f, 0, 0.8f);
        const vec3 y = vec3_normalize(vec3_cross(z, x)), u = 8.0f * x,
                   v = 8.0f * vec3_normalize(vec3_cross(x, y));
        Scene *scene = scene_begin();
        uint32_t grey = scene_add_material(scene, "grey", vec3_make(0.5f, 0.25f, 0.75f), BLACK);
        const vec3 middle = vec3_make(shift, shift, -shift);
        mesh_add_quad(&scene->mesh, middle - 0.5f * (u + v), u, v, grey);
        // of the quad as it was rounded
        float p[9];
        memcpy(p, scene->mesh.positions, sizeof p);
        const vec3 a = vec3_make(p[3] - p[0], p[4] - p[1], p[5] - p[2]),
                   b = vec3_make(p[6] - p[0], p[7] - p[1], p[8] - p[2]);
        const vec3 normal = vec3_normalize(vec3_cross(a, b)), along = vec3_normalize(a);
        const vec3 to_light =
            vec3_normalize((float)sin(from_plane) * normal + (float)cos(from_plane) * along);
        scene_add_light(
            scene,
            (Light){.kind = LIGHT_DIRECTIONAL, .direction = -to_light, .intensity = vec3_make(2, 2, 2)});
        scene_add_light(scene, (Light){.kind = LIGHT_POINT,
                                       .position = middle - 5.0f * normal, // behind
                                       .intensity = vec3_make(2, 2, 2)});
        scene->camera = (Camera){.eye = middle + 3.0f * normal + 1.0f * along,
                                 .target = middle,
                                 .up = along,
                                 .vertical_fov_rad = 0.6f};
        Truth *truth = scene_ready(scene);
        TruthPicture picture = picture_of(truth, scene, 24, (TruthPathSettings){.samples = 1, .bounces = 0});
        for (size_t pixel = 0; pixel < 24 * 24; pixel++) {
            double expected = 0.25 / M_PI * 2.0 * sin(from_plane),
                   got = (double)channel_of(&picture.mean, pixel, 1);
            // 1 %: two float32 unit vectors, 6·10⁻⁸, against a cosine of 1.7·10⁻⁴ at least; far away the quad's two triangles, whose
            // corners are rounded apart by up to 2⁻⁶ m, tilt against each other: only that they are lit
            double tolerance = shift > 0.0f ? 0.02 : 0.01 * expected;
            cr_assert(fabs(got - expected) < tolerance, "case %d, pixel %zu: %g, not %g", i, pixel, got,
                      expected);
        }
        truth_picture_free(&picture);
        scene_end(scene, truth);
    }
}

// A triangle of 130 km whose middle is near the origin: rays miss its plane by centimetres there, however well the point is known.
Test(truth_path, giant_triangle_does_not_shade_itself)
{
    for (int i = 0; i < 20; i++) {
        const float size = 0x1p17f, turn = 0.3f * (float)i + 0.1f;
        const vec3 x = vec3_normalize(vec3_make(cosf(turn), sinf(turn), 0.5f * cosf(3.0f * turn))),
                   z = vec3_normalize(vec3_cross(x, vec3_make(0.3f, 0.2f, 1))), normal = vec3_cross(z, x);
        Scene *scene = scene_begin();
        uint32_t grey = scene_add_material(scene, "grey", vec3_make(0.5f, 0.5f, 0.5f), BLACK);
        const vec3 corners[3] = {-size * (x + z), size * x * 1.5f, size * z * 1.5f};
        for (int v = 0; v < 3; v++)
            mesh_add_vertex(&scene->mesh, corners[v], BLACK);
        mesh_add_triangle(&scene->mesh, 0, 1, 2, grey);
        scene_add_light(scene, (Light){.kind = LIGHT_DIRECTIONAL,
                                       .direction = vec3_normalize(-0.3f * normal - x),
                                       .intensity = vec3_make(1, 1, 1)});
        scene->camera = (Camera){.eye = 2.0f * normal, .target = 0.5f * x, .up = x, .vertical_fov_rad = 0.6f};
        Truth *truth = scene_ready(scene);
        TruthPicture picture = picture_of(truth, scene, 16, (TruthPathSettings){.samples = 1});
        const double expected = 0.5 / M_PI * 0.3 / sqrt(1.09);
        for (size_t p = 0; p < 256; p++) // 10⁻⁴: the corners are rounded by 4 mm in 130 km
            cr_assert_float_eq((double)channel_of(&picture.mean, p, 0), expected, 1e-4 * expected,
                               "case %d, pixel %zu: %g, not %g", i, p,
                               (double)channel_of(&picture.mean, p, 0), expected);
        truth_picture_free(&picture);
        scene_end(scene, truth);
    }
}

// Vertices' normals that are not the triangle's shade it, and turn with it where its back is seen.
Test(truth_path, interpolated_normals_on_the_side_that_is_seen)
{
    for (int back = 0; back < 2; back++) {
        Scene *scene = scene_begin();
        uint32_t grey = scene_add_material(scene, "grey", vec3_make(1, 1, 1), BLACK);
        const vec3 tilted = vec3_normalize(vec3_make(1, 0, 2));
        for (int i = 0; i < 3; i++)
            mesh_add_vertex(&scene->mesh, vec3_make(i == 1 ? 9.0f : -3.0f, i == 2 ? 9.0f : -3.0f, 0), tilted);
        mesh_add_triangle(&scene->mesh, 0, 1, 2, grey);
        const float z = back ? -1.0f : 1.0f;
        for (int side = -1; side <= 1; side += 2) // one before the side that is seen, one behind it
            scene_add_light(scene, (Light){.kind = LIGHT_DIRECTIONAL,
                                           .direction = vec3_make(0, 0, side > 0 ? -z : z),
                                           .intensity = side > 0 ? vec3_make(1, 0, 0) : vec3_make(0, 1, 0)});
        scene->camera =
            (Camera){.eye = vec3_make(0, 0, 2 * z), .up = vec3_make(0, 1, 0), .vertical_fov_rad = 0.5f};
        Truth *truth = scene_ready(scene);
        TruthPicture picture = picture_of(truth, scene, 2, (TruthPathSettings){.samples = 1});
        for (size_t p = 0; p < 4; p++) {
            cr_assert_float_eq((double)channel_of(&picture.mean, p, 0), 2.0 / sqrt(5.0) / M_PI, 1e-6);
            cr_assert_float_eq((double)channel_of(&picture.mean, p, 1), 0.0, 0.0);
        }
        scene->camera.near_distance = 2.01f; // beyond the triangle: nothing is seen
        TruthPicture nothing = picture_of(truth, scene, 2, (TruthPathSettings){.samples = 1});
        cr_assert_float_eq((double)channel_of(&nothing.mean, 0, 0), 0.0, 0.0);
        truth_picture_free(&nothing);
        truth_picture_free(&picture);
        scene_end(scene, truth);
    }
}

// --- a plate that emits over a surface

typedef struct Plate {
    vec3 corners[4];
    Scene *scene;
    Truth *truth;
} Plate;

static Plate plate_at(float height, float half_x, float half_z, vec3 albedo, vec3 emission)
{
    Plate plate = {.scene = scene_begin()};
    uint32_t material = scene_add_material(plate.scene, "plate", albedo, emission);
    const vec3 corner = vec3_make(-half_x, height, -half_z), x = vec3_make(2 * half_x, 0, 0),
               z = vec3_make(0, 0, 2 * half_z);
    mesh_add_quad(&plate.scene->mesh, corner, x, z, material);
    const vec3 corners[4] = {corner, corner + x, corner + x + z, corner + z};
    memcpy(plate.corners, corners, sizeof corners);
    return plate;
}

// At each point, on both sides of the plate, by each estimator: 3 errors; all of them together: z² is 1 on the mean, so that errors are
// neither too small nor too large. Its standard deviation is √(2/400) = 0.07 where samples are many enough to be normal.
Test(truth_path, emitting_plate_and_its_error)
{
    Plate plate = plate_at(1.5f, 0.75f, 0.5f, BLACK, vec3_make(2, 1, 0));
    plate.truth = scene_ready(plate.scene);
    for (int estimator = 0; estimator < 3; estimator++) {
        double squares = 0.0;
        int within = 0;
        enum { COUNT = 400 };
        for (int i = 0; i < COUNT; i++) {
            const int row = i / 20;
            const vec3 point =
                           vec3_make(0.1f * (float)(i % 20) - 1.0f, i % 2 ? 0.0f : 2.5f, 0.05f * (float)row),
                       normal = vec3_make(0, i % 2 ? 1.0f : -1.0f, 0);
            const TruthPathSettings settings = {
                .samples = 1024, .emitters = (TruthEmitters)estimator, .seed = (uint64_t)i};
            TruthIrradiance got = truth_irradiance(plate.truth, plate.scene, point, normal, &settings);
            double expected = polygon_irradiance(plate.corners, 4, point, normal),
                   z = (got.mean[1] - expected) / got.error[1];
            cr_assert(got.error[1] > 0.0 && got.error[1] < 0.15 * expected, "point %d: error %g", i,
                      got.error[1]);
            cr_assert_float_eq(got.mean[0], 2.0 * got.mean[1], 1e-6 * got.mean[0]);
            cr_assert_float_eq(got.mean[2], 0.0, 0.0);
            within += fabs(z) <= 3.0;
            squares += z * z;
        }
        cr_assert(within >= 396, "estimator %d: only %d of %d points within 3 errors", estimator, within,
                  COUNT);
        cr_assert(squares / COUNT > 0.75 && squares / COUNT < 1.25, "estimator %d: z² is %g on the mean",
                  estimator, squares / COUNT);
    }
    scene_end(plate.scene, plate.truth);
}

// Howell's catalogue, C-11: share of what one of two equal, parallel, directly opposed rectangles sends that arrives at the other.
static double opposed_rectangles(double width, double depth, double apart)
{
    double x = width / apart, y = depth / apart, xx = sqrt(1 + x * x), yy = sqrt(1 + y * y);
    return 2.0 / (M_PI * x * y) *
           (log(xx * yy / sqrt(1 + x * x + y * y)) + x * yy * atan(x / yy) + y * xx * atan(y / xx) -
            x * atan(x) - y * atan(y));
}

Test(truth_path, form_factor_of_two_plates)
{
    const double apart[] = {0.05, 0.5, 2.0, 20.0};
    for (size_t i = 0; i < 4; i++) {
        Plate plate = plate_at((float)apart[i], 1.0f, 0.75f, BLACK, vec3_make(1, 1, 1));
        plate.truth = scene_ready(plate.scene);
        enum { SIDE = 40 };
        double sum = 0.0, squares = 0.0;
        for (int p = 0; p < SIDE * SIDE; p++) {
            // one random point a cell of the receiving plate, by the hash of its number: cells make the mean's error smaller than
            // independent points would, so that the 3 errors below are generous
            const int row = p / SIDE;
            uint64_t bits = hash_bytes(HASH_START, &p, sizeof p);
            double u = (p % SIDE + (double)(bits >> 8 & 0xffff) / 65536.0) / SIDE,
                   v = (row + (double)(bits >> 32 & 0xffff) / 65536.0) / SIDE;
            const vec3 point = vec3_make((float)(2.0 * u - 1.0), 0, (float)(1.5 * v - 0.75));
            TruthIrradiance got = truth_irradiance(plate.truth, plate.scene, point, vec3_make(0, 1, 0),
                                                   &(TruthPathSettings){.samples = 32, .seed = (uint64_t)p});
            sum += got.mean[0] / M_PI;
            squares += pow(got.mean[0] / M_PI, 2.0);
        }
        double count = SIDE * SIDE, mean = sum / count, error = sqrt((squares / count - mean * mean) / count),
               expected = opposed_rectangles(2.0, 1.5, apart[i]);
        cr_assert(error < 0.02 * expected, "%g m: error %g of %g", apart[i], error, expected);
        cr_assert(fabs(mean - expected) < 3.0 * error, "%g m apart: %g, not %g ± %g", apart[i], mean,
                  expected, error);
        scene_end(plate.scene, plate.truth);
    }
}
