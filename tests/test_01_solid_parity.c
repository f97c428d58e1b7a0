// Solids of chapter 01 at every centre of a grid against the parity of Embree's rays, which shares nothing with them.
#include "solid_bench.h"

#include <embree3/rtcore.h>

// All the surface along a ray: how often it is crossed, and whether one crossing lies so near an edge, or so flat, that it may be seen
// twice or not at all.
typedef struct Crossings {
    struct RTCIntersectContext context; // first: Embree hands it back
    unsigned count;
    bool doubtful;
} Crossings;

// Barycentric coordinates of a hit carry errors of some 1e-6 of float32 here (coordinates of a few hundred steps of 2^-24, triangles
// of a voxel); sines of flat hits likewise. Both with room of a hundred. A ray in doubt is asked again in another direction.
static const float NEAR_EDGE = 1e-4f, FLAT = 1e-3f;

static void count_crossing(const struct RTCFilterFunctionNArguments *arguments)
{
    Crossings *crossings = (Crossings *)arguments->context;
    const struct RTCRay *ray = (const struct RTCRay *)arguments->ray;
    const struct RTCHit *hit = (const struct RTCHit *)arguments->hit;
    vec3 normal = vec3_make(hit->Ng_x, hit->Ng_y, hit->Ng_z),
         way = vec3_make(ray->dir_x, ray->dir_y, ray->dir_z);
    float sine = fabsf(vec3_dot(normal, way)) / (vec3_length(normal) * vec3_length(way));
    crossings->count++;
    if (fminf(fminf(hit->u, hit->v), 1.0f - hit->u - hit->v) < NEAR_EDGE || !(sine > FLAT))
        crossings->doubtful = true;
    arguments->valid[0] = 0; // go on
}

static RTCScene open_rays(const Mesh *mesh, const VoxelGrid *grid)
{
    RTCDevice device = rtcNewDevice(NULL);
    RTCScene scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    float *positions = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12,
                                               mesh->vertex_count);
    void *indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12,
                                            mesh->triangle_count);
    // in voxels: rays start at centres, which are exact
    for (size_t i = 0; i < 3 * mesh->vertex_count; i++)
        positions[i] = (float)(((double)mesh->positions[i] - grid->origin[i % 3]) / grid->voxel_size);
    memcpy(indices, mesh->indices, 12 * mesh->triangle_count);
    rtcSetGeometryIntersectFilterFunction(geometry, count_crossing);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);
    rtcReleaseDevice(device);
    return scene;
}

static const float directions[][3] = {
    {0.36f, 0.48f, 0.8f},    {-0.61f, 0.23f, 0.71f}, {0.13f, -0.94f, 0.29f},  {0.83f, -0.19f, -0.51f},
    {-0.27f, -0.33f, -0.9f}, {0.05f, 0.71f, -0.7f},  {-0.91f, -0.37f, 0.17f}, {0.53f, 0.63f, -0.57f},
    {-0.47f, 0.87f, 0.15f},  {0.67f, -0.59f, 0.45f}};
enum { DIRECTIONS = sizeof directions / sizeof *directions };

// The directions tried; 0: none was beyond doubt.
static int ray_parity(RTCScene scene, const float from[3], bool *inside)
{
    for (int i = 0; i < DIRECTIONS; i++) {
        const float *d = directions[i];
        Crossings crossings = {.count = 0};
        rtcInitIntersectContext(&crossings.context);
        struct RTCRayHit ray = {
            .ray = {from[0], from[1], from[2], 0, d[0], d[1], d[2], 0, INFINITY, UINT32_MAX, 0, 0},
            .hit = {.geomID = RTC_INVALID_GEOMETRY_ID}};
        rtcIntersect1(scene, &crossings.context, &ray);
        if (crossings.doubtful)
            continue;
        *inside = crossings.count & 1;
        return i + 1;
    }
    return 0;
}

