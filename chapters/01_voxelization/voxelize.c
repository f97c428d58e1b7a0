// voxelize: see voxelize.h. The GPU's part stands in shaders/01_voxelization/ and, for what later chapters use again,
// in shaders/common/grid.glsl, triangles.glsl and overlap.glsl.
#include "voxelize.h"

enum {
    GROUP = 64,               // local_size_x of the compute shaders here
    UNDECIDED_MOST = 1 << 18, // voxels, 4 MiB
};

// Voxels. To draw a triangle of a few voxels costs ten times what its voxels do: on the bunny at 256³ a side of 2 takes ten times as long
// as one of 4, and 4, 8, 16, 32 differ by less than repeats do.
static const float SMALL_SIDE = 8.0f;

// ---------------------------------------------------------------- bits

VoxelGrid voxelize_grid(const Scene *scene, vec3 from, vec3 to, int resolution)
{
    for (int k = 0; k < 3; k++)
        if (!(from[k] < to[k]))
            fail_request("--set region_lower, region_upper: the lower corner must be below the upper one on "
                         "each axis");
    Scene part = *scene; // the same scene in a smaller box
    const vec3 size = scene->upper - scene->lower;
    for (int k = 0; k < 3; k++) { // 0 and 1 are the corners themselves, whatever rounding would make of them
        part.lower[k] = from[k] > 0.0f ? scene->lower[k] + from[k] * size[k] : scene->lower[k];
        part.upper[k] = to[k] < 1.0f ? scene->lower[k] + to[k] * size[k] : scene->upper[k];
    }
    return scene_grid(&part, resolution);
}

Voxels voxels_create(const VoxelGrid *grid, const char *label)
{
    Voxels voxels = {.grid = *grid, .bytes = grid_words(grid) * sizeof(uint32_t)};
    GLint most_bytes = 0, most_pixels[2] = {0};
    gl.GetIntegerv(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most_bytes);
    gl.GetIntegerv(GL_MAX_VIEWPORT_DIMS, most_pixels);
    int side = most_pixels[0] < most_pixels[1] ? most_pixels[0] : most_pixels[1];
    if (voxels.bytes > (size_t)most_bytes)
        fail_work("a grid of %d x %d x %d voxels needs %zu bytes at one bit a voxel; this renderer's buffers "
                  "hold %d: choose a lower resolution",
                  grid->size[0], grid->size[1], grid->size[2], voxels.bytes, most_bytes);
    for (int k = 0; k < 3; k++)
        if (grid->size[k] > side)
            fail_work("a grid %d voxels long (%zu bytes) cannot be drawn: this renderer's viewports end at "
                      "%d pixels; "
                      "choose a lower resolution",
                      grid->size[k], voxels.bytes, side);
    voxels.words = gl_buffer(.label = label, .bytes = voxels.bytes);
    return voxels;
}

void voxels_delete(Voxels *voxels)
{
    gl_buffer_delete(&voxels->words);
}

void voxels_clear(const Voxels *voxels)
{
    gl.ClearNamedBufferData(voxels->words, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, NULL);
}

uint32_t *voxels_read(const Voxels *voxels)
{
    uint32_t *words = memory_new(grid_words(&voxels->grid), sizeof *words, "the voxels' bits");
    gl.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    gl_buffer_read(voxels->words, 0, voxels->bytes, words);
    return words;
}

double voxels_count(const uint32_t *in, const uint32_t *but_not, size_t words)
{
    double count = 0.0;
    for (size_t i = 0; i < words; i++)
        count += __builtin_popcount(but_not ? in[i] & ~but_not[i] : in[i]);
    return count;
}

// ---------------------------------------------------------------- shaders

Voxelizer voxelizer_open(void)
{
    Voxelizer voxelizer = {
        .small_side = SMALL_SIDE,
        .raster = shader_open("voxelize raster", NULL, "01_voxelization/raster.vert",
                              "01_voxelization/raster.geom", "01_voxelization/raster.frag"),
        .sort = shader_open("sort triangles", NULL, "01_voxelization/sort.comp"),
        .small = {shader_open("voxelize small", "LATER", "01_voxelization/small.comp"),
                  shader_open("voxelize small at once", NULL, "01_voxelization/small.comp")},
        .large = {shader_open("voxelize large", "LATER", "01_voxelization/list.vert",
                              "01_voxelization/large.geom", "01_voxelization/large.frag"),
                  shader_open("voxelize large at once", NULL, "01_voxelization/list.vert",
                              "01_voxelization/large.geom", "01_voxelization/large.frag")},
        .decide = shader_open("decide", NULL, "01_voxelization/decide.comp"),
        .undecided_most = UNDECIDED_MOST,
        .undecided = gl_buffer(.label = "undecided", .bytes = (UNDECIDED_MOST + 1) * sizeof(uint32_t[4])),
        .compare = shader_open("compare voxels", NULL, "01_voxelization/compare.comp"),
        // no pixel is ever written: the fragment stage stores voxels
        .framebuffer = gl_framebuffer(.label = "voxelize", .width = 1, .height = 1),
    };
    gl.CreateVertexArrays(1, &voxelizer.vertex_array);
    return voxelizer;
}

