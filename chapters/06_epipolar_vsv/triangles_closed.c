// triangles_closed: is a mesh closed? A line then crosses it an even number of times, which solid voxelization stands on.
#include "triangles.h"

#include <stdlib.h>
#include <string.h>

typedef struct Corner {
    float position[3];
    uint32_t vertex;
} Corner;

static int by_place(const void *a, const void *b)
{
    const float *p = ((const Corner *)a)->position, *q = ((const Corner *)b)->position;
    for (int k = 0; k < 3; k++)
        if (p[k] != q[k])
            return p[k] < q[k] ? -1 : 1;
    return 0;
}

static int by_number(const void *a, const void *b)
{
    const uint64_t m = *(const uint64_t *)a, n = *(const uint64_t *)b;
    return m < n ? -1 : m > n;
}

// A number for each vertex, the same for the same place: a mesh repeats a vertex for each normal that it has there.
static uint32_t *number_places(const Mesh *mesh)
{
    Corner *corners = memory_new(mesh->vertex_count + 1, sizeof *corners, "the corners of a mesh");
    uint32_t *number = memory_new(mesh->vertex_count + 1, sizeof *number, "the corners of a mesh");
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        corners[i].vertex = (uint32_t)i;
        memcpy(corners[i].position, mesh->positions + 3 * i, sizeof corners[i].position);
    }
    qsort(corners, mesh->vertex_count, sizeof *corners, by_place);
    uint32_t place = 0;
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        place += i > 0 && by_place(&corners[i - 1], &corners[i]) != 0;
        number[corners[i].vertex] = place;
    }
    free(corners);
    return number;
}

size_t triangles_open_edges(const Mesh *mesh)
{
    const size_t count = 3 * mesh->triangle_count;
    uint32_t *number = number_places(mesh);
    uint64_t *edges = memory_new(count + 1, sizeof *edges, "the edges of a mesh");
    for (size_t i = 0; i < count; i++) {
        const uint64_t a = number[mesh->indices[i]], b = number[mesh->indices[i % 3 == 2 ? i - 2 : i + 1]];
        edges[i] = a < b ? a << 32 | b : b << 32 | a;
    }
    qsort(edges, count, sizeof *edges, by_number);
    size_t open = 0;
    for (size_t i = 0, next; i < count; i = next) {
        for (next = i + 1; next < count && edges[next] == edges[i];)
            next++;
        open += (next - i) & 1;
    }
    free(edges);
    free(number);
    return open;
}

void triangles_need_closed(const Scene *scene)
{
    const size_t open = triangles_open_edges(&scene->mesh);
    if (open > 0)
        fail_request("--set method=solid: needs closed meshes, and scene %s has %zu edges that belong to an "
                     "odd number of "
                     "triangles; method=conservative takes any mesh",
                     scene->name, open);
}
