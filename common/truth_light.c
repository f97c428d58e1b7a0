// truth: what a ray sees, the light that reaches it straight from lights and emissive triangles, and the light that lights have sent
// to it by way of one other surface.
#include "truth_internal.h"

#include <stdlib.h>

double random_next(Random *random)
{
    uint64_t z = random->key + ++random->draw * UINT64_C(0x9e3779b97f4a7c15);
    z = (z ^ z >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ z >> 27) * UINT64_C(0x94d049bb133111eb);
    return (double)((z ^ z >> 31) >> 11) * 0x1p-53;
}

vec3 tracer_lift(vec3 point, vec3 normal, float most)
{
    return point + 0x1p-21f * most * normal;
}

// A basis around the axis without a square root or a division by zero (Duff et al. 2017).
vec3 tracer_turn(vec3 axis, double cosine, double sine, double around_rad)
{
    float sign = copysignf(1.0f, axis[2]), a = -1.0f / (sign + axis[2]), b = axis[0] * axis[1] * a;
    vec3 x = vec3_make(1.0f + sign * axis[0] * axis[0] * a, sign * b, -sign * axis[0]),
         y = vec3_make(b, sign + axis[1] * axis[1] * a, -axis[1]);
    return vec3_normalize((float)(sine * cos(around_rad)) * x + (float)(sine * sin(around_rad)) * y +
                          (float)cosine * axis);
}

// The point of a triangle at these weights, in double until it is rounded: it lies on the plane to half a unit in the last place.
static vec3 triangle_point(const Truth *truth, uint32_t triangle, double u, double v)
{
    const double weight[3] = {1.0 - u - v, u, v};
    double point[3] = {0};
    for (size_t i = 0; i < 3; i++) {
        const float *p = truth->positions + 3 * (size_t)truth->indices[3 * (size_t)triangle + i];
        for (int k = 0; k < 3; k++)
            point[k] += weight[i] * (double)p[k];
    }
    return vec3_make((float)point[0], (float)point[1], (float)point[2]);
}

static vec3 interpolated_normal(const Mesh *mesh, uint32_t triangle, float u, float v, vec3 otherwise)
{
    const float weight[3] = {1.0f - u - v, u, v};
    vec3 sum = {0};
    for (size_t i = 0; i < 3; i++) {
        const float *n = mesh->normals + 3 * (size_t)mesh->indices[3 * (size_t)triangle + i];
        sum += weight[i] * vec3_make(n[0], n[1], n[2]);
    }
    vec3 normal = vec3_normalize(sum);
    return vec3_dot(normal, normal) > 0.5f ? normal : otherwise;
}

Surface tracer_see(const Tracer *tracer, vec3 origin, vec3 direction, float least, uint32_t skipped)
{
    Meeting met = truth_meet(tracer->truth, origin, direction, least, skipped);
    Surface seen = {.distance = met.distance, .triangle = met.triangle};
    if (met.triangle == NO_TRIANGLE)
        return seen;
    const Mesh *mesh = &tracer->scene->mesh;
    const Material *material = &tracer->scene->materials[mesh->triangle_material[met.triangle]];
    double area;
    seen.side = truth_triangle_normal(tracer->truth, met.triangle, &area);
    seen.normal = interpolated_normal(mesh, met.triangle, met.u, met.v, seen.side);
    if (vec3_dot(seen.side, direction) > 0.0f) {
        seen.side = -seen.side;
        seen.normal = -seen.normal;
    }
    seen.at = triangle_point(tracer->truth, met.triangle, (double)met.u, (double)met.v);
    // Back along the ray, where nothing lies: beside an edge that rounding has put it beyond, the point comes free of the other surface too.
    const float largest = truth_largest(seen.at), back = 0x1p-17f * largest + 0x1p-20f * seen.distance;
    seen.at = tracer_lift(seen.at, seen.side, largest) - back * direction;
    seen.albedo = material->albedo;
    seen.emission = material->emission;
    return seen;
}

// --- point, spot and directional lights

static bool in_cone(const Light *light, vec3 way_from_light)
{
    if (light->kind != LIGHT_SPOT)
        return true;
    double sine = (double)vec3_length(vec3_cross(light->direction, way_from_light)),
           cosine = (double)vec3_dot(light->direction, way_from_light);
    return atan2(sine, cosine) <= (double)light->half_angle_rad;
}

