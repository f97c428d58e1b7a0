// epipolar_voxels: what the tests of chapter 06's geometric voxelizations share: a mesh in a grid, its bits, and in plain double, by arc tangents and one plane after the
// other, which voxel a point is in and whether a voxel is touched. Shares no code with the chapter.
#ifndef EPIPOLAR_VOXELS_H
#define EPIPOLAR_VOXELS_H

#include "../chapters/06_epipolar_vsv/triangles.h"
#include "truth.h"

#include <criterion/criterion.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct VoxelBench {
    Scene scene;
    Camera camera;
    Light light;
    EpipolarFrame frame;
    EpipolarRange range;
    float *borders;
    bool squared;
    uint32_t *words;
    TrianglesCounts counts;
} VoxelBench;

static inline VoxelBench voxels_bench(vec3 eye, vec3 light, int alpha, int theta, int phi)
{
    gl_open(GL_PLATFORM_OSMESA, 16, 16, "test");
    return (VoxelBench){
        .camera = {.eye = eye,
                   .target = vec3_make(0.1f, -0.2f, -5),
                   .up = vec3_make(0, 1, 0),
                   .vertical_fov_rad = 1,
                   .near_distance = 0.01f},
        .light = {.kind = LIGHT_POINT, .position = light, .intensity = vec3_make(1, 1, 1)},
        .range = epipolar_range_full(alpha, theta, phi),
    };
}

static inline void voxels_add(VoxelBench *bench, vec3 a, vec3 b, vec3 c)
{
    const vec3 none = {0};
    Mesh *mesh = &bench->scene.mesh;
    const uint32_t first = mesh_add_vertex(mesh, a, none);
    mesh_add_triangle(mesh, first, mesh_add_vertex(mesh, b, none), mesh_add_vertex(mesh, c, none), 0);
}

static inline TrianglesGrid voxels_grid(VoxelBench *bench)
{
    bench->frame = epipolar_frame(&bench->camera, &bench->light);
    return (TrianglesGrid){&bench->frame, &bench->range, &bench->light, bench->borders, bench->squared};
}

// Voxelize bench->scene.mesh: bench->words.
static inline void voxels_fill(VoxelBench *bench, const TrianglesSettings *settings)
{
    const TrianglesGrid grid = voxels_grid(bench);
    const size_t bytes =
        (size_t)bench->range.alpha * (size_t)bench->range.theta * (size_t)bench->range.phi / 8;
    RasterMesh mesh = raster_mesh(&bench->scene);
    Triangles triangles = triangles_open(settings);
    const uint32_t none = (uint32_t)bench->range.alpha;
    GLuint words = gl_buffer(.label = "words", .bytes = bytes),
           first = gl_buffer(.label = "first", .bytes = bytes);
    gl.ClearNamedBufferData(first, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &none);
    triangles_aim(&triangles, &grid);
    triangles_list(&triangles, &mesh, &grid);
    triangles_fill(&triangles, &mesh, &grid, words, first);
    bench->counts = triangles.counted;
    free(bench->words);
    bench->words = memory_new(bytes, 1, "words");
    gl_buffer_read(words, 0, bytes, bench->words);
    gl_buffer_delete(&words);
    gl_buffer_delete(&first);
    triangles_close(&triangles);
    raster_mesh_delete(&mesh);
}

static inline void voxels_close(VoxelBench *bench)
{
    free(bench->scene.mesh.positions);
    free(bench->scene.mesh.normals);
    free(bench->scene.mesh.indices);
    free(bench->scene.mesh.triangle_material);
    free(bench->words);
    free(bench->borders);
    gl_close();
}

static inline bool voxels_get(const VoxelBench *bench, const int v[3])
{
    const size_t row = (size_t)bench->range.phi / 32;
    const size_t word = ((size_t)v[0] * (size_t)bench->range.theta + (size_t)v[1]) * row + (size_t)v[2] / 32;
    return bench->words[word] >> (v[2] & 31) & 1;
}
// Behind what is set: the scan along α, here voxel by voxel.
static inline void voxels_scan(VoxelBench *bench)
{
    const size_t row = (size_t)bench->range.theta * (size_t)bench->range.phi / 32;
    for (size_t i = row; i < row * (size_t)bench->range.alpha; i++)
        bench->words[i] |= bench->words[i - row];
}

