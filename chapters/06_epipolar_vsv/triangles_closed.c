// triangles_closed: is a mesh closed? A line then crosses it an even number of times, which solid voxelization stands on.
#include "triangles.h"

#include <stdlib.h>

size_t triangles_open_edges(const Mesh *mesh)
{
    uint32_t *place = mesh_places(mesh);
    uint32_t *corners = memory_new(3 * mesh->triangle_count + 1, sizeof *corners, "the edges of a mesh");
    for (size_t i = 0; i < 3 * mesh->triangle_count; i++)
        corners[i] = place[mesh->indices[i]];
    const size_t open = mesh_odd_edges(corners, mesh->triangle_count);
    free(corners);
    free(place);
    return open;
}

void triangles_need_closed(const Scene *scene)
{
    const size_t open = triangles_open_edges(&scene->mesh);
    if (open > 0)
        fail_request("--set method=solid: needs closed meshes, and scene %s has %zu edges that belong to an "
                     "odd number of triangles; method=conservative takes any mesh",
                     scene->name, open);
}
