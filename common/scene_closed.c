// scene: is a mesh closed? Corners by their places, and the edges that do not pair up.
#include "scene.h"

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

uint32_t *mesh_places(const Mesh *mesh)
{
    Corner *corners = memory_new(mesh->vertex_count + 1, sizeof *corners, "the corners of a mesh");
    uint32_t *number = memory_new(mesh->vertex_count + 1, sizeof *number, "the corners of a mesh");
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        corners[i].vertex = (uint32_t)i;
        memcpy(corners[i].position, mesh->positions + 3 * i, sizeof corners[i].position);
    }
    qsort(corners, mesh->vertex_count, sizeof *corners, by_place);
    uint32_t last = 0;
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        last += i > 0 && by_place(&corners[i - 1], &corners[i]) != 0;
        number[corners[i].vertex] = last;
    }
    free(corners);
    return number;
}

static int by_number(const void *a, const void *b)
{
    const uint64_t m = *(const uint64_t *)a, n = *(const uint64_t *)b;
    return m < n ? -1 : m > n;
}

size_t mesh_odd_edges(const uint32_t *corners, size_t triangle_count)
{
    const size_t count = 3 * triangle_count;
    uint64_t *edges = memory_new(count + 1, sizeof *edges, "the edges of a mesh");
    for (size_t i = 0; i < count; i++) {
        const uint64_t a = corners[i], b = corners[i % 3 == 2 ? i - 2 : i + 1];
        edges[i] = a < b ? a << 32 | b : b << 32 | a;
    }
    qsort(edges, count, sizeof *edges, by_number);
    size_t odd = 0;
    for (size_t i = 0, next; i < count; i = next) {
        for (next = i + 1; next < count && edges[next] == edges[i];)
            next++;
        odd += (next - i) & 1;
    }
    free(edges);
    return odd;
}
