// raster: reflective shadow maps against closed forms. The room and its ground truth are in raster_room.h. Green albedo is 0.5 on every
// surface of it; red is 0.25 on the block and 0.5 elsewhere.
#include "raster_room.h"

#include <string.h>

typedef struct Texels {
    int side, count;
    ReflectiveMap map;
    float *distance, *position, *normal, *flux;
} Texels;

static Texels texels_of(const Stage *stage, const Light *light, int side)
{
    Texels t = {.side = side, .map = raster_reflective_map(stage->scene, light, side)};
    raster_reflective_map_draw(stage->raster, &t.map, light, &stage->mesh);
    t.count = side * side * (t.map.depth.kind == LIGHT_POINT ? 6 : 1);
    t.distance = texels(t.map.depth.distance, GL_RED, 1, t.count);
    t.position = texels(t.map.position, GL_RGBA, 4, t.count);
    t.normal = texels(t.map.normal, GL_RGBA, 4, t.count);
    t.flux = texels(t.map.flux, GL_RGBA, 4, t.count);
    return t;
}
static void texels_free(Texels *t)
{
    raster_reflective_map_delete(&t->map);
    free(t->distance), free(t->position), free(t->normal), free(t->flux);
}
static double green_flux(const Texels *t)
{
    double sum = 0;
    for (int i = 0; i < t->count; i++)
        sum += t->flux[4 * i + 1];
    return sum;
}

// The textbook's four arc tangents, in double.
static double corner_angle(double x, double y)
{
    return atan(x * y / sqrt(1 + x * x + y * y));
}
static double texel_angle(double tangent, int side, int x, int y)
{
    double u0 = tangent * (2.0 * x / side - 1), u1 = tangent * (2.0 * (x + 1) / side - 1),
           v0 = tangent * (2.0 * y / side - 1), v1 = tangent * (2.0 * (y + 1) / side - 1);
    return corner_angle(u1, v1) - corner_angle(u0, v1) - corner_angle(u1, v0) + corner_angle(u0, v0);
}

