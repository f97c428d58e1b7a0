// truth: paths of light from what is seen back to where it comes from (Kajiya 1986), and their mean and standard error.
#include "truth_internal.h"

#include <stdlib.h>
#include <string.h>

// Before this bounce no path is ended by chance: the first few carry most of the light.
enum { FIRST_ROULETTE = 3 };
// A path that loses nothing (albedo 1) ends all the same, one in twenty a bounce.
static const double MOST_SURVIVAL = 0.95;

// One sample of the irradiance on a surface, without its own emission.
//
// Each bounce adds the lights' and the emitters' direct light, then one ray by the cosine finds the next surface. What that emits is the
// same light of emitters found a second time: the two ways share it by their densities, w = p / (p + p'), so that nothing counts twice.
// `through` is what a unit of irradiance there gives as irradiance here.
static vec3 path_irradiance(const Tracer *tracer, Surface seen, Random *random)
{
    const TruthPathSettings *settings = &tracer->settings;
    vec3 found = {0}, through = vec3_make(1, 1, 1);
    const bool rays_find_emitters =
        tracer->emitters.count > 0 && settings->emitters != TRUTH_EMITTERS_BY_AREA;
    for (int bounce = 0;; bounce++) {
        const bool counts = bounce > 0 || !settings->indirect_alone, last = bounce == settings->bounces;
        if (counts)
            found += through * tracer_direct(tracer, &seen, random);
        if (last && !rays_find_emitters)
            return found;
        if (settings->bounces == TRUTH_FULL && bounce >= FIRST_ROULETTE) {
            double survival = fmin(MOST_SURVIVAL, (double)truth_largest(through));
            if (random_next(random) >= survival)
                return found;
            through /= (float)survival;
        }
        // By the cosine (Malley: a disc's points, lifted onto the hemisphere): irradiance is π times the mean radiance.
        const double share = random_next(random), cosine = sqrt(1.0 - share);
        const vec3 direction =
            tracer_turn(seen.normal, cosine, sqrt(share), 2.0 * M_PI * random_next(random));
        if (!(vec3_dot(seen.side, direction) > 0.0f))
            return found;
        const Surface next = tracer_see(tracer, seen.at, direction, 0.0f, seen.triangle);
        if (next.triangle == NO_TRIANGLE)
            return found;
        if (counts && rays_find_emitters && truth_largest(next.emission) > 0.0f) {
            const double emitted = -(double)vec3_dot(next.side, direction), distance = (double)next.distance;
            const double by_area = emitters_density(&tracer->emitters, next.emission) * distance * distance,
                         by_cosine = cosine / M_PI * emitted; // both times the emitter's cosine
            const double weight =
                settings->emitters == TRUTH_EMITTERS_BOTH ? by_cosine / (by_cosine + by_area) : 1.0;
            found += (float)(M_PI * weight) * through * next.emission;
        }
        through *= next.albedo;
        if (last || !(truth_largest(through) > 0.0f))
            return found;
        seen = next;
    }
}

static vec3 sample_irradiance(const Tracer *tracer, const Surface *seen, Random *random)
{
    if (tracer->settings.bounce == TRUTH_BOUNCE_OF_PATHS)
        return path_irradiance(tracer, *seen, random);
    vec3 irradiance = tracer_flux(tracer, seen, random);
    if (!tracer->settings.indirect_alone) { // as if there were no bounce
        Tracer direct = *tracer;
        direct.settings.bounces = 0;
        irradiance += path_irradiance(&direct, *seen, random);
    }
    return irradiance;
}

// Mean and standard error; Welford's update (1962) loses nothing where all samples are nearly equal.
static TruthIrradiance irradiance_at(const Tracer *tracer, const Surface *seen, uint64_t number)
{
    TruthIrradiance result = {0};
    double squares[3] = {0};
    const double count = (double)tracer->settings.samples;
    uint64_t key = hash_bytes(HASH_START, &tracer->settings.seed, sizeof tracer->settings.seed);
    key = hash_bytes(key, &number, sizeof number);
    for (uint64_t i = 0; i < (uint64_t)tracer->settings.samples; i++) {
        Random random = {.key = hash_bytes(key, &i, sizeof i)};
        vec3 sample = sample_irradiance(tracer, seen, &random);
        for (int k = 0; k < 3; k++) {
            double off = (double)sample[k] - result.mean[k];
            result.mean[k] += off / (double)(i + 1);
            squares[k] += off * ((double)sample[k] - result.mean[k]);
        }
    }
    for (int k = 0; k < 3 && count > 1.0; k++)
        result.error[k] = sqrt(squares[k] / (count - 1.0) / count);
    return result;
}

