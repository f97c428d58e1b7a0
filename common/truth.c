// truth: rays by Embree, the mesh of set voxels that they can be sent at, and the names of cached truths.
#include "truth_internal.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

// The Makefile gives a hash of truth's sources. Built by hand, the time of compilation never lets an older truth pass for this one's.
#ifndef TRUTH_SOURCE_HASH
#define TRUTH_SOURCE_HASH __DATE__ " " __TIME__
#endif
static const char source_hash[] = TRUTH_SOURCE_HASH;

static void embree_failed(void *unused, enum RTCError code, const char *message)
{
    (void)unused;
    fail_work("Embree error %d: %s", (int)code, message);
}

// Along an axis on which the mesh lies farther from the origin than twice its size, the middle of its box: all coordinates are then within
// a factor of 2 of it, so that their differences are exact (Sterbenz 1974), and rays keep the precision of the mesh's size.
static vec3 base_of(const Mesh *mesh)
{
    vec3 base = {0};
    for (size_t k = 0; k < 3 && mesh->vertex_count > 0; k++) {
        float lower = INFINITY, upper = -INFINITY;
        for (size_t i = 0; i < mesh->vertex_count; i++) {
            lower = fminf(lower, mesh->positions[3 * i + k]);
            upper = fmaxf(upper, mesh->positions[3 * i + k]);
        }
        float middle = 0.5f * lower + 0.5f * upper;
        base[k] = fabsf(middle) > 2.0f * (upper - lower) ? middle : 0.0f;
    }
    return base;
}

Truth *truth_open(const Mesh *mesh)
{
    Truth *truth = memory_new(1, sizeof *truth, "truth");
    RTCDevice device = rtcNewDevice(NULL);
    if (device == NULL)
        fail_work("Embree gives no device (error %d)", (int)rtcGetDeviceError(NULL));
    rtcSetDeviceErrorFunction(device, embree_failed, NULL);
    truth->scene = rtcNewScene(device);
    // No ray slips through between two triangles, and a ray may leave out the triangle that it starts on.
    rtcSetSceneFlags(truth->scene, RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
    truth->triangle_count = mesh->triangle_count;
    truth->base = base_of(mesh);
    if (mesh->triangle_count > 0) {
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        // Copies, since Embree reads 16 bytes a vertex: past the end of the mesh's own array.
        float *positions = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                   3 * sizeof(float), mesh->vertex_count);
        void *indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                3 * sizeof(uint32_t), mesh->triangle_count);
        for (size_t i = 0; i < 3 * mesh->vertex_count; i++)
            positions[i] = mesh->positions[i] - truth->base[i % 3];
        truth->positions = positions;
        truth->indices = memcpy(indices, mesh->indices, 3 * sizeof(uint32_t) * mesh->triangle_count);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(truth->scene, geometry);
        rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(truth->scene);
    rtcReleaseDevice(device);
    return truth;
}

void truth_close(Truth *truth)
{
    if (truth == NULL)
        return;
    rtcReleaseScene(truth->scene);
    free(truth);
}

// In double from the vertices: Embree's own normal, a float32 cross product, is noise on slivers and underflows on tiny triangles.
vec3 truth_triangle_normal(const Truth *truth, uint32_t triangle, double *area)
{
    const float *vertex[3];
    double e[2][3], n[3];
    for (int v = 0; v < 3; v++)
        vertex[v] = truth->positions + 3 * (size_t)truth->indices[3 * (size_t)triangle + (size_t)v];
    for (int i = 0; i < 6; i++)
        e[i / 3][i % 3] = (double)vertex[i / 3 + 1][i % 3] - (double)vertex[0][i % 3];
    for (int k = 0; k < 3; k++)
        n[k] = e[0][(k + 1) % 3] * e[1][(k + 2) % 3] - e[0][(k + 2) % 3] * e[1][(k + 1) % 3];
    double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    *area = 0.5 * length;
    return vec3_make((float)(n[0] / length), (float)(n[1] / length), (float)(n[2] / length));
}

float truth_largest(vec3 a)
{
    return fmaxf(fabsf(a[0]), fmaxf(fabsf(a[1]), fabsf(a[2])));
}