static void check_texels(LightKind kind, float half_angle_rad, float radius, uint64_t seed)
{
    bool walls = seed & WALLS;
    Stage stage = stage_open(make, seed);
    Light light = light_of(kind, seed);
    light.half_angle_rad = half_angle_rad;
    light.radius = radius;
    Texels t = texels_of(&stage, &light, MAP);
    const DepthMap *depth = &t.map.depth;
    const double scale = scale_of(seed);
    const double tangent = depth->kind == LIGHT_SPOT ? tan((double)half_angle_rad) : 1;
    const double middle[3] = {0.5 * scale, 5 * scale, 0.75 * scale}; // of the light, without the far offset
    int hit = 0, lit = 0, unlit = 0, wrong = 0, block = 0;
    for (int i = 0; i < t.count; i++) {
        const float *p = t.position + 4 * i, *n = t.normal + 4 * i, *flux = t.flux + 4 * i;
        if (isinf(t.distance[i])) {
            for (int c = 0; c < 4; c++)
                cr_assert(p[c] == 0 && n[c] == 0 && flux[c] == 0, "texel %d has no surface", i);
            continue;
        }
        hit++;
        cr_assert(n[3] == 0 && flux[3] == 0, "texel %d", i);
        // Where the light's own ray through that position meets the room, in the room's own metres.
        double from[3], d[3], normal[3], length = 0;
        for (int c = 0; c < 3; c++) {
            from[c] = kind == LIGHT_DIRECTIONAL
                          ? (double)(depth->origin[c] - place(seed, 0, 0, 0)[c]) / scale + p[c] / scale -
                                t.distance[i] / scale * light.direction[c]
                          : middle[c] / scale;
            d[c] = kind == LIGHT_DIRECTIONAL ? light.direction[c] : p[c];
            length += d[c] * d[c];
        }
        for (int c = 0; c < 3; c++)
            d[c] /= sqrt(length);
        double expected = trace(walls, from, d, normal);
        if (!(fabs(t.distance[i] / scale - expected) <= RELATIVE * expected)) {
            wrong++; // on an edge, either surface
            continue;
        }
        if (kind != LIGHT_DIRECTIONAL) // three roundings of a length
            cr_assert(fabs(sqrt(length) - t.distance[i]) <= 1e-6 * t.distance[i], "texel %d: position", i);
        for (int c = 0; c < 3; c++)
            cr_assert(n[c] == (float)normal[c], "texel %d: normal %g, %g, %g", i, n[0], n[1], n[2]);
        // Flux: intensity times the texel's own angle times albedo.
        double along = 0, cosine = 0, across = 1, power = light.intensity[1];
        for (int c = 0; c < 3; c++)
            along += d[c] * light.direction[c], cosine -= d[c] * normal[c];
        if (kind == LIGHT_DIRECTIONAL) {
            for (int row = 0; row < 2; row++) {
                double square = 0;
                for (int c = 0; c < 3; c++)
                    square += pow(depth->to_clip.column[c][row], 2);
                across *= 2 / sqrt(square) / MAP;
            }
            power *= across;
        } else {
            double held = fmin(expected * scale / radius, 1),
                   angle = texel_angle(tangent, MAP, i % MAP, i / MAP % MAP);
            across = angle * pow(expected * scale, 2);
            power *= held * held * angle;
        }
        // Both from a squared distance off by RELATIVE; the solid angle adds some 1e-6. The cosine is off by 1e-6 of 1.
        cr_assert(fabs(p[3] * cosine / across - 1) < 5e-5 + 1e-6 / cosine, "texel %d: %g m², expected %g", i,
                  p[3], across / cosine);
        if (kind == LIGHT_SPOT && fabs(acos(along) - half_angle_rad) < 1e-5)
            continue; // rounding decides
        if (kind == LIGHT_SPOT && acos(along) > half_angle_rad)
            power = 0;
        cr_assert(fabs(flux[1] - 0.5 * power) <= 5e-5 * power, "texel %d: %g W, expected %g", i, flux[1],
                  0.5 * power);
        if (power > 0) {
            double red = 0.25 * flux[0] /
                         flux[1]; // the light has twice as much red as green, of which half is reflected
            bool is_block = fabs(red - 0.25) < 1e-5;
            cr_assert(is_block || fabs(red - 0.5) < 1e-5, "texel %d: albedo %g", i, red);
            bool on_block = true;
            for (int c = 0; c < 3; c++) {
                double at = from[c] + expected * d[c];
                on_block = on_block && at > BLOCK.lower[c] - 1e-4 && at < BLOCK.upper[c] + 1e-4;
            }
            cr_assert(is_block == on_block, "texel %d is %son the block", i, on_block ? "" : "not ");
            block += is_block;
        }
        lit += power > 0, unlit += power == 0;
    }
    cr_assert(hit > t.count / 8 && lit > t.count / 8 && block > 64, "%d hit, %d lit, %d block", hit, lit,
              block);
    cr_assert((unlit > 0) == (kind == LIGHT_SPOT), "%d texels beside the cone", unlit);
    cr_assert(wrong <= 4 * EDGE_TEXELS, "%d texels show another surface", wrong);
    texels_free(&t);
    stage_close(&stage);
}
Test(raster_reflective, texels_of_a_point_light)
{
    check_texels(LIGHT_POINT, 0, 1e-3f, WALLS);
}
Test(raster_reflective, texels_of_a_spot_light)
{
    check_texels(LIGHT_SPOT, 0.6f, 1e-3f, WALLS);
}
Test(raster_reflective, texels_of_a_wide_spot_light)
{
    check_texels(LIGHT_SPOT, 1.5f, 1e-3f, WALLS);
}
Test(raster_reflective, texels_of_the_sun)
{
    check_texels(LIGHT_DIRECTIONAL, 0, 1e-3f, 0);
}
Test(raster_reflective, inverse_square_is_held_inside_the_radius)
{
    check_texels(LIGHT_POINT, 0, 4.5f, WALLS); // part of the room is nearer, part farther
}
Test(raster_reflective, texels_far_away_tiny_and_giant)
{
    const uint64_t seeds[] = {FAR_AWAY, TINY, GIANT};
    for (int i = 0; i < 3; i++) {
        float radius = 1e-3f * scale_of(seeds[i]);
        check_texels(LIGHT_POINT, 0, radius, WALLS | seeds[i]);
        check_texels(LIGHT_SPOT, 0.6f, radius, WALLS | seeds[i]);
        if (seeds[i] !=
            FAR_AWAY) // there its origin is rounded to 1/16 m: the distance test below stands for it
            check_texels(LIGHT_DIRECTIONAL, 0, radius, seeds[i]);
    }
}

// So that lights and shadows may take this map for a depth map.
Test(raster_reflective, distances_are_those_of_the_depth_map)
{
    for (int k = 0; k < 6; k++) {
        LightKind kind = (LightKind)(k % 3);
        uint64_t seed = (kind == LIGHT_DIRECTIONAL ? 0u : WALLS) | (k < 3 ? 0u : FAR_AWAY);
        Stage stage = stage_open(make, seed);
        Light light = light_of(kind, seed);
        Texels t = texels_of(&stage, &light, MAP);
        DepthMap map = raster_depth_map(stage.scene, &light, MAP, NULL, 1);
        raster_depth_map_draw(stage.raster, &map, &light, &stage.mesh);
        float *distance = texels(map.distance, GL_RED, 1, t.count);
        cr_assert(memcmp(&map.to_clip, &t.map.depth.to_clip, sizeof map.to_clip) == 0, "light %d: framing",
                  k);
        for (int i = 0; i < t.count; i++) // two programs may round an interpolation differently
            cr_assert(distance[i] == t.distance[i] ||
                          fabsf(distance[i] - t.distance[i]) <= 4e-7f * distance[i],
                      "light %d, texel %d: %.9g, depth map %.9g", k, i, t.distance[i], distance[i]);
        free(distance);
        raster_depth_map_delete(&map);
        texels_free(&t);
        stage_close(&stage);
    }
}