// Everything that no sample can answer is refused here, where the numbers still have their names.
static Tracer tracer_open(const Truth *truth, const Scene *scene, const TruthPathSettings *settings)
{
    if (settings->samples < 1)
        fail_request("samples is %d; the truth needs at least 1 a pixel", settings->samples);
    if (settings->bounces < TRUTH_FULL)
        fail_request("bounces is %d; it is 0 for direct light, a count, or %d for all", settings->bounces,
                     TRUTH_FULL);
    if (settings->bounce != TRUTH_BOUNCE_OF_PATHS && settings->bounces != 1)
        fail_request("bounces is %d; flux from the lights bounces once", settings->bounces);
    if (!(settings->least_distance >= 0.0f) || isinf(settings->least_distance))
        fail_request("least_distance is %g m; it is 0 or more", (double)settings->least_distance);
    if (settings->threads < 0)
        fail_request("threads is %d; it is 0 for all cores, or a count", settings->threads);
    if (truth->triangle_count != scene->mesh.triangle_count)
        fail_work("the truth of a mesh of %zu triangles is asked about one of %zu", truth->triangle_count,
                  scene->mesh.triangle_count);
    Tracer tracer = {truth, scene, *settings, tracer_emitters(truth, scene)};
    if (settings->bounces == 0 && tracer.emitters.count == 0)
        tracer.settings.samples = 1; // nothing is left to chance
    return tracer;
}

static void tracer_close(Tracer *tracer)
{
    free(tracer->emitters.triangles);
    free(tracer->emitters.cumulative);
}

TruthIrradiance truth_irradiance(const Truth *truth, const Scene *scene, vec3 point, vec3 normal,
                                 const TruthPathSettings *settings)
{
    Tracer tracer = tracer_open(truth, scene, settings);
    const vec3 unit = vec3_normalize(normal);
    const Surface seen = {.triangle = NO_TRIANGLE,
                          .at = tracer_lift(point - truth->base, unit, truth_largest(point)),
                          .side = unit,
                          .normal = unit};
    TruthIrradiance result = irradiance_at(&tracer, &seen, 0);
    tracer_close(&tracer);
    return result;
}

// --- pictures

typedef struct Exposure {
    Tracer tracer;
    vec3 eye, right, up, forward; // right and up: half the picture's width and height at 1 m
    float near_distance;
    TruthPicture picture;
    atomic_size_t next;
} Exposure;

static void expose_pixel(const Exposure *exposure, size_t pixel)
{
    const Image *mean = &exposure->picture.mean, *error = &exposure->picture.error;
    const size_t column = pixel % (size_t)mean->width, row = pixel / (size_t)mean->width;
    const float x = 2.0f * ((float)column + 0.5f) / (float)mean->width - 1.0f,
                y = 1.0f - 2.0f * ((float)row + 0.5f) / (float)mean->height;
    const vec3 way = exposure->forward + x * exposure->right + y * exposure->up;
    const float before = exposure->near_distance * vec3_length(way); // the near plane lies across `forward`
    const Surface seen =
        tracer_see(&exposure->tracer, exposure->eye, vec3_normalize(way), before, NO_TRIANGLE);
    if (seen.triangle == NO_TRIANGLE)
        return;
    const TruthIrradiance irradiance = irradiance_at(&exposure->tracer, &seen, pixel);
    for (int k = 0; k < 3; k++) {
        const double reflected = (double)seen.albedo[k] / M_PI,
                     own = exposure->tracer.settings.indirect_alone ? 0.0 : (double)seen.emission[k];
        mean->pixels[3 * pixel + (size_t)k] = (float)(own + reflected * irradiance.mean[k]);
        error->pixels[3 * pixel + (size_t)k] = (float)(reflected * irradiance.error[k]);
    }
}

static void *expose_some(void *shared)
{
    Exposure *exposure = shared;
    enum { PIECE = 16 };
    const size_t count = (size_t)exposure->picture.mean.width * (size_t)exposure->picture.mean.height;
    for (;;) {
        size_t first = PIECE * atomic_fetch_add(&exposure->next, 1);
        if (first >= count)
            return NULL;
        for (size_t i = first; i < count && i < first + PIECE; i++)
            expose_pixel(exposure, i);
    }
}

TruthPicture truth_radiance(const Truth *truth, const Scene *scene, const Camera *camera, int width,
                            int height, const TruthPathSettings *settings)
{
    if (width < 1 || height < 1)
        fail_request("a truth of %dx%d pixels; it has at least 1x1", width, height);
    const mat4 turn = mat4_look_at(vec3_make(0, 0, 0), camera->target - camera->eye, camera->up);
    const float half_height = tanf(0.5f * camera->vertical_fov_rad),
                half_width = half_height * (float)width / (float)height;
    // The rows of a rotation are the axes that it turns onto x, y and z.
    Exposure exposure = {
        .tracer = tracer_open(truth, scene, settings),
        .eye = camera->eye - truth->base,
        .right = half_width * vec3_make(turn.column[0][0], turn.column[1][0], turn.column[2][0]),
        .up = half_height * vec3_make(turn.column[0][1], turn.column[1][1], turn.column[2][1]),
        .forward = -vec3_make(turn.column[0][2], turn.column[1][2], turn.column[2][2]),
        .near_distance = camera->near_distance,
        .picture = {image_make(width, height, 3), image_make(width, height, 3)},
    };
    truth_run(expose_some, &exposure, settings->threads);
    tracer_close(&exposure.tracer);
    return exposure.picture;
}

void truth_picture_free(TruthPicture *picture)
{
    image_free(&picture->mean);
    image_free(&picture->error);
}
