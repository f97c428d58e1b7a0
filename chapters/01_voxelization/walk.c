// walk: see walk.h.
#include "walk.h"
#include <stdlib.h>

enum { BLOCK_SIDE = 8, FETCH_SLOTS = 64, GROUP = 64 }; // as in blocks.comp, walk.frag, grid_lines.comp

Walker walker_open(void)
{
    return (Walker){
        .blocks = shader_open("find blocks", NULL, "common/blocks.comp"),
        .walk = shader_open("walk", NULL, "common/fullscreen.vert", "01_voxelization/walk.frag"),
        .grid_lines = shader_open("grid lines", NULL, "01_voxelization/grid_lines.comp"),
        .fetches = gl_buffer(.label = "fetches", .bytes = FETCH_SLOTS * sizeof(uint32_t)),
    };
}

void walker_close(Walker *walker)
{
    shader_close(walker->blocks);
    shader_close(walker->walk);
    shader_close(walker->grid_lines);
    gl_buffer_delete(&walker->fetches);
}

// ---------------------------------------------------------------- blocks

static void block_sides(const VoxelGrid *grid, GLuint sides[3])
{
    for (int k = 0; k < 3; k++)
        sides[k] = (GLuint)(grid->size[k] + BLOCK_SIDE - 1) / BLOCK_SIDE;
}

size_t blocks_count(const VoxelGrid *grid)
{
    GLuint sides[3];
    block_sides(grid, sides);
    return (size_t)sides[0] * sides[1] * sides[2];
}

GLuint blocks_create(const VoxelGrid *grid)
{
    return gl_buffer(.label = "blocks", .bytes = blocks_count(grid) * sizeof(uint32_t));
}

void blocks_find(const Walker *walker, const Voxels *voxels, GLuint blocks)
{
    GLuint sides[3];
    block_sides(&voxels->grid, sides);
    shader_use(walker->blocks);
    voxelize_set_grid(walker->blocks, &voxels->grid);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, voxels->words);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, blocks);
    gl.DispatchCompute((sides[0] + GROUP - 1) / GROUP, sides[1], sides[2]);
    gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

size_t blocks_empty(const VoxelGrid *grid, GLuint blocks)
{
    size_t count = blocks_count(grid), empty = 0;
    uint32_t *set = memory_new(count, sizeof *set, "the blocks");
    gl_buffer_read(blocks, 0, count * sizeof *set, set);
    for (size_t i = 0; i < count; i++)
        empty += set[i] == 0;
    free(set);
    return empty;
}

// ---------------------------------------------------------------- pictures

// In double: far from the world's origin the difference of float32 numbers is all there is.
static vec3 eye_in_grid(const Camera *camera, const VoxelGrid *grid)
{
    vec3 eye = {0};
    for (int k = 0; k < 3; k++)
        eye[k] = (float)(((double)camera->eye[k] - grid->origin[k]) / grid->voxel_size);
    return eye;
}

static float pixel_angle_rad(const Camera *camera, int height)
{
    return 2.0f * tanf(0.5f * camera->vertical_fov_rad) / (float)height;
}

