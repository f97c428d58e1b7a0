// solid_mesh: what a mesh's triangles and edges say about its inside, before any voxel. The rule stands in solid.h.
#include "solid.h"
#include <stdlib.h>
#include <string.h>

// A triangle by its corners in space, turned so that the least comes first: a turn keeps the winding.
typedef struct Face {
    uint32_t corner[3]; // numbers of places
    uint32_t vertex[3];
} Face;

// Of the corners alone, whichever way they wind: 0 least, 1 and 2 in their order.
static int by_corners(const Face *f, const Face *g)
{
    const uint32_t *p = f->corner, *q = g->corner;
    const uint32_t f_order[] = {p[0], p[1] < p[2] ? p[1] : p[2], p[1] < p[2] ? p[2] : p[1]};
    const uint32_t g_order[] = {q[0], q[1] < q[2] ? q[1] : q[2], q[1] < q[2] ? q[2] : q[1]};
    for (int k = 0; k < 3; k++)
        if (f_order[k] != g_order[k])
            return f_order[k] < g_order[k] ? -1 : 1;
    return 0;
}

// A triangle comes next to those that repeat it, and these next to those of the same corners wound the other way.
static int by_corners_and_winding(const void *a, const void *b)
{
    const Face *f = a, *g = b;
    int order = by_corners(f, g), winding = f->corner[1] < f->corner[2], other = g->corner[1] < g->corner[2];
    return order != 0 ? order : winding - other;
}

// Sorted, each once; *count becomes how many are left. Which copy stays makes no difference: only corners count.
static Face *unique_faces(const Mesh *mesh, size_t *count)
{
    Face *faces = memory_new(mesh->triangle_count + 1, sizeof *faces, "the triangles of a solid");
    uint32_t *number = mesh_places(mesh);
    for (size_t i = 0; i < mesh->triangle_count; i++) {
        const uint32_t *index = mesh->indices + 3 * i;
        size_t least = 0;
        for (size_t k = 1; k < 3; k++)
            least = number[index[k]] < number[index[least]] ? k : least;
        for (size_t k = 0; k < 3; k++) {
            faces[i].vertex[k] = index[(least + k) % 3];
            faces[i].corner[k] = number[faces[i].vertex[k]];
        }
    }
    free(number);
    qsort(faces, mesh->triangle_count, sizeof *faces, by_corners_and_winding);
    *count = 0;
    for (size_t i = 0; i < mesh->triangle_count; i++)
        if (*count == 0 || by_corners_and_winding(&faces[*count - 1], &faces[i]) != 0)
            faces[(*count)++] = faces[i];
    return faces;
}

// Of unique faces: pairs of the same corners and opposite windings.
static size_t count_back_to_back(const Face *faces, size_t count)
{
    size_t pairs = 0;
    for (size_t i = 1; i < count; i++)
        pairs += by_corners(&faces[i - 1], &faces[i]) == 0;
    return pairs;
}

static size_t count_odd_edges(const Face *faces, size_t count)
{
    uint32_t *corners = memory_new(3 * count + 1, sizeof *corners, "the edges of a solid");
    for (size_t i = 0; i < 3 * count; i++)
        corners[i] = faces[i / 3].corner[i % 3];
    const size_t odd = mesh_odd_edges(corners, count);
    free(corners);
    return odd;
}

// A sixth of the sum of the triangles' determinants, about the middle of the scene, where cancellation is least.
static double volume_of(const Scene *scene, const Face *faces, size_t count)
{
    double sum = 0.0;
    for (size_t i = 0; i < count; i++) {
        double p[3][3];
        for (int v = 0; v < 3; v++)
            for (int k = 0; k < 3; k++)
                p[v][k] = (double)scene->mesh.positions[3 * (size_t)faces[i].vertex[v] + (size_t)k] -
                          0.5 * ((double)scene->lower[k] + (double)scene->upper[k]);
        for (int k = 0; k < 3; k++)
            sum += p[0][k] * (p[1][(k + 1) % 3] * p[2][(k + 2) % 3] - p[1][(k + 2) % 3] * p[2][(k + 1) % 3]);
    }
    return sum / 6.0;
}

SolidMesh solid_mesh_create(const Scene *scene, const RasterMesh *mesh)
{
    size_t count;
    Face *faces = unique_faces(&scene->mesh, &count);
    SolidMesh solid = {.triangles = *mesh, .duplicates = scene->mesh.triangle_count - count};
    uint32_t *indices = memory_new(3 * count + 1, sizeof *indices, "the triangles of a solid");
    for (size_t i = 0; i < count; i++)
        memcpy(indices + 3 * i, faces[i].vertex, sizeof faces[i].vertex);
    solid.triangles.indices =
        gl_buffer(.label = "solid's triangles", .data = indices, .bytes = (3 * count + 1) * sizeof *indices);
    solid.triangles.index_count = (GLsizei)(3 * count);
    solid.back_to_back = count_back_to_back(faces, count);
    solid.odd_edges = count_odd_edges(faces, count);
    solid.closed = solid.odd_edges == 0;
    solid.volume = volume_of(scene, faces, count);
    free(indices);
    free(faces);
    return solid;
}

void solid_mesh_delete(SolidMesh *solid)
{
    gl_buffer_delete(&solid->triangles.indices);
}
