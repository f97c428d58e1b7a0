// 02 shadow maps: closed forms of what a map of distances answers: borders, acne, detached shadows, filters, paraboloids.
#include "shadow_bench.h"

static uint32_t stone(Scene *scene)
{
    return scene_add_material(scene, "stone", vec3_make(0.5f, 0.5f, 0.5f), vec3_make(0, 0, 0));
}
static void add_floor(Scene *scene, float half, float height, uint32_t material)
{
    mesh_add_quad(&scene->mesh, vec3_make(-half, height, -half), vec3_make(0, 0, 2 * half),
                  vec3_make(2 * half, 0, 0), material);
}
// Straight down on the floor from 10 m; the x axis to the right.
static void look_down(Scene *scene, float fov_rad)
{
    scene->camera = (Camera){vec3_make(0, 10, 0), vec3_make(0, 0, 0), vec3_make(0, 0, -1), fov_rad, 0, 0};
}

// A plate of 2 m 2 m above a floor, its light (spot or lamp) 4 m above it: a shadow of 4 m. The plate itself hides 2.5 m of the floor.
static void make_plate(Scene *scene, uint64_t kind)
{
    const uint32_t material = stone(scene);
    add_floor(scene, 8, 0, material);
    add_floor(scene, 1, 2, material);
    scene_add_light(scene, (Light){.kind = (LightKind)kind,
                                   .position = vec3_make(0, 4, 0),
                                   .direction = vec3_make(0, -1, 0),
                                   .intensity = vec3_make(1, 1, 1),
                                   .half_angle_rad = 0.9f});
    look_down(scene, 0.8f);
}

static void check_plate(LightKind kind, bool paraboloid, MapBias bias)
{
    ShadowBench bench = shadow_bench(make_plate, kind);
    ShadowMap map = map_create(bench.scene, &bench.scene->lights[0], paraboloid, false, 2048, NULL, 1);
    const MapLookup lookup = {.bias = bias, .bias_size = 1, .radius = 1};
    float *got = shadow_ask(&bench, &map, &lookup, 0.25f);
    static double p[SIDE * SIDE][3];
    shadow_points(&bench, p);
    // Two texels at the border: 4.5 m from the light, and a paraboloid's are largest: 4 / 1448 radians.
    const double texel = 2 * 4.5 * 4.0 / 1448;
    int lit = 0, dark = 0;
    for (int i = 0; i < SIDE * SIDE; i++) {
        const double inside = kind == LIGHT_DIRECTIONAL ? 1 : 2,
                     edge = fmax(fabs(p[i][0]), fabs(p[i][2])) - inside;
        if (got[i] < 0 || fabs(edge) < texel || p[i][1] > 1)
            continue;
        lit += got[i] == 1;
        dark += got[i] == 0;
        cr_assert_eq(got[i], edge > 0 ? 1 : 0, "light %d, %g m from the border at %g, %g: %g", kind, edge,
                     p[i][0], p[i][2], (double)got[i]);
    }
    cr_assert(lit > 1000 && (dark > 1000 || kind == LIGHT_DIRECTIONAL), "%d lit, %d dark", lit, dark);
    free(got);
    map_delete(&map);
}
Test(shadow, plate_under_a_spot)
{
    check_plate(LIGHT_SPOT, false, BIAS_SLOPE);
}
Test(shadow, plate_under_a_spot_by_normal_offset)
{
    check_plate(LIGHT_SPOT, false, BIAS_NORMAL);
}
Test(shadow, plate_under_a_sun)
{
    check_plate(LIGHT_DIRECTIONAL, false, BIAS_SLOPE);
}
Test(shadow, plate_under_a_lamp_by_cube)
{
    check_plate(LIGHT_POINT, false, BIAS_SLOPE);
}
Test(shadow, plate_under_a_lamp_by_paraboloid)
{
    check_plate(LIGHT_POINT, true, BIAS_SLOPE);
}

// A floor alone under a sun that leans along x by `seed` degrees.
static void make_floor(Scene *scene, uint64_t seed)
{
    add_floor(scene, 6, 0, stone(scene));
    const float lean = (float)seed * 3.14159265f / 180;
    scene_add_light(scene, (Light){.kind = LIGHT_DIRECTIONAL,
                                   .direction = vec3_make(sinf(lean), -cosf(lean), 0),
                                   .intensity = vec3_make(1, 1, 1)});
    look_down(scene, 0.8f);
}

