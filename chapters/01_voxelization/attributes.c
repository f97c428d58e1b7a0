// attributes: see attributes.h. The GPU's part stands in shaders/01_voxelization/store.glsl, sums.glsl, average.glsl, rank.comp, list_sums.comp.
#include "attributes.h"
#include <inttypes.h>
#include <stdlib.h>

enum { COUNT, SUMS, LIST, AVERAGE }; // STORE in store.glsl
enum { CHUNK = 128 };                // words, as in rank.comp
enum { SUMS_A_VOXEL = 7 };           // as in sums.glsl
static const double ALBEDO_STEPS = 1023.0, NORMAL_STEPS = 511.0;

Attributer attributer_open(void)
{
    static const char *const stores[] = {"STORE 0", "STORE 1\nSUMS 1", "STORE 2", "STORE 3"};
    static const char *const labels[] = {"count fragments", "sum attributes", "list fragments",
                                         "average by listing 4.9"};
    Attributer attributer = {
        .rank = shader_open("rank voxels", NULL, "01_voxelization/rank.comp"),
        .list_sums = shader_open("sum a list", "SUMS 1", "01_voxelization/list_sums.comp"),
    };
    for (int i = 0; i < 4; i++) {
        attributer.small[i] = shader_open(labels[i], stores[i], "01_voxelization/small.comp");
        attributer.large[i] = shader_open(labels[i], stores[i], "01_voxelization/list.vert",
                                          "01_voxelization/large.geom", "01_voxelization/large.frag");
    }
    return attributer;
}

void attributer_close(Attributer *attributer)
{
    shader_close(attributer->rank);
    shader_close(attributer->list_sums);
    for (int i = 0; i < 4; i++) {
        shader_close(attributer->small[i]);
        shader_close(attributer->large[i]);
    }
}

static void bind(GLuint binding, GLuint buffer)
{
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffer);
}

// A buffer of zeros; the program ends where the renderer has none so large.
static GLuint make_room(const char *what, uint64_t count, uint64_t bytes_each)
{
    GLint most = 0;
    gl.GetIntegerv(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most);
    if (count > (uint64_t)most / bytes_each)
        fail_work("%s: %" PRIu64 " times %" PRIu64
                  " bytes are needed; this renderer's buffers hold %d: choose a "
                  "lower resolution",
                  what, count, bytes_each, most);
    return gl_buffer(.label = what, .bytes = (size_t)((count > 0 ? count : 1) * bytes_each));
}

//[rank
Attributes attributes_rank(const Attributer *attributer, const Voxels *voxels)
{
    uint32_t words = (uint32_t)grid_words(&voxels->grid), chunks = (words + CHUNK - 1) / CHUNK;
    if (grid_voxels(&voxels->grid) > UINT32_MAX)
        fail_work("attributes number voxels by 32 bits, and the grid has %zu: choose a lower resolution",
                  grid_voxels(&voxels->grid));
    Attributes attributes = {.voxels = *voxels, .ranks = make_room("voxels' ranks", words, sizeof(uint32_t))};
    GLuint sums = make_room("set voxels a chunk", chunks, sizeof(uint32_t));
    uint32_t *before = memory_new(chunks, sizeof *before, "the voxels' ranks");
    shader_use(attributer->rank);
    bind(0, voxels->words);
    bind(4, attributes.ranks);
    bind(5, sums);
    shader_set_uint(attributer->rank, "word_count", words);
    for (int hand_out = 0; hand_out < 2; hand_out++) {
        shader_set_int(attributer->rank, "hand_out", hand_out);
        voxelize_dispatch(chunks);
        gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
        if (hand_out)
            break;
        gl_buffer_read(sums, 0, chunks * sizeof *before, before);
        for (uint32_t i = 0; i < chunks; i++) {
            uint32_t here = before[i];
            before[i] = attributes.slots;
            attributes.slots += here;
        }
        gl.NamedBufferSubData(sums, 0, (GLsizeiptr)(chunks * sizeof *before), before);
    }
    free(before);
    gl_buffer_delete(&sums);
    return attributes;
}
//]

void attributes_delete(Attributes *attributes)
{
    gl_buffer_delete(&attributes->ranks);
    gl_buffer_delete(&attributes->sums);
    gl_buffer_delete(&attributes->averages);
    gl_buffer_delete(&attributes->fragments);
    gl_buffer_delete(&attributes->fragment_count);
}

static void bind_materials(const RasterMesh *mesh, const Attributes *attributes)
{
    bind(0, attributes->voxels.words);
    bind(4, attributes->ranks);
    bind(6, mesh->triangle_materials);
    bind(7, mesh->materials);
    bind(8, attributes->fragment_count);
    bind(9, attributes->fragments);
}

// Every fragment once: the passes of `exact` again, that leave something else in the voxels.
static void each_fragment(const Attributer *attributer, const Fragments *from, const Attributes *attributes,
                          int store)
{
    const VoxelGrid *grid = &attributes->voxels.grid;
    for (int list = 0; list < LIST_COUNT; list++) {
        uint32_t count = from->lists->count[list], first = (uint32_t)list * from->lists->triangle_count;
        if (count == 0)
            continue;
        const Shader *shader = list == LIST_SMALL ? attributer->small[store] : attributer->large[store];
        if (list != LIST_SMALL)
            voxelize_begin(from->voxelizer->framebuffer, &attributes->voxels, grid->size[(list + 1) % 3],
                           grid->size[(list + 2) % 3]);
        voxelize_use(shader, from->mesh, grid);
        bind(3, from->lists->lists);
        bind_materials(from->mesh, attributes);
        bind(5, store == SUMS ? attributes->sums : attributes->averages);
        shader_set_uint(shader, "capacity", (uint32_t)attributes->capacity);
        if (list == LIST_SMALL) {
            shader_set_uint(shader, "list_first", first);
            shader_set_uint(shader, "list_count", count);
            voxelize_dispatch(count);
        } else {
            shader_set_int(shader, "axis", list);
            gl.BindVertexArray(from->voxelizer->vertex_array);
            gl.DrawArrays(GL_POINTS, (GLint)first, (GLsizei)count);
        }
        gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    }
}