// Distance of a point and a triangle in double (Ericson 2005, section 5.1.5, by clamped projections): the least of the plane's, where its
// foot lies inside, and the three edges'.
static double distance_to(const double p[3][3], const double point[3])
{
    double least = INFINITY, normal[3], area = 0, off = 0, e[3][3];
    for (int v = 0; v < 3; v++) {
        double along = 0, length = 0, squared = 0;
        for (int k = 0; k < 3; k++) {
            e[v][k] = p[(v + 1) % 3][k] - p[v][k];
            along += e[v][k] * (point[k] - p[v][k]);
            length += e[v][k] * e[v][k];
        }
        double t = fmin(fmax(along / length, 0), 1);
        for (int k = 0; k < 3; k++)
            squared += pow(point[k] - p[v][k] - t * e[v][k], 2);
        least = fmin(least, sqrt(squared));
    }
    for (int k = 0; k < 3; k++) {
        normal[k] = e[0][(k + 1) % 3] * e[1][(k + 2) % 3] - e[0][(k + 2) % 3] * e[1][(k + 1) % 3];
        area += normal[k] * normal[k];
        off += normal[k] * (point[k] - p[0][k]);
    }
    bool inside = true;
    for (int v = 0; v < 3; v++) {
        double side = 0;
        for (int k = 0; k < 3; k++)
            side += normal[k] * (e[v][(k + 1) % 3] * (point[(k + 2) % 3] - p[v][(k + 2) % 3]) -
                                 e[v][(k + 2) % 3] * (point[(k + 1) % 3] - p[v][(k + 1) % 3]));
        inside = inside && side >= 0;
    }
    return inside ? fabs(off) / sqrt(area) : least;
}

// In voxels, to the nearest of all triangles.
static double surface_distance(const Mesh *mesh, const VoxelGrid *grid, const float at[3])
{
    double least = INFINITY, point[3] = {(double)at[0], (double)at[1], (double)at[2]};
    for (size_t i = 0; i < mesh->triangle_count; i++) {
        double p[3][3];
        for (int v = 0; v < 3; v++)
            for (int k = 0; k < 3; k++)
                p[v][k] = ((double)mesh->positions[3 * (size_t)mesh->indices[3 * i + (size_t)v] + (size_t)k] -
                           grid->origin[k]) /
                          grid->voxel_size;
        least = fmin(least, distance_to(p, point));
    }
    return least;
}

// Every centre: the same answer, unless the centre lies within 1e-3 voxel of the surface.
static void judge(const Scene *scene, int resolution, bool everything)
{
    VoxelGrid grid = scene_grid(scene, resolution);
    Filled filled = solid_bench_fill(scene, &grid, everything, 0);
    RTCScene rays = open_rays(&scene->mesh, &grid);
    long wrong = 0, near = 0, undecided = 0, again = 0, set = 0, agreed = 0;
    for (int z = 0; z < grid.size[2]; z++)
        for (int y = 0; y < grid.size[1]; y++)
            for (int x = 0; x < grid.size[0]; x++) {
                const float at[3] = {(float)x + 0.5f, (float)y + 0.5f, (float)z + 0.5f};
                bool inside = false;
                int tried = ray_parity(rays, at, &inside);
                again += tried > 1;
                if (tried > 0 && inside == filled_at(&filled, x, y, z)) {
                    set += inside;
                    agreed++;
                    continue;
                }
                bool close = surface_distance(&scene->mesh, &grid, at) <= 1e-3;
                near += close;
                wrong += !close && tried > 0;
                undecided += !close && tried == 0;
            }
    cr_assert_eq(wrong, 0, "%ld voxels are wrong (%ld agree, %ld inside)", wrong, agreed, set);
    cr_assert_eq(undecided, 0, "%ld centres have no ray beyond doubt", undecided);
    // a thousandth of a voxel on each side of some 3e4 of surface; only those that differ are counted here
    cr_assert(near <= 60, "%ld centres on the surface are not judged", near);
    cr_assert(again > 0 && set > 1000, "%ld rays asked again, %ld voxels inside", again, set);
    rtcReleaseScene(rays);
    filled_free(&filled);
}

Test(solid_parity, bunny_is_right_at_every_centre, .timeout = 120)
{
    gl_open(GL_PLATFORM_OSMESA, 16, 16, "test");
    Scene *scene = scene_open("bunny", 1);
    judge(scene, 128, false);
    scene_close(scene);
}

Test(solid_parity, overlapping_balls_are_right_at_every_centre, .timeout = 120)
{
    gl_open(GL_PLATFORM_OSMESA, 16, 16, "test");
    Scene *scene = solid_bench_scene(make_balls);
    judge(scene, 48, true);
    scene_close(scene);
}
