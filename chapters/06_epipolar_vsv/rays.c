// rays: see rays.h.
#include "rays.h"
#include "lanes.h"
#include "measure.h"

#include <embree3/rtcore.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <unistd.h>

// A packet is a tile of 4 × 4 pixels at one φ: all its rays leave the light side by side.
enum { TILE = 4, MOST_THREADS = 64, PHASE_ENTRIES = 4096 };
struct Rays {
    RTCScene scene; // holds the device
};

static void embree_failed(void *unused, enum RTCError code, const char *message)
{
    (void)unused;
    fail_work("Embree error %d: %s", (int)code, message);
}

Rays *rays_open(const Mesh *mesh)
{
    Rays *rays = memory_new(1, sizeof *rays, "Embree's scene");
    RTCDevice device = rtcNewDevice(NULL);
    if (device == NULL)
        fail_work("Embree gives no device (error %d)", (int)rtcGetDeviceError(NULL));
    rtcSetDeviceErrorFunction(device, embree_failed, NULL);
    rays->scene = rtcNewScene(device);
    rtcSetSceneBuildQuality(rays->scene, RTC_BUILD_QUALITY_HIGH);
    if (mesh->triangle_count > 0) {
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_HIGH);
        // copies, since Embree reads 16 bytes a vertex: past the end of the mesh's own array
        float *positions = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                   3 * sizeof(float), mesh->vertex_count);
        uint32_t *indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                    3 * sizeof(uint32_t), mesh->triangle_count);
        for (size_t i = 0; i < 3 * mesh->vertex_count; i++)
            positions[i] = mesh->positions[i];
        for (size_t i = 0; i < 3 * mesh->triangle_count; i++)
            indices[i] = mesh->indices[i];
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(rays->scene, geometry);
        rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(rays->scene);
    rtcReleaseDevice(device);
    return rays;
}

void rays_close(Rays *rays)
{
    if (rays == NULL)
        return;
    rtcReleaseScene(rays->scene);
    free(rays);
}

// What is the same for all tiles.
typedef struct Job {
    const Rays *rays;
    const RaysView *view;
    float *picture;                 // NULL: the bare loop
    float *sine, *cosine, *share;   // of each φ; share: the cell's width
    float phase[PHASE_ENTRIES + 1]; // of (α + φ) / π
    bool uniform, grey;
    vec3 right, up,
        forward; // of the camera, right and up half as long as the picture is wide and high at 1 m
    int tiles_x, tiles, stride;
    atomic_int next;
    atomic_llong sent, nanoseconds;
} Job;

// A tile's pixels: their rays as (sin α, cos α) and the unit vector across the axis in each ray's half-plane.
typedef struct Tile {
    int x, y;
    lanes sine, cosine, distance; // distance < 0: beside the picture
    lanes3 beside, along;
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
        tile.cosine[i] = vec3_dot(axis, way);
        tile.beside.x[i] = beside[0], tile.beside.y[i] = beside[1], tile.beside.z[i] = beside[2];
        tile.along.x[i] = way[0], tile.along.y[i] = way[1], tile.along.z[i] = way[2];
        tile.distance[i] = inside ? view->distance[y * view->width + x] : -1.0f;
    }
    return tile;
}

// Samples of all 16 pixels on the light rays φ.
typedef struct Samples {
    lanes t, r;   // metres from eye and light
    lanes weight; // dt / max(r, r0)² (directional: dt) times the phase function
    mask inside;  // before the first surface, in the light's cone
} Samples;

static lanes phase_of(const Job *job, lanes sine, lanes cosine)
{
    if (job->uniform)
        return lanes_all(job->phase[0]);
    lanes value;
    for (int i = 0; i < LANES; i++) {
        const float at = atan2f(sine[i], cosine[i]) * (float)(PHASE_ENTRIES / M_PI);
        const int below = (int)fminf(fmaxf(at, 0.0f), (float)(PHASE_ENTRIES - 1));
        value[i] = job->phase[below] + (at - (float)below) * (job->phase[below + 1] - job->phase[below]);
    }
    return value;
}

