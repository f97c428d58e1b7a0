// solid: see solid.h. The GPU's part stands in shaders/01_voxelization/solid.glsl, solid.comp, solid.frag, scan.comp and vote.comp.
#include "solid.h"
#include <inttypes.h>
#include <stdarg.h>
#include <stdlib.h>

// As voxelize.c's: voxels; to draw a triangle of a few columns costs more than its columns do.
static const float SMALL_SIDE = 8.0f;

Solids solids_open(void)
{
    Solids solids = {
        .small_side = SMALL_SIDE,
        .flip = shader_open("solid: flip", NULL, "01_voxelization/solid.comp"),
        .flip_large = shader_open("solid: flip large", "ANY_DEPTH", "01_voxelization/list.vert",
                                  "01_voxelization/large.geom", "01_voxelization/solid.frag"),
        .scan = shader_open("solid: scan", "SOLID", "01_voxelization/scan.comp"),
        .vote = shader_open("solid: vote", NULL, "01_voxelization/vote.comp"),
        .framebuffer = gl_framebuffer(.label = "solid", .width = 1, .height = 1),
    };
    gl.CreateVertexArrays(1, &solids.vertex_array);
    return solids;
}

void solids_close(Solids *solids)
{
    shader_close(solids->flip);
    shader_close(solids->flip_large);
    shader_close(solids->scan);
    shader_close(solids->vote);
    gl_framebuffer_delete(&solids->framebuffer);
    gl.DeleteVertexArrays(1, &solids->vertex_array);
}

SolidWork solid_work_create(const VoxelGrid *grid, const SolidMesh *solid, bool everything)
{
    size_t columns = 0;
    for (size_t axis = 0; axis < 3; axis++) {
        size_t here = (size_t)grid->size[(axis + 1) % 3] * (size_t)grid->size[(axis + 2) % 3];
        columns = here > columns ? here : columns;
    }
    GLint most_bytes = 0;
    gl.GetIntegerv(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most_bytes);
    if (columns * 2 * sizeof(int32_t) > (size_t)most_bytes)
        fail_work("%zu columns of a solid need %zu bytes; this renderer's buffers hold %d: choose a lower "
                  "resolution",
                  columns, columns * 2 * sizeof(int32_t), most_bytes);
    SolidWork work = {
        .three_axes = everything || !solid->closed,
        .flips = voxels_create(grid, "solid: flips"),
        .lists = gl_buffer(.label = "solid: large triangles",
                           .bytes = ((size_t)solid->triangles.index_count / 3 + 1) * sizeof(uint32_t)),
        .counts = gl_buffer(.label = "solid: counts", .bytes = 2 * sizeof(uint32_t)),
        .crossings = gl_buffer(.label = "solid: crossings", .bytes = columns * 2 * sizeof(int32_t)),
    };
    for (int axis = work.three_axes ? 0 : 2; axis < 3; axis++) {
        work.along[axis] = voxels_create(grid, "solid along an axis");
        work.reports[axis] = gl_buffer(.label = "solid: columns", .bytes = sizeof(SolidColumns));
    }
    work.result = work.three_axes ? voxels_create(grid, "solid") : work.along[2];
    return work;
}

void solid_work_delete(SolidWork *work)
{
    if (work->three_axes)
        voxels_delete(&work->result);
    for (int axis = 0; axis < 3; axis++) {
        voxels_delete(&work->along[axis]);
        gl_buffer_delete(&work->reports[axis]);
    }
    voxels_delete(&work->flips);
    gl_buffer_delete(&work->lists);
    gl_buffer_delete(&work->counts);
    gl_buffer_delete(&work->crossings);
}

static void clear(GLuint buffer)
{
    gl.ClearNamedBufferData(buffer, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, NULL);
}

static void bind(const SolidWork *work)
{
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, work->flips.words);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, work->lists);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 4, work->crossings);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 5, work->counts);
}

void solid_flip(const Solids *solids, const SolidMesh *solid, const SolidWork *work, int axis)
{
    const VoxelGrid *grid = &work->flips.grid;
    uint32_t triangles = (uint32_t)solid->triangles.index_count / 3, large = 0;
    voxels_clear(&work->flips);
    clear(work->crossings);
    clear(work->counts);
    voxelize_use(solids->flip, &solid->triangles, grid);
    bind(work);
    shader_set_int(solids->flip, "axis", axis);
    shader_set_uint(solids->flip, "triangle_count", triangles);
    shader_set_float(solids->flip, "small_side", solids->small_side);
    voxelize_dispatch(triangles);
    gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    gl_buffer_read(work->counts, 0, sizeof large, &large);
    if (large > 0) {
        voxelize_begin(solids->framebuffer, &work->flips, grid->size[(axis + 1) % 3],
                       grid->size[(axis + 2) % 3]);
        voxelize_use(solids->flip_large, &solid->triangles, grid);
        bind(work);
        shader_set_int(solids->flip_large, "axis", axis);
        gl.BindVertexArray(solids->vertex_array);
        gl.DrawArrays(GL_POINTS, 0, (GLsizei)large);
        gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    }
}