double walk_draw(const Walker *walker, const Raster *raster, const WalkPicture *picture)
{
    const VoxelGrid *grid = &picture->voxels->grid;
    const Voxels *marked = picture->marked ? picture->marked : picture->voxels;
    vec3 eye = eye_in_grid(picture->camera, grid);
    gl.ClearNamedBufferData(walker->fetches, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, NULL);
    shader_use(walker->walk);
    voxelize_set_grid(walker->walk, grid);
    raster_set_camera(walker->walk, picture->camera, (float)picture->width / (float)picture->height);
    shader_set_vec3(walker->walk, "eye_in_grid", (const float *)&eye);
    shader_set_int(walker->walk, "show", (int)picture->show);
    shader_set_int(walker->walk, "mark", picture->marked != NULL);
    shader_set_int(walker->walk, "lines", picture->lines);
    shader_set_float(walker->walk, "line_width", 0.5f * pixel_angle_rad(picture->camera, picture->height));
    const Attributes none = {0}, *stored = picture->stored ? picture->stored : &none;
    shader_set_int(walker->walk, "averaged", picture->averaged);
    GLuint buffers[] = {picture->voxels->words, picture->blocks,
                        marked->words,          walker->fetches,
                        stored->ranks,          picture->averaged ? stored->averages : stored->sums,
                        stored->voxels.words};
    for (GLuint i = 0; i < sizeof buffers / sizeof *buffers; i++)
        gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, i, buffers[i]);
    raster_fullscreen(raster, walker->walk, picture->framebuffer, picture->width, picture->height);
    gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    uint32_t fetches[FETCH_SLOTS];
    gl_buffer_read(walker->fetches, 0, sizeof fetches, fetches);
    double sum = 0.0;
    for (int i = 0; i < FETCH_SLOTS; i++)
        sum += fetches[i];
    return sum;
}

void grid_lines_draw(const Walker *walker, const GBuffer *gbuffer, const Camera *camera,
                     const VoxelGrid *grid, GLuint picture)
{
    const Shader *shader = walker->grid_lines;
    vec3 eye = eye_in_grid(camera, grid);
    shader_use(shader);
    raster_set_camera(shader, camera, (float)gbuffer->width / (float)gbuffer->height);
    voxelize_set_grid(shader, grid);
    shader_set_vec3(shader, "eye_in_grid", (const float *)&eye);
    shader_set_float(shader, "voxel_metres", (float)grid->voxel_size);
    shader_set_float(shader, "pixel_angle", pixel_angle_rad(camera, gbuffer->height));
    gl.MemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT);
    gl.BindImageTexture(0, picture, 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA32F);
    gl.BindImageTexture(1, gbuffer->distance, 0, GL_FALSE, 0, GL_READ_ONLY, GL_R32F);
    gl.BindImageTexture(2, gbuffer->normal, 0, GL_FALSE, 0, GL_READ_ONLY, GL_RGBA16F);
    gl.DispatchCompute((GLuint)(gbuffer->width + GROUP - 1) / GROUP, (GLuint)gbuffer->height, 1);
    gl.MemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT |
                     GL_FRAMEBUFFER_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
}

// ---------------------------------------------------------------- truth

static float clamp01(float x)
{
    return fminf(fmaxf(x, 0.0f), 1.0f);
}

// The planes between the voxel where a ray comes into the grid and voxel `hit`, or where it leaves the grid (`hit` NULL).
static int planes_crossed(vec3 eye, vec3 direction, const int size[3], const int *hit)
{
    float enter = 0.0f, leave = INFINITY;
    int in = -1, out = -1; // axes of the faces
    for (int k = 0; k < 3; k++) {
        float from = ((direction[k] > 0.0f ? 0.0f : (float)size[k]) - eye[k]) / direction[k];
        float to = ((direction[k] > 0.0f ? (float)size[k] : 0.0f) - eye[k]) / direction[k];
        in = from > enter ? k : in;
        enter = fmaxf(enter, from);
        out = to < leave ? k : out;
        leave = fminf(leave, to);
    }
    if (enter > leave)
        return 0;
    int crossed = 0;
    for (int k = 0; k < 3; k++) {
        float last = (float)size[k] - 1.0f;
        float first = fminf(fmaxf(floorf(eye[k] + enter * direction[k]), 0.0f), last);
        float end = fminf(fmaxf(floorf(eye[k] + leave * direction[k]), 0.0f), last);
        if (k == in)
            first = direction[k] > 0.0f ? 0.0f : last;
        if (k == out)
            end = direction[k] > 0.0f ? last + 1.0f : -1.0f;
        crossed += abs((hit ? hit[k] : (int)end) - (int)first);
    }
    return crossed;
}

