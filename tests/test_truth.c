// Embree's rays against closed forms, the mesh of voxels against counts and the divergence theorem, the cache's keys.
#include "truth.h"

#include <criterion/criterion.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static double uniform(uint32_t *state) // xorshift32 (Marsaglia 2003) in [0, 1)
{
    *state ^= *state << 13;
    *state ^= *state >> 17;
    *state ^= *state << 5;
    return *state / 4294967296.0;
}

static vec3 random_point(uint32_t *state, float half_side)
{
    float p[3];
    for (int k = 0; k < 3; k++)
        p[k] = (float)(2.0 * uniform(state) - 1.0) * half_side;
    return vec3_make(p[0], p[1], p[2]);
}

static void mesh_clear(Mesh *mesh)
{
    free(mesh->positions);
    free(mesh->normals);
    free(mesh->indices);
    free(mesh->triangle_material);
    *mesh = (Mesh){0};
}

// Slabs in double: distance to the box [−half, half]³ from outside or inside, +Inf for a miss; *crossing is the length inside.
static double box_distance(vec3 origin, vec3 direction, double half, double *crossing, int *axis)
{
    double enter = -INFINITY, leave = INFINITY;
    int enter_axis = 0, leave_axis = 0;
    for (int k = 0; k < 3; k++) {
        double a = (-half - origin[k]) / direction[k], b = (half - origin[k]) / direction[k];
        if (fmin(a, b) > enter)
            enter = fmin(a, b), enter_axis = k;
        if (fmax(a, b) < leave)
            leave = fmax(a, b), leave_axis = k;
    }
    *crossing = fmin(leave - enter, leave);
    *axis = enter > 0.0 ? enter_axis : leave_axis;
    return leave < 0.0 || enter > leave ? INFINITY : enter > 0.0 ? enter : leave;
}

Test(truth_ray, box_closed_form_at_every_scale)
{
    const float halves[3] = {1e-6f, 1.0f, 1e6f};
    for (int scale = 0; scale < 3; scale++) {
        float half = halves[scale];
        Mesh mesh = {0};
        mesh_add_box(&mesh, vec3_make(-half, -half, -half), vec3_make(half, half, half), 0);
        Truth *truth = truth_open(&mesh);
        uint32_t state = 11;
        int hits = 0, misses = 0;
        for (int i = 0; i < 20000; i++) {
            vec3 origin = random_point(&state, 3.0f * half),
                 direction = vec3_normalize(random_point(&state, 1.0f));
            double crossing;
            int axis;
            double expected = box_distance(origin, direction, half, &crossing, &axis);
            if (fabs(crossing) < 1e-4 * half) // grazing an edge: which way float32 decides is no error
                continue;
            TruthHit hit = truth_ray(truth, origin, direction);
            if (isinf(expected)) {
                misses++;
                cr_assert(isinf(hit.distance), "a ray beside the box of %g m hits at %g", half,
                          (double)hit.distance);
                continue;
            }
            hits++;
            // 2·10⁻⁶: float32 rounding, 6·10⁻⁸ of coordinates up to 3 half sides, a few times, over cosines that seldom are small …
            double cosine = fabs((double)direction[axis]), tolerance = 2e-6 * half / fmax(cosine, 1e-3);
            cr_assert(fabs(hit.distance - expected) < tolerance, "%g m: distance %.9g, not %.9g", half,
                      (double)hit.distance, expected);
            // … and near an edge of the box the other side may be hit as well.
            if (fabsf(origin[axis] + hit.distance * direction[axis]) > 0.999f * half)
                cr_assert(fabsf(fabsf(hit.normal[0]) + fabsf(hit.normal[1]) + fabsf(hit.normal[2]) - 1.0f) <
                              1e-6f,
                          "a box's normals are unit axes");
            vec3 at = origin + hit.distance * direction;
            cr_assert(vec3_dot(at, hit.normal) > 0.0f, "the normal points out of the box");
        }
        cr_assert(hits > 2000 && misses > 2000, "%d hits, %d misses are too few", hits, misses);
        truth_close(truth);
        mesh_clear(&mesh);
    }
}