// Borders of the voxels along a coordinate: α, θ, and φ or what takes its place under a directional light.
static inline double voxels_border(const VoxelBench *bench, int coordinate, int i)
{
    const EpipolarRange *r = &bench->range;
    if (coordinate == 0)
        return (double)r->alpha_least + ((double)r->alpha_most - (double)r->alpha_least) * i / r->alpha;
    if (coordinate == 1)
        return (double)r->theta_least +
               (double)r->theta_span * (bench->borders ? (double)bench->borders[i] : (double)i / r->theta);
    const double u = (double)i / r->phi;
    return (double)r->phi_least + ((double)r->phi_most - (double)r->phi_least) * (bench->squared ? u * u : u);
}

// The axes θ = 0, θ = π/2 and towards the light, in double, from the eye and the light themselves. Returns how far the light is.
static inline double voxels_axes(const VoxelBench *bench, double axes[3][3])
{
    double length = 0.0, along = 0.0, up_length = 0.0;
    for (int k = 0; k < 3; k++) {
        axes[2][k] = bench->frame.at_infinity
                         ? -(double)bench->light.direction[k]
                         : (double)bench->light.position[k] - (double)bench->camera.eye[k];
        length += axes[2][k] * axes[2][k];
    }
    const double distance = sqrt(length);
    for (int k = 0; k < 3; k++) {
        axes[2][k] = distance > 0.0 ? axes[2][k] / distance : (double)bench->frame.axis[k];
        along += axes[2][k] * (double)bench->frame.up[k];
    }
    for (int k = 0; k < 3; k++) {
        axes[0][k] = (double)bench->frame.up[k] - along * axes[2][k];
        up_length += axes[0][k] * axes[0][k];
    }
    for (int k = 0; k < 3; k++)
        axes[0][k] /= sqrt(up_length);
    for (int k = 0; k < 3; k++)
        axes[1][k] =
            axes[2][(k + 1) % 3] * axes[0][(k + 2) % 3] - axes[2][(k + 2) % 3] * axes[0][(k + 1) % 3];
    return bench->frame.at_infinity ? INFINITY : distance;
}

// A point as (x, y, z) along these axes.
static inline void voxels_local(const VoxelBench *bench, const double point[3], double out[3],
                                double *distance)
{
    double axes[3][3];
    *distance = voxels_axes(bench, axes);
    for (int a = 0; a < 3; a++) {
        out[a] = 0.0;
        for (int k = 0; k < 3; k++)
            out[a] += axes[a][k] * (point[k] - (double)bench->camera.eye[k]);
    }
}

// The point at `place` voxels along α, θ, φ (the law of sines); false where view ray and light ray do not meet.
static inline bool voxels_point(const VoxelBench *bench, const double place[3], double point[3])
{
    double angle[3], axes[3][3];
    for (int k = 0; k < 3; k++) {
        const int i = (int)place[k];
        const double from = voxels_border(bench, k, i);
        angle[k] = from + (place[k] - i) * (voxels_border(bench, k, i + 1) - from);
    }
    const double distance = voxels_axes(bench, axes);
    double beside = angle[2], forward = beside / tan(angle[0]);
    if (!bench->frame.at_infinity) {
        if (angle[0] + angle[2] >= M_PI)
            return false; // beyond infinity
        const double way = distance * sin(angle[2]) / sin(angle[0] + angle[2]);
        beside = way * sin(angle[0]);
        forward = way * cos(angle[0]);
    }
    for (int k = 0; k < 3; k++)
        point[k] = (double)bench->camera.eye[k] + forward * axes[2][k] +
                   beside * (cos(angle[1]) * axes[0][k] + sin(angle[1]) * axes[1][k]);
    return true;
}