void voxelizer_close(Voxelizer *voxelizer)
{
    shader_close(voxelizer->raster);
    shader_close(voxelizer->sort);
    for (int at_once = 0; at_once < 2; at_once++) {
        shader_close(voxelizer->small[at_once]);
        shader_close(voxelizer->large[at_once]);
    }
    shader_close(voxelizer->decide);
    shader_close(voxelizer->compare);
    gl_framebuffer_delete(&voxelizer->framebuffer);
    gl_buffer_delete(&voxelizer->undecided);
    gl.DeleteVertexArrays(1, &voxelizer->vertex_array);
}

void voxelize_set_grid(const Shader *shader, const VoxelGrid *grid)
{
    shader_set_ivec3(shader, "grid_size", grid->size);
    shader_set_dvec3(shader, "grid_origin", grid->origin);
    shader_set_double(shader, "voxel_size", grid->voxel_size);
}

void voxelize_use(const Shader *shader, const RasterMesh *mesh, const VoxelGrid *grid)
{
    shader_use(shader);
    voxelize_set_grid(shader, grid);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, mesh->positions);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, mesh->indices);
}

int voxelize_side(const VoxelGrid *grid)
{
    int side = grid->size[0] > grid->size[1] ? grid->size[0] : grid->size[1];
    return side > grid->size[2] ? side : grid->size[2];
}

// GL promises 65535 groups a side.
void voxelize_dispatch(uint32_t items)
{
    uint32_t groups = (items + GROUP - 1) / GROUP, rows = groups / 65535 + 1;
    gl.DispatchCompute((groups + rows - 1) / rows, rows, 1);
}

// A pixel a voxel of the face that is looked at.
void voxelize_begin(GLuint framebuffer, const Voxels *voxels, int width, int height)
{
    // no larger than needed: llvmpipe clears a bin for each 64×64 pixels (8 ms a draw at 16384²)
    gl.NamedFramebufferParameteri(framebuffer, GL_FRAMEBUFFER_DEFAULT_WIDTH, width);
    gl.NamedFramebufferParameteri(framebuffer, GL_FRAMEBUFFER_DEFAULT_HEIGHT, height);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl.Viewport(0, 0, width, height);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, voxels->words);
}

// ---------------------------------------------------------------- raster

//[raster
void voxelize_raster(const Voxelizer *voxelizer, const RasterMesh *mesh, const Voxels *voxels)
{
    int side = voxelize_side(&voxels->grid);
    voxelize_begin(voxelizer->framebuffer, voxels, side, side);
    shader_use(voxelizer->raster);
    voxelize_set_grid(voxelizer->raster, &voxels->grid);
    raster_draw(mesh);
    gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}
//]

// ---------------------------------------------------------------- exact

TriangleLists triangle_lists_create(const RasterMesh *mesh)
{
    uint32_t triangles = (uint32_t)mesh->index_count / 3;
    size_t entries = LIST_COUNT * (size_t)(triangles > 0 ? triangles : 1);
    return (TriangleLists){
        .triangle_count = triangles,
        .lists = gl_buffer(.label = "triangle lists", .bytes = entries * sizeof(uint32_t)),
        .counts = gl_buffer(.label = "triangle counts", .bytes = (LIST_COUNT + 1) * sizeof(uint32_t)),
    };
}

void triangle_lists_delete(TriangleLists *lists)
{
    gl_buffer_delete(&lists->lists);
    gl_buffer_delete(&lists->counts);
}

static void bind_triangles(const Shader *shader, const RasterMesh *mesh, const TriangleLists *lists,
                           const VoxelGrid *grid)
{
    voxelize_use(shader, mesh, grid);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, lists->lists);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 4, lists->counts);
}