// A unit sphere of flat triangles lies between 1 and its nearest plane, whose distance is the cosine of the largest normal error.
Test(truth_ray, sphere_within_its_chord_error_and_without_cracks)
{
    enum { ROWS = 48, COLUMNS = 96 };
    Mesh mesh = {0};
    for (int row = 0; row <= ROWS; row++)
        for (int column = 0; column <= COLUMNS; column++) {
            double polar = M_PI * row / ROWS, around = 2.0 * M_PI * (column % COLUMNS) / COLUMNS;
            vec3 p = vec3_make((float)(sin(polar) * sin(around)), (float)cos(polar),
                               (float)(sin(polar) * cos(around)));
            mesh_add_vertex(&mesh, p, p);
        }
    for (uint32_t row = 0; row < ROWS; row++)
        for (uint32_t column = 0; column < COLUMNS; column++) {
            uint32_t a = row * (COLUMNS + 1) + column, b = a + COLUMNS + 1;
            if (row > 0)
                mesh_add_triangle(&mesh, a, b, a + 1, 0);
            if (row < ROWS - 1)
                mesh_add_triangle(&mesh, a + 1, b, b + 1, 0);
        }
    // Circumradius of a triangle of this sphere: at most half the diagonal of the largest cell, π/ROWS and 2π/COLUMNS long.
    double half_diagonal = 0.5 * hypot(M_PI / ROWS, 2.0 * M_PI / COLUMNS), nearest = cos(half_diagonal);
    Truth *truth = truth_open(&mesh);
    uint32_t state = 5;
    for (int i = 0; i < 20000; i++) {
        // At points inside and, every other time, exactly through a vertex or the middle of an edge, where cracks would be.
        vec3 target = random_point(&state, 0.5f), origin = 3.0f * vec3_normalize(random_point(&state, 1.0f));
        if (i % 2) {
            uint32_t triangle = (uint32_t)(uniform(&state) * (double)mesh.triangle_count),
                     a = mesh.indices[3 * triangle], b = mesh.indices[3 * triangle + (uint32_t)(i / 2) % 3];
            const float *p = mesh.positions + 3 * (size_t)a, *q = mesh.positions + 3 * (size_t)b;
            target = 0.5f * (vec3_make(p[0], p[1], p[2]) + vec3_make(q[0], q[1], q[2]));
            origin = 3.0f * vec3_normalize(target);
        }
        vec3 direction = vec3_normalize(target - origin);
        TruthHit hit = truth_ray(truth, origin, direction);
        cr_assert(isfinite(hit.distance), "ray %d slips through", i);
        vec3 at = origin + hit.distance * direction;
        double radius = vec3_length(at), cosine = vec3_dot(at, hit.normal) / radius;
        // 2·10⁻⁶: float32 rounding of positions up to 3.
        cr_assert(radius > nearest - 2e-6 && radius < 1.0 + 2e-6, "hit at radius %.7f, not in [%.7f, 1]",
                  radius, nearest);
        cr_assert(cosine > nearest - 2e-6, "normal off by more than a chord's: %.7f", cosine);
        cr_assert(fabs((double)vec3_length(hit.normal) - 1.0) < 1e-6, "the normal is not unit");
    }
    truth_close(truth);
    mesh_clear(&mesh);
}

Test(truth_ray, sliver_normal_and_empty_mesh)
{
    // Aspect 10⁶ in the plane x + y + z = 2^-3 + 2: all coordinates exact, normal (1, 1, 1)/√3.
    Mesh mesh = {0};
    vec3 a = vec3_make(1, 1, 0.125f), b = vec3_make(-1, 2, 1.125f),
         c = vec3_make(0x1p-20f, 1.5f, 0.625f - 0x1p-20f);
    mesh_add_triangle(&mesh, mesh_add_vertex(&mesh, a, a), mesh_add_vertex(&mesh, b, b),
                      mesh_add_vertex(&mesh, c, c), 0);
    Truth *truth = truth_open(&mesh);
    vec3 middle = (a + b + c) / 3.0f, direction = vec3_normalize(vec3_make(-1, -1, -1));
    TruthHit hit = {.distance = INFINITY};
    for (int i = -20; i <= 20 && isinf(hit.distance);
         i++) // the middle is rounded by as much as the sliver is wide
        hit = truth_ray(truth, middle - 2.0f * direction + vec3_make((float)i * 0x1p-23f, 0, 0), direction);
    cr_assert(isfinite(hit.distance), "no ray hits the sliver");
    for (int k = 0; k < 3;
         k++) // 10⁻⁷: one float32 rounding of 0.577; a float32 cross product errs by 0.01 and more
        cr_assert(fabs(fabs((double)hit.normal[k]) - 1.0 / sqrt(3.0)) < 1e-7, "normal %d is %g", k,
                  (double)hit.normal[k]);
    truth_close(truth);
    mesh_clear(&mesh);

    truth = truth_open(&(Mesh){0});
    cr_assert(isinf(truth_ray(truth, vec3_make(0, 0, 0), vec3_make(0, 0, 1)).distance),
              "the empty mesh is hit");
    cr_assert(!truth_occluded(truth, vec3_make(0, 0, 0), vec3_make(0, 0, 1)), "the empty mesh occludes");
    truth_close(truth);
}