// Between two points relative to base, which are good to float32 there.
static bool hidden(const Tracer *tracer, vec3 from, uint32_t from_triangle, vec3 to, uint32_t to_triangle)
{
    const uint32_t skipped[2] = {from_triangle, to_triangle};
    return truth_between(tracer->truth, from, to, fmaxf(truth_largest(from), truth_largest(to)), skipped);
}

static vec3 light_irradiance(const Tracer *tracer, const Light *light, const Surface *seen)
{
    const vec3 none = {0};
    bool directional = light->kind == LIGHT_DIRECTIONAL;
    vec3 at = light->position - tracer->truth->base, way = directional ? -light->direction : at - seen->at;
    float distance = vec3_length(way), cosine = vec3_dot(seen->normal, way) / distance;
    if (!(distance > 0.0f) || !(cosine > 0.0f) || !(vec3_dot(seen->side, way) > 0.0f))
        return none;
    if (directional)
        return truth_beyond(tracer->truth, seen->at, way, seen->triangle) ? none : cosine * light->intensity;
    if (!in_cone(light, -way) || hidden(tracer, seen->at, seen->triangle, at, NO_TRIANGLE))
        return none;
    float held = fmaxf(distance, light->radius);
    return cosine / (held * held) * light->intensity;
}

// --- emissive triangles

static double strength(vec3 emission)
{
    return ((double)emission[0] + (double)emission[1] + (double)emission[2]) / 3.0;
}

Emitters tracer_emitters(const Truth *truth, const Scene *scene)
{
    Emitters emitters = {0};
    const uint32_t *materials = scene->mesh.triangle_material;
    for (size_t i = 0; i < scene->mesh.triangle_count; i++)
        emitters.count += strength(scene->materials[materials[i]].emission) > 0.0;
    emitters.triangles = memory_new(emitters.count + 1, sizeof *emitters.triangles, "emitters");
    emitters.cumulative = memory_new(emitters.count + 1, sizeof *emitters.cumulative, "emitters");
    size_t next = 0;
    for (size_t i = 0; i < scene->mesh.triangle_count; i++) {
        double each = strength(scene->materials[materials[i]].emission), area;
        if (!(each > 0.0))
            continue;
        truth_triangle_normal(truth, (uint32_t)i, &area);
        emitters.total += each * area;
        emitters.triangles[next] = (uint32_t)i;
        emitters.cumulative[next++] = emitters.total;
    }
    return emitters;
}

double emitters_density(const Emitters *emitters, vec3 emission)
{
    return strength(emission) / emitters->total;
}

// The first triangle whose sum is beyond a share of the total.
static uint32_t draw_emitter(const Emitters *emitters, double share)
{
    size_t low = 0, high = emitters->count - 1;
    while (low < high) {
        size_t middle = (low + high) / 2;
        if (emitters->cumulative[middle] > share * emitters->total)
            high = middle;
        else
            low = middle + 1;
    }
    return emitters->triangles[low];
}

static vec3 emitter_irradiance(const Tracer *tracer, const Surface *seen, Random *random)
{
    const vec3 none = {0};
    const Scene *scene = tracer->scene;
    // Uniform in the triangle (Turk 1990).
    const uint32_t triangle = draw_emitter(&tracer->emitters, random_next(random));
    const double root = sqrt(random_next(random)), u = root * random_next(random);
    double area;
    const vec3 at = triangle_point(tracer->truth, triangle, u, 1.0 - root), way = at - seen->at;
    const double distance = (double)vec3_length(way);
    if (triangle == seen->triangle || !(distance > 0.0) || !(vec3_dot(seen->side, way) > 0.0f))
        return none;
    const double cosine = (double)vec3_dot(seen->normal, way) / distance;
    const double emitted =
        fabs((double)vec3_dot(truth_triangle_normal(tracer->truth, triangle, &area), way)) / distance;
    if (!(cosine > 0.0) || !(emitted > 0.0) || hidden(tracer, seen->at, seen->triangle, at, triangle))
        return none;
    const vec3 emission = scene->materials[scene->mesh.triangle_material[triangle]].emission;
    const double density = emitters_density(&tracer->emitters, emission) * distance * distance / emitted;
    const double other = tracer->settings.emitters == TRUTH_EMITTERS_BOTH ? cosine / M_PI : 0.0;
    return (float)(cosine / (density + other)) *
           emission; // cosine / density, times the weight density / (density + other)
}