void solid_scan(const Solids *solids, const SolidWork *work, int axis)
{
    const int *size = work->flips.grid.size;
    voxels_clear(&work->along[axis]);
    clear(work->reports[axis]);
    shader_use(solids->scan);
    shader_set_ivec3(solids->scan, "grid_size", size);
    shader_set_int(solids->scan, "axis", axis);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, work->flips.words);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, work->along[axis].words);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 4, work->crossings);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 5, work->reports[axis]);
    uint32_t heads = axis == 0 ? (uint32_t)size[1] : (uint32_t)(size[0] + 31) / 32;
    voxelize_dispatch(heads * (uint32_t)(axis == 2 ? size[1] : size[2]));
    gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

void solid_vote(const Solids *solids, const SolidMesh *solid, const SolidWork *work)
{
    uint32_t words = (uint32_t)(work->result.bytes / sizeof(uint32_t));
    shader_use(solids->vote);
    shader_set_uint(solids->vote, "word_count", words);
    shader_set_int(solids->vote, "closed", solid->closed);
    for (GLuint axis = 0; axis < 3; axis++)
        gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, axis, work->along[axis].words);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, work->result.words);
    voxelize_dispatch(words);
    gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void solid_voxelize(const Solids *solids, const SolidMesh *solid, const SolidWork *work)
{
    for (int axis = work->three_axes ? 0 : 2; axis < 3; axis++) {
        solid_flip(solids, solid, work, axis);
        solid_scan(solids, work, axis);
    }
    if (work->three_axes)
        solid_vote(solids, solid, work);
}

// ---------------------------------------------------------------- what is wrong with the mesh

SolidColumns solid_columns(const SolidWork *work, int axis)
{
    SolidColumns columns = {0};
    gl.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    if (work->reports[axis] != 0)
        gl_buffer_read(work->reports[axis], 0, sizeof columns, &columns);
    return columns;
}

// Add a sentence; `text` is freed.
__attribute__((format(printf, 2, 3))) static char *also(char *text, const char *format, ...)
{
    char *more = NULL, *joined;
    va_list arguments;
    va_start(arguments, format);
    if (vasprintf(&more, format, arguments) < 0)
        fail_work("no memory for a message");
    va_end(arguments);
    joined = text_format("%s%s%s", text ? text : "", text ? "; " : "", more);
    free(text);
    free(more);
    return joined;
}

char *solid_message(const char *name, const SolidMesh *solid, const SolidWork *work)
{
    SolidColumns x = solid_columns(work, 0), y = solid_columns(work, 1), z = solid_columns(work, 2);
    char *text = NULL;
    if (solid->duplicates > 0)
        text = also(text, "%zu triangles repeat another one, corners and winding: they do not count",
                    solid->duplicates);
    if (solid->back_to_back > 0)
        text = also(text, "%zu pairs of triangles lie back to back: they cancel, and bound nothing",
                    solid->back_to_back);
    if (!solid->closed)
        text =
            also(text,
                 "not closed: %zu edges belong to an odd number of triangles, so a voxel is inside where two "
                 "of three axes say so; of the columns along x, y and z, %" PRIu32 ", %" PRIu32
                 " and %" PRIu32 " are crossed an odd number of times and say nothing",
                 solid->odd_edges, x.odd, y.odd, z.odd);
    if (z.inside_out > 0)
        text =
            also(text, "wound inside out in %" PRIu32 " of %" PRIu32 " columns along z: filled all the same",
                 z.inside_out, z.crossed);
    if (z.overlapping > 0)
        text = also(text,
                    "parts overlap, or disagree in winding, in %" PRIu32 " of %" PRIu32
                    " columns along z: what an even number of parts covers is outside",
                    z.overlapping, z.crossed);
    if (!text)
        return NULL;
    char *whole = text_format("%s: as a solid: %s", name, text);
    free(text);
    return whole;
}

double solid_volume_error(const SolidMesh *solid, const VoxelGrid *grid, double voxels)
{
    return fabs(voxels * pow(grid->voxel_size, 3.0) / fabs(solid->volume) - 1.0);
}