// Fields in Embree's order: origin, least distance, direction, time, largest distance, mask, and its own two.
static struct RTCRay ray_make(vec3 o, vec3 d, float least, float most)
{
    return (struct RTCRay){o[0], o[1], o[2], least, d[0], d[1], d[2], 0.0f, most, UINT32_MAX, 0, 0};
}

// A ray's context as Embree hands it to the filter, which leaves out triangles by their numbers: no distance would do for all scales.
typedef struct Context {
    struct RTCIntersectContext embree; // first
    uint32_t skipped[2];
} Context;

static void leave_out(const struct RTCFilterFunctionNArguments *arguments)
{
    const Context *context = (const Context *)arguments->context;
    // The sixth of a hit's fields, each N values wide (N is 1 here); Embree's own accessor is C++ alone.
    uint32_t triangle = ((const uint32_t *)arguments->hit)[5 * (size_t)arguments->N];
    if (triangle == context->skipped[0] || triangle == context->skipped[1])
        arguments->valid[0] = 0;
}

static Context context_make(uint32_t skipped, uint32_t skipped_too)
{
    Context context = {.skipped = {skipped, skipped_too}};
    rtcInitIntersectContext(&context.embree);
    if (skipped != NO_TRIANGLE || skipped_too != NO_TRIANGLE)
        context.embree.filter = leave_out;
    return context;
}

Meeting truth_meet(const Truth *truth, vec3 origin, vec3 direction, float least, uint32_t skipped)
{
    Context context = context_make(skipped, NO_TRIANGLE);
    struct RTCRayHit ray = {.ray = ray_make(origin, direction, least, INFINITY),
                            .hit = {.geomID = RTC_INVALID_GEOMETRY_ID, .instID = {RTC_INVALID_GEOMETRY_ID}}};
    rtcIntersect1(truth->scene, &context.embree, &ray);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID)
        return (Meeting){.distance = INFINITY, .triangle = NO_TRIANGLE};
    return (Meeting){ray.ray.tfar, ray.hit.primID, ray.hit.u, ray.hit.v};
}

TruthHit truth_ray(const Truth *truth, vec3 origin, vec3 direction)
{
    Meeting met = truth_meet(truth, origin - truth->base, direction, 0.0f, NO_TRIANGLE);
    if (met.triangle == NO_TRIANGLE)
        return (TruthHit){.distance = INFINITY};
    double area;
    return (TruthHit){met.distance, met.triangle, truth_triangle_normal(truth, met.triangle, &area)};
}

static bool occluded(const Truth *truth, Context context, struct RTCRay ray)
{
    rtcOccluded1(truth->scene, &context.embree, &ray);
    return ray.tfar < 0.0f; // Embree's mark: −Inf
}

bool truth_between(const Truth *truth, vec3 from, vec3 to, float most, const uint32_t skipped[2])
{
    vec3 way = to - from;
    float length = vec3_length(way);
    float margin = fmaxf(0x1p-16f, 0x1p-21f * most / length); // share of the way; see truth.h
    if (!(length > 0.0f) || margin >= 0.5f)
        return false;
    return occluded(truth, context_make(skipped[0], skipped[1]), ray_make(from, way, margin, 1.0f - margin));
}

bool truth_beyond(const Truth *truth, vec3 from, vec3 direction, uint32_t skipped)
{
    return occluded(truth, context_make(skipped, NO_TRIANGLE), ray_make(from, direction, 0.0f, INFINITY));
}

bool truth_occluded(const Truth *truth, vec3 from, vec3 to)
{
    const uint32_t none[2] = {NO_TRIANGLE, NO_TRIANGLE};
    float most = fmaxf(truth_largest(from), truth_largest(to));
    return truth_between(truth, from - truth->base, to - truth->base, most, none);
}

static bool voxel_set(const uint32_t *voxels, const VoxelGrid *grid, const int voxel[3])
{
    for (int k = 0; k < 3; k++)
        if (voxel[k] < 0 || voxel[k] >= grid->size[k])
            return false;
    size_t i = ((size_t)voxel[2] * (size_t)grid->size[1] + (size_t)voxel[1]) * (size_t)grid->size[0] +
               (size_t)voxel[0];
    return voxels[i >> 5] >> (i & 31) & 1;
}

