// rays: see rays.h.
#include "measure.h"
#include "rays_internal.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

// A packet is a tile of 4 × 4 pixels at one φ: all its rays leave the light side by side. What is done for all of its 16 lanes is written as loops of 16
// without a branch, which compilers turn into vectors; WIDE compiles a function for each width of registers, the machine's is taken when the program starts.
#if defined(__x86_64__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define WIDE __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define WIDE
#endif
#define INLINE  static inline __attribute__((always_inline))
#define EACH(i) for (int i = 0; i < LANES; i++)
enum { LANES = 16, TILE = 4, MOST_THREADS = 64, PHASE_ENTRIES = 4096 };

// What is the same for all tiles.
typedef struct Job {
    const Rays *rays;
    const RaysView *view;
    float *picture;                 // NULL: the bare loop
    float *sine, *cosine, *share;   // of each φ; share: the cell's width
    float phase[PHASE_ENTRIES + 1]; // of (α + φ) / π
    bool uniform, grey;
    float even_phase; // the uniform phase function; of others 1, they are in each sample's weight
    vec3 cone_axis;
    float cone_cosine;
    vec3 right, up,
        forward; // of the camera, right and up half as long as the picture is wide and high at 1 m
    int tiles_x, tiles, stride;
    atomic_int next;
    atomic_llong sent, nanoseconds;
} Job;

// A tile's pixels: their rays as (sin α, cos α) and the unit vector across the axis in each ray's half-plane.
typedef struct Tile {
    int x, y;
    float sine[LANES], over_sine[LANES], cosine[LANES], distance[LANES]; // distance < 0: beside the picture
    float beside[3][LANES], along[3][LANES];
} Tile;

static Tile tile_make(const Job *job, int number)
{
    const RaysView *view = job->view;
    const vec3 axis = view->frame.axis;
    Tile tile = {.x = number % job->tiles_x * TILE, .y = number / job->tiles_x * TILE};
    for (int i = 0; i < LANES; i++) {
        const int x = tile.x + i % TILE, y = tile.y + i / TILE;
        const bool inside = x < view->width && y < view->height;
        const float u = 2.0f * ((float)x + 0.5f) / (float)view->width - 1.0f,
                    v = 2.0f * ((float)y + 0.5f) / (float)view->height - 1.0f;
        const vec3 way = vec3_normalize(job->forward + u * job->right + v * job->up);
        const vec3 across = vec3_cross(vec3_cross(axis, way), axis); // sin α long
        const vec3 beside = vec3_normalize(across);
        tile.sine[i] = fmaxf(vec3_length(across), 1e-7f); // on the axis: a ray that passes the light so near
        tile.over_sine[i] = 1.0f / tile.sine[i];
        tile.cosine[i] = vec3_dot(axis, way);
        for (int k = 0; k < 3; k++) {
            tile.beside[k][i] = beside[k];
            tile.along[k][i] = way[k];
        }
        tile.distance[i] = inside ? view->distance[y * view->width + x] : -1.0f;
    }
    return tile;
}

// Samples of all 16 pixels on the light rays φ.
typedef struct Samples {
    float path[LANES];    // metres from the eye to the sample to the light
    float weight[LANES];  // dt / max(r, r0)² (directional: dt), still without the phase function
    float turn[2][LANES]; // sine and cosine of the angle that scattered light turns by
    int32_t inside[LANES]
        __attribute__((aligned(64))); // -1: before the first surface, in the light's cone; else 0
    int count;                        // of those
    int32_t before[LANES]; // -1: before the first surface: where no lane is, none is at any larger φ
} Samples;