// Across a texel the floor's distance changes by texel · tan θ; a texel stores its middle's. So half of each texel is dark without bias, and with
// a bias b the part of it where s · texel · tan θ > b for s in [-½, ½].
Test(shadow, acne_is_what_slope_and_texel_say)
{
    const double share_of[] = {0, 0.1, 0.25, 0.4, 0.6};
    ShadowBench bench = shadow_bench(make_floor, 50);
    ShadowMap map = map_create(bench.scene, &bench.scene->lights[0], false, false, 64, NULL, 1);
    // The map is not square: it covers 12 m across and 12 cos 50° m along the lean, where its texels are this large. A margin of a texel a side.
    const double along = 2.0 /
                         sqrt((double)(map.depth.to_clip.column[0][1] * map.depth.to_clip.column[0][1] +
                                       map.depth.to_clip.column[1][1] * map.depth.to_clip.column[1][1])) /
                         64;
    const double slope = tan(50 * M_PI / 180);
    for (int k = 0; k < 5; k++) {
        const MapLookup lookup = {
            .bias = BIAS_CONSTANT, .bias_size = (float)(share_of[k] * along * slope), .radius = 1};
        float *got = shadow_ask(&bench, &map, &lookup, 0);
        double dark = 0, asked = 0;
        for (int i = 0; i < SIDE * SIDE; i++) {
            asked += got[i] >= 0;
            dark += got[i] == 0;
        }
        // 128 rows of pixels over 45 rows of texels: one row of pixels in each texel may fall on either side, on average half of that
        cr_assert(fabs(dark / asked - fmax(0, 0.5 - share_of[k])) < 0.03,
                  "bias of %g texels: %g of the floor is dark", share_of[k], dark / asked);
        free(got);
    }
    map_delete(&map);
}

static double dark_of(float *visibility)
{
    double dark = 0;
    for (int i = 0; i < SIDE * SIDE; i++)
        dark += visibility[i] >= 0 && visibility[i] < 0.5f;
    free(visibility);
    return dark;
}

// What is meant to cure it does, at slopes up to 85°, with and without a filter.
Test(shadow, slope_and_normal_bias_leave_no_acne)
{
    for (int lean = 0; lean <= 80; lean += 40) {
        ShadowBench bench = shadow_bench(make_floor, (uint64_t)lean);
        ShadowMap map = map_create(bench.scene, &bench.scene->lights[0], false, false, 64, NULL, 1);
        for (int k = 0; k < 4; k++) {
            const MapLookup lookup = {.bias = k % 2 ? BIAS_NORMAL : BIAS_SLOPE,
                                      .bias_size = 1,
                                      .filter = k / 2 ? FILTER_PCF : FILTER_NEAREST,
                                      .radius = 1.5f};
            cr_assert_eq(dark_of(shadow_ask(&bench, &map, &lookup, 0)), 0, "lean %d, way %d", lean, k);
        }
        map_delete(&map);
        gl_close();
    }
}

// A ramp rises from the floor at x = 0 with slope 1/2; the sun is straight above. Under it the floor is dark where the ramp is more than the
// bias above it: the shadow comes loose by 2 · bias.
static void make_ramp(Scene *scene, uint64_t seed)
{
    (void)seed;
    const uint32_t material = stone(scene);
    add_floor(scene, 6, 0, material);
    mesh_add_quad(&scene->mesh, vec3_make(0, 0, -3), vec3_make(0, 0, 6), vec3_make(4, 2, 0), material);
    scene_add_light(scene, (Light){.kind = LIGHT_DIRECTIONAL,
                                   .direction = vec3_make(0, -1, 0),
                                   .intensity = vec3_make(1, 1, 1)});
    // from low on the other side, under the ramp
    scene->camera = (Camera){vec3_make(5.5f, 0.8f, 0), vec3_make(0, 0, 0), vec3_make(0, 1, 0), 0.5f, 0, 0};
}
Test(shadow, a_constant_bias_detaches_the_shadow_by_itself)
{
    ShadowBench bench = shadow_bench(make_ramp, 0);
    ShadowMap map = map_create(bench.scene, &bench.scene->lights[0], false, false, 2048, NULL, 1);
    static double p[SIDE * SIDE][3];
    shadow_points(&bench, p);
    for (int k = 1; k <= 3; k++) {
        const float bias = 0.15f * (float)k;
        const MapLookup lookup = {.bias = BIAS_CONSTANT, .bias_size = bias, .radius = 1};
        float *got = shadow_ask(&bench, &map, &lookup, 0);
        int lit = 0, dark = 0;
        for (int i = 0; i < SIDE * SIDE; i++) {
            const bool under = p[i][1] < 1e-3 && p[i][0] > 0.02 && p[i][0] < 3.9 && fabs(p[i][2]) < 2.9;
            if (!under || got[i] < 0 ||
                fabs(p[i][0] - 2 * bias) < 0.02) // texels of 12 m / 2048, at slope 1/2
                continue;
            cr_assert_eq(got[i] == 1, p[i][0] < 2 * bias, "bias %g m: at %g m", (double)bias, p[i][0]);
            lit += got[i] == 1;
            dark += got[i] == 0;
        }
        cr_assert(lit > 10 && dark > 10, "bias %g: %d lit, %d dark", (double)bias, lit, dark);
        free(got);
    }
    map_delete(&map);
}

