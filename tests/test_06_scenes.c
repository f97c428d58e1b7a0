// 06 scenes: the body of four dimensions and how it turns; the crowd's size.
#include "../chapters/06_epipolar_vsv/cell24.h"
#include "../chapters/06_epipolar_vsv/vsv_scenes.h"
#include "scene_sums.h"

#include <stdlib.h>
#include <string.h>

static Scene *open_scene(const char *name)
{
    const SceneKind *kind = vsv_scenes;
    while (kind->name && strcmp(kind->name, name) != 0)
        kind++;
    cr_assert(kind->name, "no scene %s", name);
    return scene_from(kind, 1);
}

enum { SLAB_TRIANGLES = 12, SLAB_VERTICES = 24 };

// A part ends where no triangle joins it to the rest: 24 balls and 96 rods, as the 24-cell has corners and edges.
static uint32_t root_of(uint32_t *parent, uint32_t i)
{
    while (parent[i] != i)
        i = parent[i] = parent[parent[i]];
    return i;
}

Test(vsv_scenes, the_24_cell_has_its_corners_and_edges)
{
    Scene *scene = open_scene("cell24");
    const Mesh *mesh = &scene->mesh;
    const size_t triangles = mesh->triangle_count - SLAB_TRIANGLES,
                 vertices = mesh->vertex_count - SLAB_VERTICES;
    const size_t rod = 13 * 12, rods = 96; // vertices of a rod: 13 rings of 12
    uint32_t *parent = memory_new(vertices, sizeof *parent, "parts");
    size_t *members = memory_new(vertices, sizeof *members, "parts");
    for (size_t i = 0; i < vertices; i++)
        parent[i] = (uint32_t)i;
    for (size_t i = 0; i < 3 * triangles; i++)
        parent[root_of(parent, mesh->indices[i])] = root_of(parent, mesh->indices[i / 3 * 3]);
    for (size_t i = 0; i < vertices; i++)
        members[root_of(parent, (uint32_t)i)]++;
    size_t found = 0, in_rods = 0;
    for (size_t i = 0; i < vertices; i++) {
        found += members[i] == rod;
        in_rods += members[i] == rod ? rod : 0;
    }
    cr_assert_eq(found, rods, "%zu rods", found);
    cr_assert_eq((vertices - in_rods) % 24, 0, "the rest are 24 balls of one kind: %zu vertices",
                 vertices - in_rods);
    free(parent);
    free(members);
    scene_close(scene);
}

// Frame 0 is the scene itself, each later one another, the same again when asked again; what is drawn moves with it. The slab stays.
Test(vsv_scenes, the_24_cell_turns_by_frames)
{
    gl_open(GL_PLATFORM_OSMESA, 16, 16, "test");
    Scene *rest = open_scene("cell24");
    RasterMesh mesh = raster_mesh(rest);
    Scene moved = cell24_begin(rest);
    const size_t bytes = 12 * rest->mesh.vertex_count;
    const uint64_t still = cell24_turn(&moved, 0, &mesh);
    cr_assert_eq(memcmp(moved.mesh.positions, rest->mesh.positions, bytes), 0, "frame 0 is the scene's");
    const uint64_t turned = cell24_turn(&moved, 7, &mesh);
    cr_assert(turned != still && turned == cell24_turn(&moved, 7, &mesh), "frame 7 is itself alone");
    float *drawn = memory_new(bytes, 1, "positions");
    gl_buffer_read(mesh.positions, 0, bytes, drawn);
    cr_assert_eq(memcmp(drawn, moved.mesh.positions, bytes), 0, "what is drawn is what moved");
    const size_t slab = 3 * (rest->mesh.vertex_count - SLAB_VERTICES);
    cr_assert_eq(memcmp(drawn + slab, rest->mesh.positions + slab, bytes - 4 * slab), 0, "the slab moves");
    const Sums sums = sums_of(&moved.mesh, 0);
    cr_assert(sums.against == 0 && sums.not_unit == 0, "%zu normals against, %zu not unit", sums.against,
              sums.not_unit);
    cr_assert(moved.lower[1] == rest->lower[1] && moved.upper[1] != rest->upper[1], "its box moves with it");
    free(drawn);
    cell24_end(&moved);
    raster_mesh_delete(&mesh);
    scene_close(rest);
    gl_close();
}

Test(vsv_scenes, the_crowd_is_a_million_triangles)
{
    Scene *scene = open_scene("crowd");
    cr_assert(scene->mesh.triangle_count >= 1000000, "%zu", scene->mesh.triangle_count);
    cr_assert_eq(scene->report.zero_area_triangles, 0, "none without area");
    scene_close(scene);
}

// Eye or lamp in a closed box, as the cases say; and the sheet's plane holds both.
Test(vsv_scenes, occluders_stand_where_the_cases_say)
{
    Scene *edge = open_scene("edge_on"), *boxed = open_scene("lamp_in_box");
    for (size_t i = 0; i < edge->mesh.vertex_count; i++)
        cr_assert_eq(edge->mesh.positions[3 * i + 1], edge->camera.eye[1],
                     "the sheet leaves the eye's height");
    cr_assert_eq(edge->lights[0].position[1], edge->camera.eye[1], "the lamp's is another");
    Mesh box = boxed->mesh;
    box.indices += 3 * (box.triangle_count - 24);
    box.triangle_count = 12; // the last but one of the boxes
    cr_assert(sums_of(&box, 0).volume > 0.1, "the lamp's box is closed: %g m³", sums_of(&box, 0).volume);
    scene_close(edge);
    scene_close(boxed);
}
