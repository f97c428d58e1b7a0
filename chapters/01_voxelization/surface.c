// surface: see surface.h.
#include "surface.h"

#include <stdlib.h>

enum { SAMPLES = 4, SLAB = 128 }; // voxels a texel

Surfaces surfaces_open(void)
{
    Surfaces surfaces = {
        .axis = shader_open("voxelize along an axis", NULL, "01_voxelization/all.vert",
                            "01_voxelization/axis.geom", "01_voxelization/raster.frag"),
        .slice_sort = shader_open("sort into slices", NULL, "01_voxelization/slice_sort.comp"),
        .slice = shader_open("slice", NULL, "01_voxelization/list.vert", "01_voxelization/axis.geom",
                             "01_voxelization/slice.frag"),
        .slice_all = shader_open("slice of all", NULL, "01_voxelization/all.vert",
                                 "01_voxelization/axis.geom", "01_voxelization/slice.frag"),
        .peel = shader_open("peel", NULL, "01_voxelization/all.vert", "01_voxelization/axis.geom",
                            "01_voxelization/peel.frag"),
        .layer = shader_open("layer", NULL, "01_voxelization/layer.comp"),
        .samples = shader_open("samples", NULL, "01_voxelization/raster.vert", "01_voxelization/raster.geom",
                               "01_voxelization/samples.frag"),
        .expanded = shader_open("expanded", NULL, "01_voxelization/raster.vert",
                                "01_voxelization/expanded.geom", "01_voxelization/expanded.frag"),
        .binary = shader_open("binary", NULL, "01_voxelization/all.vert", "01_voxelization/large.geom",
                              "01_voxelization/binary.frag"),
        .unpack = shader_open("unpack", NULL, "01_voxelization/unpack.comp"),
        .framebuffer = gl_framebuffer(.label = "surface", .width = 1, .height = 1),
        .sampled = gl_framebuffer(.label = "samples", .width = 1, .height = 1),
    };
    gl.NamedFramebufferParameteri(surfaces.sampled, GL_FRAMEBUFFER_DEFAULT_SAMPLES, SAMPLES);
    gl.CreateVertexArrays(1, &surfaces.vertex_array);
    return surfaces;
}

void surfaces_close(Surfaces *surfaces)
{
    Shader *shaders[] = {surfaces->axis,   surfaces->slice_sort, surfaces->slice,   surfaces->slice_all,
                         surfaces->peel,   surfaces->layer,      surfaces->samples, surfaces->expanded,
                         surfaces->binary, surfaces->unpack};
    for (size_t i = 0; i < sizeof shaders / sizeof(Shader *); i++)
        shader_close(shaders[i]);
    gl_framebuffer_delete(&surfaces->framebuffer);
    gl_framebuffer_delete(&surfaces->sampled);
    gl.DeleteVertexArrays(1, &surfaces->vertex_array);
}

// ---------------------------------------------------------------- one draw, or three

//[threepass
void surface_threepass(const Surfaces *surfaces, const RasterMesh *mesh, const Voxels *voxels)
{
    int side = voxelize_side(&voxels->grid);
    voxelize_begin(surfaces->framebuffer, voxels, side, side);
    voxelize_use(surfaces->axis, mesh, &voxels->grid);
    shader_set_int(surfaces->axis, "dominant_only", true);
    gl.BindVertexArray(surfaces->vertex_array);
    for (int axis = 0; axis < 3; axis++) {
        shader_set_int(surfaces->axis, "look_along", axis);
        gl.DrawArrays(GL_POINTS, 0, mesh->index_count / 3);
    }
    gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}
//]