INLINE void samples_of_sun(const Job *job, const Tile *tile, int k, Samples *at, struct RTCRay16 *ray)
{
    const vec3 eye = job->view->frame.eye;
    const float middle = job->view->middle[k], share = job->share[k];
    EACH(i)
    {
        const float t = middle / tile->sine[i];
        at->path[i] = t;
        at->weight[i] = share * tile->over_sine[i];
        at->turn[0][i] = tile->sine[i];
        at->turn[1][i] = tile->cosine[i];
        at->inside[i] = at->before[i] = t <= tile->distance[i] ? -1 : 0;
        ray->org_x[i] = eye[0] + t * tile->along[0][i];
        ray->org_y[i] = eye[1] + t * tile->along[1][i];
        ray->org_z[i] = eye[2] + t * tile->along[2][i];
        ray->tfar[i] = INFINITY;
    }
}

INLINE void samples_of_lamp(const Job *job, const Tile *tile, int k, Samples *at, struct RTCRay16 *ray)
{
    const RaysView *view = job->view;
    const vec3 axis = view->frame.axis, ahead = job->cone_axis;
    const float s = job->sine[k], c = job->cosine[k], far = view->frame.distance, share = job->share[k] / far;
    const float over_radius = 1.0f / view->light->radius, least = job->cone_cosine;
    EACH(i)
    {
        const float third = tile->sine[i] * c + tile->cosine[i] * s; // sin(α + φ), by the law of sines
        const float scale = far / (third > 1e-9f ? third : 1e-9f), t = s * scale, r = tile->sine[i] * scale;
        const float x = s * tile->beside[0][i] - c * axis[0], y = s * tile->beside[1][i] - c * axis[1],
                    z = s * tile->beside[2][i] - c * axis[2];
        const float held = r * over_radius, in_cone = x * ahead[0] + y * ahead[1] + z * ahead[2] - least;
        at->path[i] = t + r;
        at->weight[i] = share * tile->over_sine[i] * (held < 1.0f ? held * held : 1.0f);
        at->turn[0][i] = third;
        at->turn[1][i] = tile->cosine[i] * c - tile->sine[i] * s;
        // `third` is held above 0, so that what lies beyond any point of the ray is as far as it can be, and no further
        at->before[i] = ((third > 1e-9f) & (t <= tile->distance[i])) ? -1 : 0;
        at->inside[i] = in_cone >= 0.0f ? at->before[i] : 0;
        ray->dir_x[i] = x;
        ray->dir_y[i] = y;
        ray->dir_z[i] = z;
        ray->tfar[i] = r;
    }
}

// What all packets have in common, since Embree changes tfar alone: the lamp as origin, or the way to the sun.
INLINE void packet_begin(const Job *job, struct RTCRay16 *ray)
{
    const vec3 lamp = job->view->light->position, axis = job->view->frame.axis;
    EACH(i)
    {
        ray->org_x[i] = lamp[0];
        ray->org_y[i] = lamp[1];
        ray->org_z[i] = lamp[2];
        ray->dir_x[i] = axis[0];
        ray->dir_y[i] = axis[1];
        ray->dir_z[i] = axis[2];
        ray->tnear[i] = 0.0f;
        ray->time[i] = 0.0f;
        ray->mask[i] = UINT32_MAX;
        ray->flags[i] = 0;
    }
}

INLINE void samples_at(const Job *job, const Tile *tile, int k, Samples *at, struct RTCRay16 *ray)
{
    if (job->view->frame.at_infinity)
        samples_of_sun(job, tile, k, at, ray);
    else
        samples_of_lamp(job, tile, k, at, ray);
    int count = 0;
    EACH(i)
    {
        count -= at->inside[i];
    }
    at->count = count;
}

// Whether all 16 pixels' rays have ended.
INLINE bool samples_over(const Samples *at)
{
    int before = 0;
    EACH(i)
    {
        before -= at->before[i];
    }
    return before == 0;
}

static void apply_phase(const Job *job, Samples *at)
{
    EACH(i)
    {
        const float place =
            fmaxf(atan2f(at->turn[0][i], at->turn[1][i]), 0.0f) * (float)(PHASE_ENTRIES / M_PI);
        const int below = (int)fminf(place, (float)(PHASE_ENTRIES - 1));
        const float *value = &job->phase[below];
        at->weight[i] *= value[0] + (place - (float)below) * (value[1] - value[0]);
    }
}