// The value of set bit i: values come in the bits' order, and the words' ranks say how many bits are set before.
static vec3 value_of(const uint32_t *bits, const uint32_t *ranks, const vec3 *values, size_t i)
{
    uint32_t before = bits[i >> 5] & ((UINT32_C(1) << (i & 31)) - 1);
    return values[ranks[i >> 5] + (uint32_t)__builtin_popcount(before)];
}

static vec3 face_color(WalkShow show, vec3 normal, float near, vec3 value)
{
    const vec3 half = vec3_make(0.5f, 0.5f, 0.5f), stone = vec3_make(0.95f, 0.90f, 0.82f),
               sun = vec3_make(0.30f, 0.80f, 0.52f); // of walk.frag
    if (show == WALK_DISTANCE)
        return vec3_make(near, near, near);
    if (show == WALK_NORMALS || show == WALK_MEAN_NORMALS) {
        vec3 half_way = half + 0.5f * (show == WALK_NORMALS ? normal : value);
        return near * half_way * half_way;
    }
    return near * (0.45f + 0.50f * vec3_dot(normal, sun)) * (show == WALK_ALBEDO ? value : stone);
}

Image walk_truth(const uint32_t *bits, const VoxelGrid *grid, WalkShow show, const vec3 *values,
                 const Camera *camera, int width, int height)
{
    // a metre a voxel, the corner in the origin: what the picture shows has no unit
    VoxelGrid unit = *grid;
    unit.voxel_size = 1.0;
    for (int k = 0; k < 3; k++)
        unit.origin[k] = 0.0;
    Mesh mesh = truth_voxel_mesh(bits, &unit);
    Truth *truth = truth_open(&mesh);
    Image image = image_make(width, height, 3);
    vec3 eye = eye_in_grid(camera, grid);
    mat4 turn = mat4_inverse(mat4_look_at(vec3_make(0, 0, 0), camera->target - camera->eye, camera->up));
    float half = tanf(0.5f * camera->vertical_fov_rad), aspect = (float)width / (float)height;
    float sides = (float)(grid->size[0] + grid->size[1] + grid->size[2]);
    size_t words = grid_words(grid);
    uint32_t *ranks = memory_new(words + 1, sizeof *ranks, "the true voxels' ranks");
    for (size_t i = 0; i < words; i++)
        ranks[i + 1] = ranks[i] + (uint32_t)__builtin_popcount(bits[i]);
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            float u = (2.0f * ((float)x + 0.5f) / (float)width - 1.0f) * half * aspect;
            float v = (1.0f - 2.0f * ((float)y + 0.5f) / (float)height) * half;
            vec4 way = mat4_transform(turn, (vec4){u, v, -1.0f, 0.0f});
            vec3 direction = vec3_normalize(vec3_make(way[0], way[1], way[2]));
            TruthHit hit = truth_ray(truth, eye, direction);
            bool found = isfinite(hit.distance);
            vec3 color = vec3_make(0.02f, 0.025f, 0.03f); // SKY of walk.frag
            size_t i = found ? mesh.triangle_material[hit.triangle] : 0, row = (size_t)grid->size[0];
            if (show == WALK_STEPS) {
                int voxel[3] = {(int)(i % row), (int)(i / row % (size_t)grid->size[1]),
                                (int)(i / row / (size_t)grid->size[1])};
                int crossed = planes_crossed(eye, direction, grid->size, found ? voxel : NULL);
                float value = 3.0f * (float)crossed / sides;
                color = vec3_make(clamp01(value), clamp01(value - 1.0f), clamp01(value - 2.0f));
            } else if (found) {
                vec3 value = values ? value_of(bits, ranks, values, i) : vec3_make(0, 0, 0);
                color = face_color(show, hit.normal, exp2f(-1.5f * hit.distance / sides), value);
            }
            for (int k = 0; k < 3; k++)
                image.pixels[((size_t)y * (size_t)width + (size_t)x) * 3 + (size_t)k] = color[k];
        }
    truth_close(truth);
    free(ranks);
    free(mesh.positions);
    free(mesh.normals);
    free(mesh.indices);
    free(mesh.triangle_material);
    return image;
}