static void draw_once(GLuint framebuffer, const Shader *shader, const RasterMesh *mesh, const Voxels *voxels)
{
    int side = voxelize_side(&voxels->grid);
    voxelize_begin(framebuffer, voxels, side, side);
    shader_use(shader);
    voxelize_set_grid(shader, &voxels->grid);
    raster_draw(mesh);
    gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void surface_msaa(const Surfaces *surfaces, const RasterMesh *mesh, const Voxels *voxels)
{
    draw_once(surfaces->sampled, surfaces->samples, mesh, voxels);
}

void surface_expanded(const Surfaces *surfaces, const RasterMesh *mesh, const Voxels *voxels)
{
    draw_once(surfaces->framebuffer, surfaces->expanded, mesh, voxels);
}

// ---------------------------------------------------------------- slicing

static void sort_slices(const Surfaces *surfaces, const RasterMesh *mesh, int axis, bool fill)
{
    shader_set_int(surfaces->slice_sort, "look_along", axis);
    shader_set_int(surfaces->slice_sort, "fill", fill);
    voxelize_dispatch((uint32_t)mesh->index_count / 3);
    gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

SliceLists slice_lists_make(const Surfaces *surfaces, const RasterMesh *mesh, const VoxelGrid *grid)
{
    SliceLists lists = {0};
    GLuint places[3];
    uint64_t entries = 0;
    voxelize_use(surfaces->slice_sort, mesh, grid);
    shader_set_uint(surfaces->slice_sort, "triangle_count", (unsigned)mesh->index_count / 3);
    for (int axis = 0; axis < 3; axis++) {
        size_t bytes = (size_t)grid->size[axis] * sizeof(uint32_t);
        places[axis] = gl_buffer(.label = "slice places", .bytes = bytes);
        gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, places[axis]); // not written while counting
        gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 4, places[axis]);
        sort_slices(surfaces, mesh, axis, false);
        uint32_t *first = memory_new((size_t)grid->size[axis] + 1, sizeof *first, "the slices");
        gl_buffer_read(places[axis], 0, bytes, first);
        for (int slice = 0; slice <= grid->size[axis]; slice++) {
            uint32_t count = first[slice];
            lists.empty += slice < grid->size[axis] && count == 0;
            first[slice] = (uint32_t)entries;
            entries += slice < grid->size[axis] ? count : 0;
        }
        lists.first[axis] = first;
        lists.slices += grid->size[axis];
        gl.NamedBufferSubData(places[axis], 0, (GLsizeiptr)bytes, first);
    }
    GLint most_bytes = 0;
    gl.GetIntegerv(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most_bytes);
    if (entries * sizeof(uint32_t) > (uint64_t)most_bytes)
        fail_work("the triangles reach into %llu slices, whose list needs %llu bytes; this renderer's "
                  "buffers hold %d: "
                  "choose a lower resolution",
                  (unsigned long long)entries, (unsigned long long)entries * 4, most_bytes);
    lists.lists = gl_buffer(.label = "slice lists", .bytes = (size_t)(entries + 1) * sizeof(uint32_t));
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, lists.lists);
    for (int axis = 0; axis < 3; axis++) {
        gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 4, places[axis]);
        sort_slices(surfaces, mesh, axis, true);
        gl_buffer_delete(&places[axis]);
    }
    return lists;
}

void slice_lists_delete(SliceLists *lists)
{
    gl_buffer_delete(&lists->lists);
    for (int axis = 0; axis < 3; axis++)
        free(lists->first[axis]);
    *lists = (SliceLists){0};
}

//[slicing
void surface_slicing(const Surfaces *surfaces, const RasterMesh *mesh, const SliceLists *lists,
                     const Voxels *voxels)
{
    const Shader *shader = lists ? surfaces->slice : surfaces->slice_all;
    int side = voxelize_side(&voxels->grid);
    voxelize_begin(surfaces->framebuffer, voxels, side, side);
    voxelize_use(shader, mesh, &voxels->grid);
    if (lists)
        gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, lists->lists);
    gl.BindVertexArray(surfaces->vertex_array);
    for (int axis = 0; axis < 3; axis++) {
        shader_set_int(shader, "look_along", axis);
        for (int slice = 0; slice < voxels->grid.size[axis]; slice++) {
            uint32_t first = lists ? lists->first[axis][slice] : 0;
            uint32_t end = lists ? lists->first[axis][slice + 1] : (uint32_t)mesh->index_count / 3;
            if (first == end)
                continue;
            shader_set_int(shader, "slice", slice);
            gl.DrawArrays(GL_POINTS, (GLint)first, (GLsizei)(end - first));
        }
    }
    gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}
//]

// ---------------------------------------------------------------- peeling

//[peeling
// One layer: what lies nearest behind the last layer, pixel by pixel. Returns how many pixels have such a thing.
static uint32_t peel_layer(const Surfaces *surfaces, const RasterMesh *mesh, const Voxels *voxels, int side,
                           GLuint framebuffer, GLuint last, GLuint layer, GLuint found)
{
    const float far = 1.0f;
    gl.ClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, &far);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    voxelize_use(surfaces->peel, mesh, &voxels->grid);
    gl.BindTextureUnit(0, last);
    gl.Enable(GL_DEPTH_TEST);
    gl.DrawArrays(GL_POINTS, 0, mesh->index_count / 3);
    gl.Disable(GL_DEPTH_TEST);

    gl.ClearNamedBufferData(found, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, NULL);
    shader_use(surfaces->layer);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, found);
    gl.BindTextureUnit(0, layer);
    gl.DispatchCompute(((GLuint)side + 63) / 64, (GLuint)side, 1);
    gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    uint32_t count = 0;
    gl_buffer_read(found, 0, sizeof count, &count);
    return count;
}