vec3 tracer_direct(const Tracer *tracer, const Surface *seen, Random *random)
{
    vec3 irradiance = {0};
    for (size_t i = 0; i < tracer->scene->light_count; i++)
        irradiance += light_irradiance(tracer, &tracer->scene->lights[i], seen);
    if (tracer->emitters.count > 0 && tracer->settings.emitters != TRUTH_EMITTERS_BY_DIRECTION)
        irradiance += emitter_irradiance(tracer, seen, random);
    return irradiance;
}

// --- one bounce, from the lights

// A ray that leaves the light and the flux that it carries, uniform over the light's directions.
static vec3 light_ray(const Tracer *tracer, const Light *light, Random *random, vec3 *origin, vec3 *direction)
{
    const double share = random_next(random), around = 2.0 * M_PI * random_next(random);
    const vec3 base = tracer->truth->base, lower = tracer->scene->lower, upper = tracer->scene->upper;
    if (light->kind == LIGHT_DIRECTIONAL) { // through a disc before the scene that covers its box
        const float radius = 0.5f * vec3_length(upper - lower);
        const vec3 across = tracer_turn(light->direction, 0.0, 1.0, around);
        *direction = light->direction;
        *origin = (0.5f * lower + 0.5f * upper - base) + radius * (float)sqrt(share) * across -
                  2.0f * radius * *direction;
        return (float)M_PI * radius * radius * light->intensity;
    }
    // 1 − cos of the half angle, which loses nothing in narrow cones; a share of it is uniform over the cap (Archimedes).
    const double half_sine = light->kind == LIGHT_SPOT ? sin(0.5 * (double)light->half_angle_rad) : 1.0;
    const double height = 2.0 * half_sine * half_sine, fallen = share * height;
    const vec3 axis = light->kind == LIGHT_SPOT ? light->direction : vec3_make(0, 0, 1);
    *direction = tracer_turn(axis, 1.0 - fallen, sqrt(fallen * (2.0 - fallen)), around);
    *origin = light->position - base;
    return (float)(2.0 * M_PI * height) * light->intensity;
}

static vec3 flux_of_light(const Tracer *tracer, const Light *light, const Surface *seen, Random *random)
{
    const vec3 none = {0};
    const TruthPathSettings *settings = &tracer->settings;
    vec3 origin, direction;
    vec3 flux = light_ray(tracer, light, random, &origin, &direction);
    const Surface lit = tracer_see(tracer, origin, direction, 0x1p-21f * truth_largest(origin), NO_TRIANGLE);
    if (lit.triangle == NO_TRIANGLE)
        return none;
    if (light->kind != LIGHT_DIRECTIONAL && lit.distance < light->radius)
        flux *= lit.distance * lit.distance / (light->radius * light->radius);
    const vec3 way = seen->at - lit.at;
    const float distance = vec3_length(way), leaving = vec3_dot(lit.normal, way) / distance,
                arriving = -vec3_dot(seen->normal, way) / distance;
    if (!(distance > 0.0f) || !(leaving > 0.0f) || !(arriving > 0.0f))
        return none;
    if (settings->bounce == TRUTH_BOUNCE_OF_FLUX) {
        bool faces = vec3_dot(lit.side, way) > 0.0f && vec3_dot(seen->side, way) < 0.0f;
        if (!faces || hidden(tracer, seen->at, seen->triangle, lit.at, lit.triangle))
            return none;
    }
    const float held = fmaxf(distance, settings->least_distance);
    return leaving * arriving / ((float)M_PI * held * held) * lit.albedo * flux;
}

vec3 tracer_flux(const Tracer *tracer, const Surface *seen, Random *random)
{
    vec3 irradiance = {0};
    for (size_t i = 0; i < tracer->scene->light_count; i++)
        irradiance += flux_of_light(tracer, &tracer->scene->lights[i], seen, random);
    return irradiance;
}