Mesh truth_voxel_mesh(const uint32_t *voxels, const VoxelGrid *grid)
{
    Mesh mesh = {0};
    if (grid_voxels(grid) > UINT32_MAX)
        fail_work("a mesh of voxels can number %" PRIu32 ", this grid has %zu", UINT32_MAX,
                  grid_voxels(grid));
    const uint32_t count = (uint32_t)grid_voxels(grid), width = (uint32_t)grid->size[0],
                   height = (uint32_t)grid->size[1];
    for (uint32_t i = 0; i < count; i++) {
        const int voxel[3] = {(int)(i % width), (int)(i / width % height), (int)(i / width / height)};
        for (int face = 0; face < 6 && voxel_set(voxels, grid, voxel); face++) {
            int axis = face / 2, side = face % 2, neighbour[3] = {voxel[0], voxel[1], voxel[2]};
            neighbour[axis] += side ? 1 : -1;
            if (voxel_set(voxels, grid, neighbour))
                continue;
            vec3 normal = {0}, position = {0};
            normal[axis] = side ? 1.0f : -1.0f;
            uint32_t corner[4];
            for (int c = 0; c < 4; c++) {
                int at[3] = {voxel[0], voxel[1], voxel[2]};
                at[axis] += side;
                at[(axis + 2 - side) % 3] += c == 1 || c == 2; // counter-clockwise, seen from outside
                at[(axis + 1 + side) % 3] += c >= 2;
                for (int k = 0; k < 3; k++)
                    position[k] = (float)(grid->origin[k] + at[k] * grid->voxel_size);
                corner[c] = mesh_add_vertex(&mesh, position, normal);
            }
            mesh_add_triangle(&mesh, corner[0], corner[1], corner[2], i);
            mesh_add_triangle(&mesh, corner[0], corner[2], corner[3], i);
        }
    }
    return mesh;
}

char *truth_cache_path(const char *what, uint64_t inputs, const char *ending)
{
    uint64_t key =
        hash_bytes(hash_bytes(HASH_START, source_hash, sizeof source_hash), &inputs, sizeof inputs);
    folder_make("out/truth");
    return text_format("out/truth/%s-%016" PRIx64 "%s", what, key, ending);
}

// Field by field, since padding and a vec3's last lane hold anything.
#define HASH(hash, field) hash_bytes(hash, &(field), sizeof(field))
static uint64_t hash_vec3(uint64_t hash, vec3 v)
{
    return hash_bytes(hash, &v, 3 * sizeof(float));
}

uint64_t truth_hash_scene(const Scene *scene)
{
    const Mesh *mesh = &scene->mesh;
    uint64_t hash = HASH(HASH(HASH_START, mesh->vertex_count), mesh->triangle_count);
    hash = hash_bytes(hash, mesh->positions, 3 * sizeof(float) * mesh->vertex_count);
    hash = hash_bytes(hash, mesh->normals, 3 * sizeof(float) * mesh->vertex_count);
    hash = hash_bytes(hash, mesh->indices, 3 * sizeof(uint32_t) * mesh->triangle_count);
    hash = hash_bytes(hash, mesh->triangle_material, sizeof(uint32_t) * mesh->triangle_count);
    hash = HASH(HASH(hash, scene->material_count), scene->light_count);
    for (size_t i = 0; i < scene->material_count; i++)
        hash = hash_vec3(hash_vec3(hash, scene->materials[i].albedo), scene->materials[i].emission);
    for (size_t i = 0; i < scene->light_count; i++) {
        const Light *light = &scene->lights[i];
        hash = hash_vec3(hash_vec3(hash_vec3(hash, light->position), light->direction), light->intensity);
        hash = HASH(HASH(HASH(hash, light->kind), light->half_angle_rad), light->radius);
    }
    const Camera *camera = &scene->camera;
    hash = hash_vec3(hash_vec3(hash_vec3(hash, camera->eye), camera->target), camera->up);
    hash = HASH(HASH(HASH(hash, camera->vertical_fov_rad), camera->near_distance), camera->far_distance);
    hash = hash_vec3(hash_vec3(hash, scene->medium.scattering), scene->medium.absorption);
    return HASH(hash, scene->medium.mean_cosine);
}