PeelCount surface_peeling(const Surfaces *surfaces, const RasterMesh *mesh, int most, bool everything,
                          const Voxels *voxels)
{
    PeelCount peeled = {0};
    int side = voxelize_side(&voxels->grid);
    GLuint depth[2], framebuffer[2], found = gl_buffer(.label = "peeled", .bytes = sizeof(uint32_t));
    for (int i = 0; i < 2; i++) {
        depth[i] =
            gl_texture(.label = "layer", .format = GL_DEPTH_COMPONENT32F, .width = side, .height = side);
        framebuffer[i] = gl_framebuffer(.label = "layer", .depth = depth[i]);
    }
    gl.Viewport(0, 0, side, side);
    gl.BindVertexArray(surfaces->vertex_array);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, voxels->words);
    int exponent = 0;
    frexpf((float)side, &exponent); // side < 2^exponent
    shader_set_float(surfaces->peel, "depth_scale", ldexpf(1.0f, -exponent));
    shader_set_float(surfaces->layer, "depth_scale", ldexpf(1.0f, -exponent));
    voxelize_set_grid(surfaces->layer, &voxels->grid);
    for (int axis = 0; axis < 3; axis++) {
        shader_set_int(surfaces->peel, "look_along", axis);
        shader_set_int(surfaces->layer, "look_along", axis);
        const float near = 0.0f;
        gl.ClearNamedFramebufferfv(framebuffer[1], GL_DEPTH, 0, &near);
        bool more = true;
        for (int layer = 0; layer < most && layer < voxels->grid.size[axis] && (more || everything);
             layer++) {
            int to = layer & 1;
            uint32_t pixels =
                peel_layer(surfaces, mesh, voxels, side, framebuffer[to], depth[1 - to], depth[to], found);
            peeled.voxels += pixels;
            peeled.layers[axis]++;
            more = pixels > 0;
        }
    }
    gl_buffer_delete(&found);
    for (int i = 0; i < 2; i++) {
        gl_framebuffer_delete(&framebuffer[i]);
        gl_texture_delete(&depth[i]);
    }
    return peeled;
}
//]

// ---------------------------------------------------------------- binary

BinaryGrid binary_create(const VoxelGrid *grid)
{
    BinaryGrid binary = {.grid = *grid, .slabs = (grid->size[2] + SLAB - 1) / SLAB};
    binary.texture = gl_texture(.label = "binary", .target = GL_TEXTURE_2D_ARRAY, .format = GL_RGBA32UI,
                                .width = grid->size[0], .height = grid->size[1], .depth = binary.slabs);
    return binary;
}

void binary_delete(BinaryGrid *binary)
{
    gl_texture_delete(&binary->texture);
}

//[binary
void binary_draw(const Surfaces *surfaces, const RasterMesh *mesh, const BinaryGrid *binary)
{
    const GLuint none[4] = {0};
    GLuint framebuffer;
    gl.CreateFramebuffers(1, &framebuffer);
    gl.Viewport(0, 0, binary->grid.size[0], binary->grid.size[1]);
    voxelize_use(surfaces->binary, mesh, &binary->grid);
    shader_set_int(surfaces->binary, "axis", 2);
    gl.BindVertexArray(surfaces->vertex_array);
    gl.Enable(GL_COLOR_LOGIC_OP);
    gl.LogicOp(GL_OR);
    for (int slab = 0; slab < binary->slabs; slab++) {
        gl.NamedFramebufferTextureLayer(framebuffer, GL_COLOR_ATTACHMENT0, binary->texture, 0, slab);
        gl.ClearNamedFramebufferuiv(framebuffer, GL_COLOR, 0, none);
        gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        shader_set_int(surfaces->binary, "slab", slab);
        gl.DrawArrays(GL_POINTS, 0, mesh->index_count / 3);
    }
    gl.Disable(GL_COLOR_LOGIC_OP);
    gl_framebuffer_delete(&framebuffer);
}
//]

void binary_unpack(const Surfaces *surfaces, const BinaryGrid *binary, const Voxels *voxels)
{
    uint32_t words = (uint32_t)(voxels->bytes / sizeof(uint32_t));
    shader_use(surfaces->unpack);
    voxelize_set_grid(surfaces->unpack, &voxels->grid);
    shader_set_uint(surfaces->unpack, "word_count", words);
    gl.BindTextureUnit(0, binary->texture);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, voxels->words);
    voxelize_dispatch(words);
    gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}