// The share of lit texels in a box about a pixel's place in the map, on the CPU; `blur`: of a box that is itself taken between texels.
static double share_of_box(const float *map, int side, double u, double v, double radius, double depth)
{
    double sum = 0;
    for (int y = (int)floor(v - radius); y <= (int)floor(v + radius); y++)
        for (int x = (int)floor(u - radius); x <= (int)floor(u + radius); x++) {
            const double w = fmin(x + 1, u + radius) - fmax(x, u - radius),
                         h = fmin(y + 1, v + radius) - fmax(y, v - radius);
            const int at = (y < 0       ? 0
                            : y >= side ? side - 1
                                        : y) *
                               side +
                           (x < 0       ? 0
                            : x >= side ? side - 1
                                        : x);
            sum += w * h * (map[at] > depth - 0.5);
        }
    return sum / (4 * radius * radius);
}

// A sun straight above a plate: two depths alone, so that what a filter should give is the share of lit texels under its box.
static void check_filter(MapFilter filter, float radius)
{
    const int side = 64;
    ShadowBench bench = shadow_bench(make_plate, LIGHT_DIRECTIONAL);
    bench.camera.eye = vec3_make(0.3f, 1.5f, 0.1f); // under the plate, which would hide its own shadow
    bench.camera.target = vec3_make(0.3f, 0, 0.1f);
    bench.camera.vertical_fov_rad = 1.5f;
    raster_gbuffer_draw(bench.raster, &bench.gbuffer, &bench.camera, &bench.mesh);
    ShadowMap map =
        map_create(bench.scene, &bench.scene->lights[0], false, filter == FILTER_VARIANCE, side, NULL, 1);
    const MapLookup lookup = {.bias = BIAS_SLOPE,
                              .bias_size = filter == FILTER_VARIANCE ? 0 : 1,
                              .filter = filter,
                              .radius = radius};
    float *got = shadow_ask(&bench, &map, &lookup, 0);
    float *depth = shadow_read(map.depth.distance, GL_RED, 1, (size_t)side * (size_t)side);
    static double p[SIDE * SIDE][3];
    shadow_points(&bench, p);
    int between = 0;
    for (int i = 0; i < SIDE * SIDE; i++) {
        const vec3 from_origin = vec3_make((float)p[i][0], (float)p[i][1], (float)p[i][2]) - map.depth.origin;
        const vec3 place = mat4_transform_point(map.depth.to_clip, from_origin);
        const double u = (0.5 * place[0] + 0.5) * side, v = (0.5 * place[1] + 0.5) * side;
        double expected = 0;
        if (filter == FILTER_PCF)
            expected = share_of_box(depth, side, u, v, radius, -from_origin[1]);
        else // box about each of four texels, mixed
            for (int k = 0; k < 4; k++) {
                const double x = floor(u - 0.5) + (k & 1), y = floor(v - 0.5) + (k >> 1);
                const double w = (1 - fabs(u - 0.5 - x)) * (1 - fabs(v - 0.5 - y));
                expected += w * share_of_box(depth, side, x + 0.5, y + 0.5, radius, -from_origin[1]);
            }
        between += expected > 0.01 && expected < 0.99;
        // Chebyshev's bound of two depths is the share itself, never below; squares of distances are kept to 2^-22 of the range's square, and the
        // bound is lost to that below 1e-3. Sums of a hundred parts: 1e-5.
        const double tolerance = filter == FILTER_PCF ? 1e-4 : 3e-3;
        cr_assert(got[i] > expected - tolerance && got[i] < expected + tolerance,
                  "at %g, %g: %g, expected %g", u, v, (double)got[i], expected);
    }
    cr_assert(between > 200, "%d pixels are half lit", between);
    free(got);
    free(depth);
    map_delete(&map);
    gl_close();
}
Test(shadow, pcf_is_the_share_of_lit_texels_under_its_box)
{
    check_filter(FILTER_PCF, 0.5f);
    check_filter(FILTER_PCF, 1.75f);
}
Test(shadow, chebyshev_bounds_two_depths_exactly)
{
    check_filter(FILTER_VARIANCE, 0.5f);
    check_filter(FILTER_VARIANCE, 2.25f);
}