static void clear_sums(Attributes *attributes)
{
    gl_buffer_delete(&attributes->sums);
    attributes->sums = make_room("attributes' sums", attributes->slots, SUMS_A_VOXEL * sizeof(uint32_t));
}

// A triangle is one fragment of a voxel, so only a scene of more triangles can fill a voxel with more than a sum holds.
static void check_sums(const RasterMesh *mesh, const Attributes *attributes)
{
    if ((uint32_t)mesh->index_count / 3 > ATTRIBUTES_MOST)
        free(attributes_read(attributes));
}

void attributes_sum(const Attributer *attributer, const Fragments *from, Attributes *attributes)
{
    clear_sums(attributes);
    each_fragment(attributer, from, attributes, SUMS);
    check_sums(from->mesh, attributes);
}

void attributes_average(const Attributer *attributer, const Fragments *from, Attributes *attributes)
{
    gl_buffer_delete(&attributes->averages);
    attributes->averages = make_room("attributes' averages", attributes->slots, sizeof(uint32_t));
    each_fragment(attributer, from, attributes, AVERAGE);
}

// ---------------------------------------------------------------- the list

static uint64_t read_count(const Attributes *attributes)
{
    uint32_t count[2];
    gl_buffer_read(attributes->fragment_count, 0, sizeof count, count);
    return (uint64_t)count[1] << 32 | count[0];
}

static void clear_count(Attributes *attributes)
{
    gl_buffer_delete(&attributes->fragment_count);
    attributes->fragment_count = make_room("fragments' count", 2, sizeof(uint32_t));
}

//[count
uint64_t fragment_list_count(const Attributer *attributer, const Fragments *from, Attributes *attributes)
{
    clear_count(attributes);
    each_fragment(attributer, from, attributes, COUNT);
    attributes->capacity = read_count(attributes);
    gl_buffer_delete(&attributes->fragments);
    attributes->fragments = make_room("voxel fragment list", attributes->capacity, 2 * sizeof(uint32_t));
    return attributes->capacity;
}

void fragment_list_fill(const Attributer *attributer, const Fragments *from, Attributes *attributes)
{
    clear_count(attributes);
    each_fragment(attributer, from, attributes, LIST);
    uint64_t came = read_count(attributes);
    if (came != attributes->capacity)
        fail_work("%" PRIu64 " fragments were counted and %" PRIu64 " came: the scene has changed between",
                  attributes->capacity, came);
}
//]

void fragment_list_sum(const Attributer *attributer, const Fragments *from, Attributes *attributes)
{
    clear_sums(attributes);
    voxelize_use(attributer->list_sums, from->mesh, &attributes->voxels.grid);
    bind_materials(from->mesh, attributes);
    bind(5, attributes->sums);
    shader_set_uint(attributer->list_sums, "fragment_total", (uint32_t)attributes->capacity);
    voxelize_dispatch((uint32_t)attributes->capacity);
    gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    check_sums(from->mesh, attributes);
}

// ---------------------------------------------------------------- what the host reads

VoxelAttributes *attributes_read(const Attributes *attributes)
{
    size_t slots = attributes->slots;
    uint32_t *sums = memory_new(slots * SUMS_A_VOXEL + 1, sizeof *sums, "attributes' sums");
    VoxelAttributes *read = memory_new(slots + 1, sizeof *read, "attributes");
    gl_buffer_read(attributes->sums, 0, slots * SUMS_A_VOXEL * sizeof *sums, sums);
    for (size_t i = 0; i < slots; i++) {
        const uint32_t *sum = sums + SUMS_A_VOXEL * i;
        double fragments = sum[0];
        if (sum[0] == 0)
            fail_work("a voxel is set that no triangle touches: attributes want the voxels of method exact");
        if (sum[0] > ATTRIBUTES_MOST)
            fail_work("a voxel has %" PRIu32 " fragments, and sums hold %u: choose a higher resolution",
                      sum[0], ATTRIBUTES_MOST);
        read[i].fragments = sum[0];
        for (int k = 0; k < 3; k++) {
            read[i].albedo[k] = (float)(sum[1 + k] / (ALBEDO_STEPS * fragments));
            read[i].normal[k] = (float)((int32_t)sum[4 + k] / (NORMAL_STEPS * fragments));
        }
    }
    free(sums);
    return read;
}

static uint32_t *read_words(GLuint buffer, size_t words)
{
    uint32_t *read = memory_new(words + 1, sizeof *read, "attributes");
    gl_buffer_read(buffer, 0, words * sizeof *read, read);
    return read;
}

uint32_t *attributes_read_averages(const Attributes *attributes)
{
    return read_words(attributes->averages, attributes->slots);
}

uint32_t *fragment_list_read(const Attributes *attributes)
{
    return read_words(attributes->fragments, 2 * (size_t)attributes->capacity);
}

size_t attributes_bytes(const Attributes *attributes)
{
    size_t slots = attributes->slots;
    return grid_words(&attributes->voxels.grid) * sizeof(uint32_t) +
           (attributes->sums != 0 ? slots * SUMS_A_VOXEL * sizeof(uint32_t) : 0) +
           (attributes->averages != 0 ? slots * sizeof(uint32_t) : 0) +
           (attributes->fragments != 0 ? (size_t)attributes->capacity * 2 * sizeof(uint32_t) : 0);
}