// e^x for x <= 0: 2^n · 2^f with f in [-1/2, 1/2], whose polynomial (Taylor's in f ln 2) is good to 2e-7.
INLINE float exponential(float x)
{
    const float magic = 12582912.0f; // 1.5 · 2^23: adding it rounds to a whole number
    const float power = x * 1.44269504f, held = power > -126.0f ? power : -126.0f;
    const float whole = (held + magic) - magic, f = (held - whole) * 0.693147181f;
    const float tail = 4.16666667e-2f + f * (8.33333333e-3f + f * 1.38888889e-3f);
    const union {
        int32_t bits;
        float value;
    } scale = {((int32_t)whole + 127) << 23};
    return scale.value * (1.0f + f * (1.0f + f * (0.5f + f * (1.66666667e-1f + f * tail))));
}

static long long processor_now(void) // nanoseconds of this thread
{
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return 1000000000LL * now.tv_sec + now.tv_nsec;
}

static struct RTCIntersectContext coherent(void)
{
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    return context;
}

WIDE static void draw_tile(Job *job, const Tile *tile)
{
    const RaysView *view = job->view;
    const vec3 scattering = view->scene->medium.scattering,
               extinction = scattering + view->scene->medium.absorption;
    struct RTCIntersectContext context = coherent();
    float sum[3][LANES] = {{0}};
    long long sent = 0;
    struct RTCRay16 ray;
    Samples at;
    packet_begin(job, &ray);
    for (int k = 0; k < view->phi; k++) {
        samples_at(job, tile, k, &at, &ray);
        if (at.count == 0 && samples_over(&at))
            break;
        if (at.count == 0)
            continue;
        sent += at.count;
        rtcOccluded16(at.inside, job->rays->scene, &context, &ray);
        if (!job->uniform)
            apply_phase(job, &at);
        for (int c = 0; c < (job->grey ? 1 : 3); c++)
            EACH(i)
            {
                const float value = at.weight[i] * exponential(-extinction[c] * at.path[i]);
                const int32_t lit = ray.tfar[i] >= 0.0f ? at.inside[i] : 0; // Embree's mark: -Inf
                sum[c][i] += lit ? value : 0.0f;
            }
    }
    EACH(i)
    {
        const int x = tile->x + i % TILE, y = tile->y + i / TILE;
        if (x < view->width && y < view->height)
            for (int c = 0; c < 3; c++)
                job->picture[4 * (y * view->width + x) + c] +=
                    scattering[c] * view->light->intensity[c] * job->even_phase * sum[job->grey ? 0 : c][i];
    }
    atomic_fetch_add(&job->sent, sent);
}

// Packets are made a few at a time, so that they are still near the processor when the clock starts.
WIDE static void shoot_tile(Job *job, const Tile *tile)
{
    enum { AHEAD = 64 };
    struct RTCRay16 ray[AHEAD];
    Samples at[AHEAD];
    struct RTCIntersectContext context = coherent();
    long long sent = 0, spent = 0;
    for (int i = 0; i < AHEAD; i++)
        packet_begin(job, &ray[i]);
    for (int k = 0, filled = 0; k < job->view->phi; k++) {
        samples_at(job, tile, k, &at[filled], &ray[filled]);
        sent += at[filled].count;
        const bool last = k + 1 == job->view->phi || (at[filled].count == 0 && samples_over(&at[filled]));
        filled += at[filled].count > 0;
        if (filled < AHEAD && !last)
            continue;
        const long long start = processor_now();
        for (int i = 0; i < filled; i++)
            rtcOccluded16(at[i].inside, job->rays->scene, &context, &ray[i]);
        spent += processor_now() - start;
        filled = 0;
        if (last)
            break;
    }
    atomic_fetch_add(&job->sent, sent);
    atomic_fetch_add(&job->nanoseconds, spent);
}