Test(shadow, paraboloid_and_cube_find_a_direction_again)
{
    gl_open(gl_headless_platform(), 0, 0, "test_02");
    shader_search_first("tests/data/shadow");
    enum { COUNT = 26 + 200 };
    static float directions[COUNT][4], found[COUNT][3][4];
    int count = 0;
    for (int k = 0; k < 27; k++) // axes, edges and corners exactly
        if (k != 13) {
            const int of[3] = {k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1};
            for (int axis = 0; axis < 3; axis++)
                directions[count][axis] = (float)of[axis];
            count++;
        }
    for (int k = 0; count < COUNT; k++, count++) { // a spiral over the sphere
        const float z = 1 - 2 * ((float)k + 0.5f) / 200, turn = 2.399963f * (float)k;
        directions[count][0] = 7 * sqrtf(1 - z * z) * cosf(turn);
        directions[count][1] = 7 * sqrtf(1 - z * z) * sinf(turn);
        directions[count][2] = 7 * z;
    }
    GLuint in = gl_buffer(.label = "directions", .bytes = sizeof directions, .data = directions);
    GLuint out = gl_buffer(.label = "found", .bytes = sizeof found);
    Shader *shader = shader_open("paraboloid", NULL, "paraboloid.comp");
    shader_use(shader);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, in);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, out);
    gl.DispatchCompute((COUNT + 63) / 64, 1, 1);
    gl.MemoryBarrier(GL_ALL_BARRIER_BITS);
    gl_buffer_read(out, 0, sizeof found, found);
    for (int i = 0; i < COUNT; i++) {
        const float *d = directions[i], *f = found[i][0];
        const float length = sqrtf(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        const double z = (double)fabsf(d[2]) / (double)length,
                     reached = sqrt((double)(f[0] * f[0] + f[1] * f[1]));
        cr_assert_eq(f[2], d[2] < 0, "direction %d: half", i);
        // stereographic: radius tan(θ/2) with cos θ = z; each place covers dθ/d(radius) = 1 + z radians
        const double radius = tan(0.5 * acos(fmin(z, 1)));
        cr_assert(fabs(reached - radius) < 1e-5 && reached < 1 + 1e-6, "direction %d: place %g, %g", i,
                  (double)f[0], (double)f[1]);
        cr_assert(fabs((double)f[3] - (1 + z)) < 1e-5, "direction %d: angle %g", i, (double)f[3]);
        for (int k = 0; k < 3; k++) {
            cr_assert(fabsf(found[i][1][k] - d[k] / length) < 1e-6f, "direction %d: paraboloid gives %d %g",
                      i, k, (double)found[i][1][k]);
            cr_assert(fabsf(found[i][2][k] - d[k]) < 1e-5f, "direction %d: cube gives %d %g", i, k,
                      (double)found[i][2][k]);
        }
    }
    shader_close(shader);
}