//[sort
void voxelize_sort(const Voxelizer *voxelizer, const RasterMesh *mesh, const VoxelGrid *grid,
                   TriangleLists *lists)
{
    gl.ClearNamedBufferData(lists->counts, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, NULL);
    bind_triangles(voxelizer->sort, mesh, lists, grid);
    shader_set_uint(voxelizer->sort, "triangle_count", lists->triangle_count);
    shader_set_float(voxelizer->sort, "small_side", voxelizer->small_side);
    voxelize_dispatch(lists->triangle_count);
    gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    // Waiting for 20 bytes costs less than an axis that nothing faces.
    uint32_t counts[LIST_COUNT + 1];
    gl_buffer_read(lists->counts, 0, sizeof counts, counts);
    for (int list = 0; list < LIST_COUNT; list++)
        lists->count[list] = counts[list];
    lists->outside = counts[LIST_COUNT];
}
//]

//[small
static void voxelize_small(const Voxelizer *voxelizer, const RasterMesh *mesh, const TriangleLists *lists,
                           bool at_once, const Voxels *voxels)
{
    const Shader *shader = voxelizer->small[at_once];
    bind_triangles(shader, mesh, lists, &voxels->grid);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, voxels->words);
    shader_set_uint(shader, "undecided_most", voxelizer->undecided_most);
    shader_set_uint(shader, "list_first", LIST_SMALL * lists->triangle_count);
    shader_set_uint(shader, "list_count", lists->count[LIST_SMALL]);
    voxelize_dispatch(lists->count[LIST_SMALL]);
}
//]

//[large
static void voxelize_large(const Voxelizer *voxelizer, const RasterMesh *mesh, const TriangleLists *lists,
                           int axis, bool at_once, const Voxels *voxels)
{
    const Shader *shader = voxelizer->large[at_once];
    const int *size = voxels->grid.size;
    voxelize_begin(voxelizer->framebuffer, voxels, size[(axis + 1) % 3], size[(axis + 2) % 3]);
    bind_triangles(shader, mesh, lists, &voxels->grid);
    shader_set_uint(shader, "undecided_most", voxelizer->undecided_most);
    shader_set_int(shader, "axis", axis);
    gl.BindVertexArray(voxelizer->vertex_array);
    gl.DrawArrays(GL_POINTS, (GLint)((uint32_t)axis * lists->triangle_count), (GLsizei)lists->count[axis]);
}
//]

static void voxelize_by(const Voxelizer *voxelizer, const RasterMesh *mesh, const TriangleLists *lists,
                        int list, bool at_once, const Voxels *voxels)
{
    if (list == LIST_SMALL)
        voxelize_small(voxelizer, mesh, lists, at_once, voxels);
    else
        voxelize_large(voxelizer, mesh, lists, list, at_once, voxels);
    gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

//[later
uint32_t voxelize_list(const Voxelizer *voxelizer, const RasterMesh *mesh, const TriangleLists *lists,
                       int list, const Voxels *voxels)
{
    uint32_t count = 0;
    gl.NamedBufferSubData(voxelizer->undecided, 0, sizeof count, &count);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 5, voxelizer->undecided);
    voxelize_by(voxelizer, mesh, lists, list, false, voxels);
    gl_buffer_read(voxelizer->undecided, 0, sizeof count, &count);
    if (count > voxelizer->undecided_most) { // once more, at once: a bit that is set twice is set
        voxelize_by(voxelizer, mesh, lists, list, true, voxels);
    } else if (count > 0) {
        voxelize_use(voxelizer->decide, mesh, &voxels->grid);
        gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, voxels->words);
        voxelize_dispatch(count);
        gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    }
    return count;
}
//]

void voxelize_exact(const Voxelizer *voxelizer, const RasterMesh *mesh, TriangleLists *lists,
                    const Voxels *voxels)
{
    voxels_clear(voxels);
    voxelize_sort(voxelizer, mesh, &voxels->grid, lists);
    for (int list = 0; list < LIST_COUNT; list++)
        if (lists->count[list] > 0)
            voxelize_list(voxelizer, mesh, lists, list, voxels);
}

// ---------------------------------------------------------------- holes

void voxels_compare(const Voxelizer *voxelizer, const Voxels *a, const Voxels *b, const Voxels *either,
                    const Voxels *only_b)
{
    shader_use(voxelizer->compare);
    uint32_t words = (uint32_t)(a->bytes / sizeof(uint32_t));
    shader_set_uint(voxelizer->compare, "word_count", words);
    GLuint buffers[] = {a->words, b->words, either->words, only_b->words};
    for (GLuint i = 0; i < 4; i++)
        gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, i, buffers[i]);
    voxelize_dispatch(words);
    gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}