// All of a point light's rays end on something of albedo 0.5, whatever the map's size, and wherever the light is.
Test(raster_reflective, closed_room_reflects_four_pi_intensity_albedo)
{
    Stage stage = stage_open(make, WALLS);
    const vec3 places[] = {vec3_make(0.5f, 5, 0.75f), vec3_make(0, 1.5f, 0), vec3_make(3.999f, 3, 0.5f)};
    const int sides[] = {1, 2, 7, 64};
    for (int p = 0; p < 3; p++) // in the room, inside the block, a millimetre off the wall
        for (int s = 0; s < 4; s++) {
            // Rasterizers place corners to 1/256 of a texel. A millimetre is less, so the seam of wall and floor falls on the centres of an odd map's
            // middle texels, where the wall, seen along its plane, is infinitely far: nothing is drawn there, in this map as in any.
            if (p == 2 && sides[s] % 2 == 1)
                continue;
            Light light = light_of(LIGHT_POINT, 0);
            light.position = places[p];
            light.radius = 1e-4f;
            Texels t = texels_of(&stage, &light, sides[s]);
            double expected = 4 * M_PI * light.intensity[1] * 0.5, got = green_flux(&t);
            cr_assert(fabs(got / expected - 1) < 1e-6, "place %d, %d texels a side: %.9g W, expected %.9g", p,
                      sides[s], got, expected); // an angle's rounding: a few 2^-24, measured 3e-7
            texels_free(&t);
        }
    stage_close(&stage);
}

Test(raster_reflective, spot_reflects_its_cone)
{
    Stage stage = stage_open(make, WALLS);
    const double half_angles[] = {0.05, 0.6, 1.2, 1.5}; // the last by a cube
    for (int k = 0; k < 4; k++)
        for (int side = 64; side <= 256; side *= 2) {
            Light light = light_of(LIGHT_SPOT, 0);
            light.half_angle_rad = (float)half_angles[k];
            Texels t = texels_of(&stage, &light, side);
            double expected = 2 * M_PI * (1 - cos(half_angles[k])) * light.intensity[1] * 0.5;
            // A texel counts whole or not at all: some 4·side texels of the border (of a cube 8) are each off by 0.29 of one (uniform), like
            // signs by eights for symmetry, of π/4·side² in all; three times that. Off the axis texels are smaller.
            double tolerance = 3 * sqrt(8.0 * 8 * side) * 0.29 / (M_PI / 4 * side * side);
            double got = green_flux(&t);
            cr_assert(fabs(got / expected - 1) < tolerance, "%g rad, %d: %g W, expected %g ± %g",
                      half_angles[k], side, got, expected, tolerance * expected);
            texels_free(&t);
        }
    stage_close(&stage);
}

// The floor is 8 m × 10 m, and the block's shadow lies on it: what the light loses there the block reflects.
Test(raster_reflective, sun_reflects_irradiance_area_cosine_albedo)
{
    Stage stage = stage_open(make, 0);
    const vec3 directions[] = {vec3_make(0, -1, 0), vec3_make(-0.25f, -1, -0.125f), vec3_make(1, -1, 0.5f)};
    for (int k = 0; k < 3; k++) {
        Light light = light_of(LIGHT_DIRECTIONAL, 0);
        light.direction = vec3_normalize(directions[k]);
        Texels t = texels_of(&stage, &light, 256);
        double expected = light.intensity[1] * 80 * -light.direction[1] * 0.5, got = green_flux(&t);
        // Centres counted instead of an area: the border's four sides, 18 m · 2, by half a texel's width at most.
        double tolerance = 0.5 * t.map.depth.texel_size * 36 / 80;
        cr_assert(fabs(got / expected - 1) < tolerance, "sun %d: %g W, expected %g ± %g", k, got, expected,
                  tolerance * expected);
        texels_free(&t);
    }
    stage_close(&stage);
}

Test(raster_reflective, empty_scene_reflects_nothing)
{
    Stage stage = stage_open(make_nothing, 0);
    for (int kind = 0; kind < 3; kind++) {
        Light light = light_of((LightKind)kind, 0);
        Texels t = texels_of(&stage, &light, 8);
        for (int i = 0; i < t.count; i++)
            cr_assert(isinf(t.distance[i]) && t.flux[4 * i] == 0 && t.position[4 * i + 3] == 0,
                      "light %d, texel %d", kind, i);
        texels_free(&t);
    }
    stage_close(&stage);
}