// One quad that fills a lamp's view: its border on the paraboloid is off by the error that is allowed, and far off where no edge is cut.
static void make_large(Scene *scene, uint64_t seed)
{
    (void)seed;
    const uint32_t material = stone(scene);
    add_floor(scene, 40, 0, material);
    mesh_add_quad(&scene->mesh, vec3_make(-3, 2, -0.4f), vec3_make(0, 0, 0.8f), vec3_make(6, 0, 0), material);
    scene_add_light(
        scene,
        (Light){.kind = LIGHT_POINT, .position = vec3_make(0.2f, 3, 0.1f), .intensity = vec3_make(1, 1, 1)});
    scene->camera = (Camera){vec3_make(2, 9, 8), vec3_make(0, 0, 0), vec3_make(0, 1, 0), 1.2f, 0, 0};
}
Test(shadow, cutting_edges_cures_a_paraboloid_s_curves)
{
    ShadowBench bench = shadow_bench(make_large, 0);
    const MapLookup lookup = {.bias = BIAS_SLOPE, .bias_size = 1, .radius = 1};
    Truth *truth = truth_open(&bench.scene->mesh);
    double wrong[3];
    const float tessellation[] = {0, 0.25f, 0};
    for (int k = 0; k < 3; k++) { // the third: a cube
        ShadowMap map = map_create(bench.scene, &bench.scene->lights[0], k < 2, false, 1024, NULL, 1);
        free(shadow_ask(&bench, &map, &lookup, tessellation[k]));
        const Judgement j =
            judge_all(&(Asked){bench.scene, bench.camera, &bench.gbuffer, &bench.visibility}, truth);
        wrong[k] = j.wrong;
        map_delete(&map);
        if (k > 0)
            cr_assert(j.distance_most < 4, "%s: a wrong pixel lies %g pixels from the border",
                      k == 1 ? "paraboloid" : "cube", j.distance_most);
    }
    cr_assert(wrong[0] > 0.05, "uncut, only %g of the pixels are wrong", wrong[0]);
    cr_assert(wrong[1] < 0.02 && wrong[2] < 0.02, "wrong: %g by paraboloid, %g by cube", wrong[1], wrong[2]);
    truth_close(truth);
}

// What is left out depends on what is seen: another view asks other parts of the map, and the old map would be wrong for it.
static void check_view(bool paraboloid)
{
    ShadowBench bench = shadow_bench(make_large, 0);
    const Light *light = &bench.scene->lights[0];
    const MapLookup lookup = {.bias = BIAS_SLOPE, .bias_size = 1, .radius = 1};
    ShadowMap map = map_create(bench.scene, light, paraboloid, false, 512, NULL, 1);
    map_shaders_add(&bench.shaders, map.shape);
    const Camera whole = bench.camera;
    bench.camera.target = vec3_make(1.9f, 0, 7.5f); // a piece of floor before the quad's shadow
    bench.camera.vertical_fov_rad = 0.2f;
    raster_gbuffer_draw(bench.raster, &bench.gbuffer, &bench.camera, &bench.mesh);
    const MapAsked part =
        map_find_receivers(&bench.shaders, &map, light, &bench.gbuffer, &bench.camera, &lookup);
    cr_assert(part.layers < (paraboloid ? 2 : 3) && part.pixels > 0, "%d layers, %u pixels", part.layers,
              part.pixels);
    const MapCasters few = map_find_casters(&bench.shaders, &map, light, &bench.mesh, &lookup, 0);
    map_draw(&bench.shaders, &map, light, &bench.mesh, &few);

    bench.camera = whole;
    raster_gbuffer_draw(bench.raster, &bench.gbuffer, &bench.camera, &bench.mesh);
    map_visibility(&bench.shaders, &map, light, &bench.gbuffer, &bench.camera, &lookup, bench.visibility);
    float *old = shadow_read(bench.visibility, GL_RED, 1, SIDE * SIDE),
          *right = shadow_ask(&bench, &map, &lookup, 0);
    const MapAsked all =
        map_find_receivers(&bench.shaders, &map, light, &bench.gbuffer, &bench.camera, &lookup);
    int differ = 0;
    for (int i = 0; i < SIDE * SIDE; i++)
        differ += old[i] != right[i];
    cr_assert(all.layers > part.layers && all.hash != part.hash && differ > 100,
              "%d layers, %d pixels differ", all.layers, differ);
    free(old);
    free(right);
    map_delete(&map);
}
Test(shadow, a_map_serves_the_view_that_it_was_drawn_for)
{
    check_view(false);
}
Test(shadow, a_half_serves_the_view_that_it_was_drawn_for)
{
    check_view(true);
}