Test(truth_occluded, open_segment)
{
    const struct {
        float away, from, to; // x; z of both ends
        bool expected;
        const char *what;
    } cases[] = {
        {0, 1, -1, true, "through the wall"},
        {0, -1, 1, true, "through its back"},
        {0, 1, 0.5f, false, "before the wall"},
        {0, 1, 0, false, "ends on the wall"},
        {0, 0, 1, false, "starts on the wall"},
        {0, 0, 0, false, "has no length"},
        {0, -0x1p-17f, 1, false, "starts within 2^-16 of its length behind the wall"},
        {0, -0x1p-15f, 1, true, "starts 2^-15 of its length behind the wall"},
        {0x1p20f, -0.25f, 8, false, "starts within four units in the last place of x behind the wall"},
        {0x1p20f, -1, 8, true, "starts eight units in the last place of x behind the wall"},
        {3, 1, -1, false, "beside the wall"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        Mesh mesh = {0};
        float wall = cases[i].away > 100.0f ? cases[i].away : 0.0f;
        mesh_add_quad(&mesh, vec3_make(wall - 1.0f, -1, 0), vec3_make(2, 0, 0), vec3_make(0, 2, 0), 0);
        Truth *truth = truth_open(&mesh);
        vec3 from = vec3_make(cases[i].away + 0.25f, 0.125f, cases[i].from),
             to = vec3_make(from[0], from[1], cases[i].to);
        cr_assert_eq(truth_occluded(truth, from, to), cases[i].expected, "a segment that %s", cases[i].what);
        cr_assert_eq(truth_occluded(truth, to, from), cases[i].expected, "the other way round: %s",
                     cases[i].what);
        truth_close(truth);
        mesh_clear(&mesh);
    }
}

typedef struct Edge {
    long low, high;
    int direction; // ±1
} Edge;

static int compare_edges(const void *left, const void *right)
{
    const Edge *a = left, *b = right;
    return a->low != b->low ? (a->low > b->low) - (a->low < b->low)
                            : (a->high > b->high) - (a->high < b->high);
}

// Faces, area, enclosed volume (divergence theorem: only right if every face turns outwards), closedness and materials of a voxel mesh.
static void check_voxel_mesh(const VoxelGrid *grid, const uint32_t *voxels, long expected_faces,
                             long expected_voxels)
{
    Mesh mesh = truth_voxel_mesh(voxels, grid);
    double area = 0.0, volume = 0.0, h = grid->voxel_size;
    size_t edge_count = 3 * mesh.triangle_count;
    Edge *edges = memory_new(edge_count, sizeof *edges, "edges");
    for (size_t t = 0; t < mesh.triangle_count; t++) {
        double p[3][3], n[3];
        long node[3];
        for (int v = 0; v < 3; v++) {
            for (int k = 0; k < 3; k++)
                p[v][k] = mesh.positions[3 * mesh.indices[3 * t + (size_t)v] + (uint32_t)k];
            node[v] = 0;
            for (int k = 2; k >= 0; k--) {
                double steps = (p[v][k] - grid->origin[k]) / h;
                cr_assert(steps == rint(steps), "a corner lies off the grid by %g voxels",
                          steps - rint(steps));
                node[v] = node[v] * (grid->size[k] + 1) + lrint(steps);
            }
        }
        const float *given = mesh.normals + 3 * (size_t)mesh.indices[3 * t];
        long voxel = mesh.triangle_material[t],
             place[3] = {voxel % grid->size[0], voxel / grid->size[0] % grid->size[1],
                         voxel / grid->size[0] / grid->size[1]};
        cr_assert(voxels[voxel >> 5] >> (voxel & 31) & 1, "a face belongs to an empty voxel");
        for (int k = 0; k < 3; k++) {
            int a = (k + 1) % 3, b = (k + 2) % 3;
            n[k] = (p[1][a] - p[0][a]) * (p[2][b] - p[0][b]) - (p[1][b] - p[0][b]) * (p[2][a] - p[0][a]);
            cr_assert_eq(n[k], given[k] * h * h, "the normal is not the triangle's own");
            volume += n[k] * (p[0][k] - grid->origin[k]) / 6.0;
            area += fabs(n[k]) / 2.0;
            for (int v = 0; v < 3 && given[k] != 0.0f; v++) // the face is its voxel's own
                cr_assert_eq(p[v][k], grid->origin[k] + (double)(place[k] + (given[k] > 0.0f)) * h,
                             "a face of another voxel");
        }
        for (int v = 0; v < 3; v++) {
            long a = node[v], b = node[(v + 1) % 3];
            edges[3 * t + (size_t)v] = (Edge){a < b ? a : b, a < b ? b : a, a < b ? 1 : -1};
        }
    }
    cr_assert_eq((long)mesh.triangle_count, 2 * expected_faces, "%zu triangles for %ld faces",
                 mesh.triangle_count, expected_faces);
    // Exact sums: all numbers are multiples of h³/6 or h²/2 with h a power of two.
    cr_assert_eq(area, (double)expected_faces * h * h, "area %g of %ld faces", area, expected_faces);
    cr_assert(fabs(volume - (double)expected_voxels * h * h * h) < 1e-9, "volume %g of %ld voxels", volume,
              expected_voxels);
    qsort(edges, edge_count, sizeof *edges, compare_edges);
    for (size_t i = 0, next; i < edge_count; i = next) {
        int sum = 0;
        for (next = i; next < edge_count && compare_edges(&edges[i], &edges[next]) == 0; next++)
            sum += edges[next].direction;
        cr_assert((next - i) % 2 == 0 && sum == 0, "an edge is passed %zu times, %d one way", next - i, sum);
    }
    free(edges);
    mesh_clear(&mesh);
}

Test(truth_voxel_mesh, closed_outward_and_of_known_area)
{
    const VoxelGrid grid = {{-3.0, 10.0, 0.5}, 0.25, {7, 5, 6}};
    long count = 7 * 5 * 6;
    uint32_t voxels[7] = {0}, state = 9;
    check_voxel_mesh(&grid, voxels, 0, 0);
    voxels[3] = 1u << 26; // (3, 2, 3), inside
    check_voxel_mesh(&grid, voxels, 6, 1);
    for (long i = 0; i < count; i++) // the whole block
        voxels[i >> 5] |= 1u << (i & 31);
    check_voxel_mesh(&grid, voxels, 2 * (7 * 5 + 5 * 6 + 6 * 7), count);
    voxels[3] &= ~(1u << 26); // with a hole
    check_voxel_mesh(&grid, voxels, 2 * (7 * 5 + 5 * 6 + 6 * 7) + 6, count - 1);
    memset(voxels, 0, sizeof voxels);
    long set = 0, contacts = 0, strides[3] = {1, 7, 35};
    for (long i = 0; i < count; i++)
        if (uniform(&state) < 0.4) {
            voxels[i >> 5] |= 1u << (i & 31);
            set++;
            for (int k = 0; k < 3; k++) {
                long before = i - strides[k];
                contacts += i / strides[k] % grid.size[k] > 0 && (voxels[before >> 5] >> (before & 31) & 1);
            }
        }
    check_voxel_mesh(&grid, voxels, 6 * set - 2 * contacts, set);
}

Test(truth_cache, key_changes_with_every_input)
{
    char folder[] = "/tmp/truth_cache_XXXXXX";
    cr_assert(mkdtemp(folder) != NULL && chdir(folder) == 0, "no temporary folder");
    char *paths[4] = {
        truth_cache_path("voxels_bunny", 1, ".exr"), truth_cache_path("voxels_bunny", 2, ".exr"),
        truth_cache_path("voxels_fence", 1, ".exr"), truth_cache_path("voxels_bunny", 1, ".exr")};
    cr_assert(strncmp(paths[0], "out/truth/voxels_bunny-", 23) == 0 && strlen(paths[0]) == 23 + 16 + 4,
              "path %s", paths[0]);
    cr_assert_eq(strspn(paths[0] + 23, "0123456789abcdef"), 16, "path %s", paths[0]);
    cr_assert_eq(strcmp(paths[0] + 39, ".exr"), 0, "path %s", paths[0]);
    cr_assert(strcmp(paths[0], paths[1]) != 0 && strcmp(paths[0], paths[2]) != 0,
              "other inputs, the same path");
    cr_assert_eq(strcmp(paths[0], paths[3]), 0, "the same inputs, other paths");
    cr_assert_eq(access("out/truth", W_OK), 0, "the folder is not made");
    cr_assert(rmdir("out/truth") == 0 && rmdir("out") == 0 && rmdir(folder) == 0,
              "the temporary folder stays");
    for (int i = 0; i < 4; i++)
        free(paths[i]);
}

Test(truth_cache, scene_hash_knows_every_field)
{
    Scene scene = {0};
    mesh_add_box(&scene.mesh, vec3_make(-1, -1, -1), vec3_make(1, 2, 3), 0);
    uint32_t last = (uint32_t)scene.mesh.vertex_count - 1, final = (uint32_t)scene.mesh.triangle_count - 1;
    Material materials[2] = {{.albedo = {0.5f, 0.4f, 0.3f}}, {.emission = {1, 2, 3}}};
    Light lights[2] = {{.kind = LIGHT_POINT, .intensity = {1, 1, 1}},
                       {.kind = LIGHT_SPOT, .half_angle_rad = 0.5f}};
    scene.materials = materials;
    scene.material_count = 2;
    scene.lights = lights;
    scene.light_count = 2;
    scene.camera = (Camera){.eye = {0, 0, 5}, .up = {0, 1, 0}, .vertical_fov_rad = 0.7f};
    Material *m = &materials[1];
    Light *l = &lights[1];
    Camera *c = &scene.camera;
    Medium *d = &scene.medium;
#define LANES(v) (float *)&(v), (float *)&(v) + 1, (float *)&(v) + 2
    void *fields[] = {&scene.mesh.positions[0],
                      &scene.mesh.positions[3 * last + 2],
                      &scene.mesh.normals[3 * last + 2],
                      &scene.mesh.indices[3 * final + 2],
                      &scene.mesh.triangle_material[final],
                      LANES(m->albedo),
                      LANES(m->emission),
                      &l->kind,
                      LANES(l->position),
                      LANES(l->direction),
                      LANES(l->intensity),
                      &l->half_angle_rad,
                      &l->radius,
                      LANES(c->eye),
                      LANES(c->target),
                      LANES(c->up),
                      &c->vertical_fov_rad,
                      &c->near_distance,
                      &c->far_distance,
                      LANES(d->scattering),
                      LANES(d->absorption),
                      &d->mean_cosine};
    const uint64_t hash = truth_hash_scene(&scene);
    for (size_t i = 0; i < sizeof fields / sizeof *fields; i++) {
        *(unsigned char *)fields[i] ^= 1; // the least bit there is
        cr_assert_neq(truth_hash_scene(&scene), hash, "field %zu does not change the hash", i);
        *(unsigned char *)fields[i] ^= 1;
    }
    size_t *counts[] = {&scene.mesh.triangle_count, &scene.material_count, &scene.light_count};
    for (int i = 0; i < 3; i++) {
        --*counts[i];
        cr_assert_neq(truth_hash_scene(&scene), hash, "count %d does not change the hash", i);
        ++*counts[i];
    }
    // What no picture depends on: names, capacities, a vec3's last lane.
    scene.name = materials[0].name = (char *)"other";
    scene.mesh.vertex_capacity++;
    m->albedo[3] = l->position[3] = c->eye[3] = d->scattering[3] = 7.0f;
    cr_assert_eq(truth_hash_scene(&scene), hash, "padding changes the hash");
    mesh_clear(&scene.mesh);
}