static Samples samples_at(const Job *job, const Tile *tile, int k, struct RTCRay16 *ray)
{
    const RaysView *view = job->view;
    const EpipolarFrame *frame = &view->frame;
    Samples at;
    lanes3 way; // of the ray from the light
    if (frame->at_infinity) {
        at.t = view->middle[k] / tile->sine;
        at.r = lanes_all(0.0f);
        at.inside = at.t <= tile->distance;
        at.weight = job->share[k] / tile->sine * phase_of(job, tile->sine, tile->cosine);
        way = (lanes3){lanes_all(frame->axis[0]), lanes_all(frame->axis[1]), lanes_all(frame->axis[2])};
        *(lanes *)ray->org_x = frame->eye[0] + at.t * tile->along.x;
        *(lanes *)ray->org_y = frame->eye[1] + at.t * tile->along.y;
        *(lanes *)ray->org_z = frame->eye[2] + at.t * tile->along.z;
        *(lanes *)ray->tfar = lanes_all(INFINITY);
    } else {
        const float s = job->sine[k], c = job->cosine[k], radius = view->light->radius;
        const lanes third = tile->sine * c + tile->cosine * s; // sin(α + φ)
        const lanes scale = frame->distance / lanes_choose(third > lanes_all(1e-9f), third, lanes_all(1e-9f));
        at.t = s * scale;
        at.r = tile->sine * scale;
        at.inside = (third > lanes_all(1e-9f)) & (at.t <= tile->distance);
        const lanes held = at.r * at.r / (radius * radius);
        at.weight = job->share[k] / (frame->distance * tile->sine) *
                    phase_of(job, third, tile->cosine * c - tile->sine * s) *
                    lanes_choose(held < lanes_all(1.0f), held, lanes_all(1.0f));
        way = (lanes3){s * tile->beside.x - c * frame->axis[0], s * tile->beside.y - c * frame->axis[1],
                       s * tile->beside.z - c * frame->axis[2]};
        if (view->light->kind == LIGHT_SPOT) {
            const vec3 d = view->light->direction;
            const lanes ahead = way.x * d[0] + way.y * d[1] + way.z * d[2];
            at.inside &= ahead >= lanes_all(cosf(view->light->half_angle_rad));
        }
        *(lanes *)ray->org_x = lanes_all(view->light->position[0]);
        *(lanes *)ray->org_y = lanes_all(view->light->position[1]);
        *(lanes *)ray->org_z = lanes_all(view->light->position[2]);
        *(lanes *)ray->tfar = at.r;
    }
    *(lanes *)ray->dir_x = way.x;
    *(lanes *)ray->dir_y = way.y;
    *(lanes *)ray->dir_z = way.z;
    *(lanes *)ray->tnear = lanes_all(0.0f);
    *(lanes *)ray->time = lanes_all(0.0f);
    *(mask *)ray->mask = (mask){0} - 1;
    *(mask *)ray->flags = (mask){0};
    return at;
}

static struct RTCIntersectContext coherent(void)
{
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    return context;
}

static void draw_tile(Job *job, const Tile *tile)
{
    const RaysView *view = job->view;
    const Medium *medium = &view->scene->medium;
    struct RTCIntersectContext context = coherent();
    lanes sum[3] = {{0}, {0}, {0}};
    long long sent = 0;
    for (int k = 0; k < view->phi; k++) {
        struct RTCRay16 ray;
        const Samples at = samples_at(job, tile, k, &ray);
        if (!lanes_any(at.inside))
            continue;
        sent += lanes_count(at.inside);
        rtcOccluded16((const int *)&at.inside, job->rays->scene, &context, &ray);
        const mask lit = at.inside & (*(lanes *)ray.tfar >= lanes_all(0.0f)); // Embree's mark: -Inf
        const lanes weight = (lanes)(lit & (mask)at.weight), path = at.t + at.r;
        for (int c = 0; c < (job->grey ? 1 : 3); c++)
            sum[c] += weight * lanes_exp(-(medium->scattering[c] + medium->absorption[c]) * path);
    }
    for (int i = 0; i < LANES; i++) {
        const int x = tile->x + i % TILE, y = tile->y + i / TILE;
        if (x < view->width && y < view->height)
            for (int c = 0; c < 3; c++)
                job->picture[4 * (y * view->width + x) + c] +=
                    medium->scattering[c] * view->light->intensity[c] * sum[job->grey ? 0 : c][i];
    }
    atomic_fetch_add(&job->sent, sent);
}

// Packets are made a few at a time, so that they are still near the processor when the clock starts.
static void shoot_tile(Job *job, const Tile *tile)
{
    enum { AHEAD = 64 };
    struct RTCRay16 ray[AHEAD];
    mask inside[AHEAD];
    struct RTCIntersectContext context = coherent();
    long long sent = 0;
    double milliseconds = 0.0;
    for (int k = 0, filled = 0; k < job->view->phi; k++) {
        inside[filled] = samples_at(job, tile, k, &ray[filled]).inside;
        if (lanes_any(inside[filled]))
            sent += lanes_count(inside[filled++]);
        if (filled < AHEAD && k + 1 < job->view->phi)
            continue;
        const double start = measure_now_ms();
        for (int i = 0; i < filled; i++)
            rtcOccluded16((const int *)&inside[i], job->rays->scene, &context, &ray[i]);
        milliseconds += measure_now_ms() - start;
        filled = 0;
    }
    atomic_fetch_add(&job->sent, sent);
    atomic_fetch_add(&job->nanoseconds, (long long)(milliseconds * 1e6));
}

static void *work(void *shared)
{
    Job *job = shared;
    for (;;) {
        const int number = job->stride * atomic_fetch_add(&job->next, 1);
        if (number >= job->tiles)
            return NULL;
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
    const double seconds =
        job->picture ? (measure_now_ms() - start) / 1e3 : (double)job->nanoseconds / 1e9 / threads;
    const RaysCount count = {(double)job->sent, seconds};
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