// The point's coordinates in voxels (the integer part is the voxel).
static inline void voxels_place(const VoxelBench *bench, const double point[3], double place[3])
{
    double p[3], distance;
    voxels_local(bench, point, p, &distance);
    const double beside = hypot(p[0], p[1]);
    double value[3] = {atan2(beside, p[2]), atan2(p[1], p[0]),
                       bench->frame.at_infinity ? beside : atan2(beside, distance - p[2])};
    const double from_least = value[1] - (double)bench->range.theta_least;
    value[1] -= 2.0 * M_PI * floor(from_least / (2.0 * M_PI));
    for (int k = 0; k < 3; k++) {
        const int count = k == 0 ? bench->range.alpha : k == 1 ? bench->range.theta : bench->range.phi;
        int i = 0;
        while (i < count && voxels_border(bench, k, i + 1) <= value[k])
            i++;
        const double from = voxels_border(bench, k, i);
        place[k] = i + (value[k] - from) / (i < count ? voxels_border(bench, k, i + 1) - from : 1.0);
    }
}

// Whether a triangle reaches the voxel, grown by `grow` radians or metres on each side: all of it is cut by planes that enclose the voxel: two half-planes θ, and, of
// each cone, the plane that touches it along the slice's middle (from outside) or that joins its ends (from inside).
static inline bool voxels_touch(const VoxelBench *bench, const float triangle[9], const int v[3], double grow)
{
    double polygon[16][3], distance = 0.0;
    int count = 3;
    for (int i = 0; i < 3; i++) {
        const double p[3] = {(double)triangle[3 * i], (double)triangle[3 * i + 1],
                             (double)triangle[3 * i + 2]};
        voxels_local(bench, p, polygon[i], &distance);
    }
    const double t0 = voxels_border(bench, 1, v[1]) - grow, t1 = voxels_border(bench, 1, v[1] + 1) + grow;
    const double middle = 0.5 * (t0 + t1), inner = cos(0.5 * (t1 - t0));
    double planes[6][4] = {{-sin(t0), cos(t0), 0, 0}, {sin(t1), -cos(t1), 0, 0}};
    for (int k = 0; k < 2; k++) {
        const double from = voxels_border(bench, 2 * k, v[2 * k]) - grow,
                     to = voxels_border(bench, 2 * k, v[2 * k] + 1) + grow;
        for (int end = 0; end < 2; end++) {
            const double angle = end ? to : from, sign = end ? -1.0 : 1.0;
            double *plane = planes[2 + 2 * k + end];
            if (k == 1 && bench->frame.at_infinity) {
                // r is at least inner · distance and at most the distance
                plane[0] = sign * cos(middle);
                plane[1] = sign * sin(middle);
                plane[3] = end ? to : -from * inner;
                continue;
            }
            if (end ? angle >= M_PI : angle <= 0.0 || (k == 0 && v[0] == 0)) {
                plane[3] = 1.0;
                continue;
            }
            // beyond `from`: distance · cos ≥ along · sin, and the distance is r to r / inner
            const double cosine = cos(angle), wide = (cosine > 0.0) == (end == 0) ? 1.0 / inner : 1.0;
            plane[0] = sign * cosine * wide * cos(middle);
            plane[1] = sign * cosine * wide * sin(middle);
            plane[2] = sign * (k == 0 ? -sin(angle) : sin(angle));
            plane[3] = k == 0 ? 0.0 : -sign * sin(angle) * distance;
        }
    }
    for (int k = 0; k < 6; k++) {
        double kept[16][3];
        int kept_count = 0;
        for (int i = 0; i < count; i++) {
            const double *a = polygon[i], *b = polygon[(i + 1) % count];
            double side[2];
            for (int e = 0; e < 2; e++) {
                const double *p = e ? b : a;
                side[e] =
                    planes[k][0] * p[0] + planes[k][1] * p[1] + planes[k][2] * p[2] + planes[k][3] + 1e-13;
            }
            if (side[0] >= 0.0)
                memcpy(kept[kept_count++], a, sizeof kept[0]);
            if ((side[0] < 0.0) != (side[1] < 0.0)) {
                for (int c = 0; c < 3; c++)
                    kept[kept_count][c] = a[c] + side[0] / (side[0] - side[1]) * (b[c] - a[c]);
                kept_count++;
            }
        }
        memcpy(polygon, kept, sizeof polygon);
        count = kept_count;
    }
    return count > 0;
}

#endif