static void *work(void *shared)
{
    Job *job = shared;
    const long long start = processor_now();
    for (;;) {
        const int number = job->stride * atomic_fetch_add(&job->next, 1);
        if (number >= job->tiles) {
            if (job->picture)
                atomic_fetch_add(&job->nanoseconds, processor_now() - start);
            return NULL;
        }
        const Tile tile = tile_make(job, number);
        if (job->picture)
            draw_tile(job, &tile);
        else
            shoot_tile(job, &tile);
    }
}

static int run_threads(Job *job)
{
    pthread_t others[MOST_THREADS];
    const long wanted = sysconf(_SC_NPROCESSORS_ONLN);
    int started = 0;
    while (started < wanted - 1 && started < MOST_THREADS &&
           pthread_create(&others[started], NULL, work, job) == 0)
        started++;
    work(job);
    for (int i = 0; i < started; i++)
        pthread_join(others[i], NULL);
    return started + 1;
}

static Job *job_make(const Rays *rays, const RaysView *view, float *picture, int stride)
{
    Job *job = memory_new(1, sizeof *job, "the rays' job");
    const mat4 turn = camera_view(*view->camera); // its rows are the axes
    const float half = tanf(0.5f * view->camera->vertical_fov_rad),
                aspect = (float)view->width / (float)view->height;
    const vec3 extinction = view->scene->medium.scattering + view->scene->medium.absorption;
    *job = (Job){.rays = rays, .view = view, .picture = picture, .stride = stride};
    for (int i = 0; i < 3; i++) {
        job->right[i] = half * aspect * turn.column[i][0];
        job->up[i] = half * turn.column[i][1];
        job->forward[i] = -turn.column[i][2];
    }
    job->tiles_x = (view->width + TILE - 1) / TILE;
    job->tiles = job->tiles_x * ((view->height + TILE - 1) / TILE);
    job->uniform = view->phase->name[0] == 'u';
    job->even_phase = job->uniform ? (float)truth_phase(view->phase, 1.0) : 1.0f;
    job->cone_axis = view->light->kind == LIGHT_SPOT ? view->light->direction : vec3_make(0, 0, 0);
    job->cone_cosine = view->light->kind == LIGHT_SPOT ? cosf(view->light->half_angle_rad) : 0.0f;
    job->grey = extinction[0] == extinction[1] && extinction[1] == extinction[2];
    for (int i = 0; i <= PHASE_ENTRIES; i++)
        job->phase[i] = (float)truth_phase(view->phase, cos(M_PI * i / PHASE_ENTRIES));
    const size_t phi = (size_t)view->phi;
    job->sine = memory_new(3 * phi, sizeof(float), "angles");
    job->cosine = job->sine + phi;
    job->share = job->cosine + phi;
    for (size_t k = 0; k < phi; k++) {
        job->sine[k] = sinf(view->middle[k]);
        job->cosine[k] = cosf(view->middle[k]);
        job->share[k] = view->border[k + 1] - view->border[k];
    }
    return job;
}

static RaysCount run_job(Job *job)
{
    const double start = measure_now_ms();
    const int threads = run_threads(job);
    const RaysCount count = {(double)job->sent, (measure_now_ms() - start) / 1e3,
                             (double)job->nanoseconds / 1e9 / threads};
    free(job->sine);
    free(job);
    return count;
}

float *rays_angles(const EpipolarRange *range, bool square)
{
    const size_t phi = (size_t)range->phi;
    float *angles = memory_new(2 * phi + 1, sizeof *angles, "angles");
    for (size_t i = 0; i <= 2 * phi; i++) { // borders, then middles
        const double place = i <= phi ? (double)i : (double)(i - phi - 1) + 0.5, u = place / (double)phi;
        const double share = square ? u * u : u;
        angles[i] =
            (float)((double)range->phi_least + share * ((double)range->phi_most - (double)range->phi_least));
    }
    return angles;
}

RaysCount rays_draw(const Rays *rays, const RaysView *view, float *picture)
{
    return run_job(job_make(rays, view, picture, 1));
}

RaysCount rays_bare(const Rays *rays, const RaysView *view, int stride)
{
    return run_job(job_make(rays, view, NULL, stride));
}
