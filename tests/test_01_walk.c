// 01 voxelization: the walk through the grid against closed forms and Embree; empty blocks.
#include "../chapters/01_voxelization/walk.h"
#include "voxel_bench.h"

#include <sys/wait.h>
#include <unistd.h>

enum { SIZE = 128 };

typedef struct WalkBench {
    Raster *raster;
    Walker walker;
    GLuint texture, framebuffer, blocks;
    Voxels voxels;
    double fetches;
} WalkBench;

// These bits in a grid.
static WalkBench walk_open(const VoxelGrid *grid, const uint32_t *bits, int size)
{
    WalkBench bench = {.raster = raster_open(),
                       .walker = walker_open(),
                       .texture =
                           gl_texture(.label = "walk", .format = GL_RGBA32F, .width = size, .height = size),
                       .blocks = blocks_create(grid),
                       .voxels = {.grid = *grid, .bytes = grid_words(grid) * 4}};
    bench.framebuffer = gl_framebuffer(.label = "walk", .color = {bench.texture});
    bench.voxels.words = gl_buffer(.label = "bits", .bytes = bench.voxels.bytes, .data = bits);
    blocks_find(&bench.walker, &bench.voxels, bench.blocks);
    return bench;
}

// RGBA, bottom row first; in new memory.
static float *walk_pixels(WalkBench *bench, WalkShow show, const Camera *camera, int size)
{
    WalkPicture picture = {.voxels = &bench->voxels,
                           .blocks = bench->blocks,
                           .show = show,
                           .camera = camera,
                           .width = size,
                           .height = size,
                           .framebuffer = bench->framebuffer};
    bench->fetches = walk_draw(&bench->walker, bench->raster, &picture);
    size_t bytes = (size_t)size * (size_t)size * 16;
    float *pixels = memory_new(1, bytes, "pixels");
    gl_texture_read(bench->texture, 0, GL_RGBA, GL_FLOAT, bytes, pixels);
    return pixels;
}

// A pixel that looks along an axis through voxels' centres, from inside the grid: planes crossed and distance are whole and half numbers.
static void check_axis(int axis, int sign)
{
    gl_open(GL_PLATFORM_OSMESA, 16, 16, "test");
    VoxelGrid grid = {{0, 0, 0}, 1.0, {40, 36, 47}};
    uint32_t *bits = memory_new(grid_words(&grid), 4, "bits");
    int voxel[3] = {20, 20, 20};
    voxel[axis] += 13 * sign;
    size_t i = (size_t)(voxel[2] * 36 + voxel[1]) * 40 + (size_t)voxel[0];
    bits[i >> 5] |= 1u << (i & 31);
    WalkBench bench = walk_open(&grid, bits, 1);
    vec3 eye = vec3_make(20.5f, 20.5f, 20.5f), way = {0};
    way[axis] = (float)sign;
    Camera camera = {
        .eye = eye, .target = eye + way, .up = vec3_make(0.3f, 1, 0.2f), .vertical_fov_rad = 0.5f};
    float *steps = walk_pixels(&bench, WALK_STEPS, &camera, 1);
    // heat's red channel is 3 × 13 planes / (40 + 36 + 47)
    cr_assert(fabsf(steps[0] - 39.0f / 123.0f) < 1e-6f, "axis %d %+d: %g planes", axis, sign, steps[0] * 41);
    float *distance = walk_pixels(&bench, WALK_DISTANCE, &camera, 1);
    // exp2(-1.5 · 12.5 / 123), within the error of exp2 in single precision
    cr_assert(fabsf(distance[0] - exp2f(-18.75f / 123.0f)) < 1e-4f, "axis %d %+d: distance %g", axis, sign,
              distance[0]);
    float *normals = walk_pixels(&bench, WALK_NORMALS, &camera, 1);
    for (int k = 0; k < 3; k++) {
        float n = k == axis ? 0.5f - 0.5f * (float)sign : 0.5f;
        cr_assert(fabsf(normals[k] - n * n * distance[0]) < 1e-4f, "axis %d %+d: colour %d", axis, sign, k);
    }
    free(steps);
    free(distance);
    free(normals);
    free(bits);
    gl_close();
}
Test(walk, along_an_axis_counts_planes_and_distance)
{
    for (int axis = 0; axis < 3; axis++) {
        check_axis(axis, 1);
        check_axis(axis, -1);
    }
}

// Rays that pass within rounding of a voxel's edge may take either neighbour: the walk's planes and Embree's edges are rounded differently. Such
// pixels are few (a strip of 1e-5 voxel along edges that are 128/32 pixels apart); one in a thousand is allowed.
static void check_embree(const char *scene, int resolution, WalkShow show)
{
    Bench bench = bench_open(scene);
    // not straight ahead: in a square picture of a room the rays of the diagonals would meet edges exactly
    bench.scene->camera.eye += vec3_make(0.013f, 0.007f, 0.0f) * (bench.scene->upper - bench.scene->lower);
    VoxelGrid grid = scene_grid(bench.scene, resolution);
    uint32_t *bits = bits_exact(&bench, &grid), *true_bits = truth_voxels(&bench.mesh, &grid);
    WalkBench walk = walk_open(&grid, bits, SIZE);
    float *pixels = walk_pixels(&walk, show, &bench.scene->camera, SIZE);
    Image truth = walk_truth(true_bits, &grid, show, NULL, &bench.scene->camera, SIZE, SIZE);
    int wrong = 0, sky = 0;
    for (int y = 0; y < SIZE; y++)
        for (int x = 0; x < SIZE; x++) {
            const float *got = pixels + 4 * (y * SIZE + x),
                        *expected = truth.pixels + 3 * ((SIZE - 1 - y) * SIZE + x);
            float off = 0.0f;
            for (int k = 0; k < 3; k++)
                off = fmaxf(off, fabsf(got[k] - expected[k]));
            wrong += off > 1e-3f; // a face's colour differs by 0.1 and more, a plane by 3/88 or so
            sky += expected[2] == 0.03f;
        }
    cr_assert(sky < SIZE * SIZE * 9 / 10 || show == WALK_STEPS, "%s: the picture shows sky", scene);
    cr_assert(wrong <= SIZE * SIZE / 1000, "%s: %d of %d pixels differ from Embree's", scene, wrong,
              SIZE * SIZE);
    free(bits);
    free(true_bits);
    free(pixels);
    image_free(&truth);
}
Test(walk, shows_what_embree_shows_of_the_bunny)
{
    check_embree("bunny", 32, WALK_NORMALS);
}
Test(walk, shows_what_embree_shows_of_cornell)
{
    check_embree("cornell", 32, WALK_NORMALS);
}
Test(walk, shows_what_embree_shows_of_the_colonnade)
{
    check_embree("colonnade", 48, WALK_NORMALS);
}
Test(walk, counts_the_planes_that_embree_says)
{
    check_embree("bunny", 32, WALK_STEPS);
}

// The pixels of a scene with and without --everything, in one process each: shaders are defined once.
static float *pixels_apart(const char *scene, int resolution, bool everything, double *fetches)
{
    int ends[2];
    size_t bytes = (size_t)SIZE * SIZE * 16, at = 0;
    cr_assert_eq(pipe(ends), 0, "no pipe");
    if (fork() == 0) {
        if (everything)
            shader_define_all("EVERYTHING", 1);
        Bench bench = bench_open(scene);
        VoxelGrid grid = scene_grid(bench.scene, resolution);
        WalkBench walk = walk_open(&grid, bits_exact(&bench, &grid), SIZE);
        float *drawn = walk_pixels(&walk, WALK_STEPS, &bench.scene->camera, SIZE);
        bool whole = write(ends[1], &walk.fetches, sizeof walk.fetches) == sizeof walk.fetches;
        while (whole && at < bytes) {
            ssize_t written = write(ends[1], (char *)drawn + at, bytes - at);
            whole = written > 0;
            at += whole ? (size_t)written : 0;
        }
        _exit(!whole);
    }
    close(ends[1]);
    float *pixels = memory_new(1, bytes, "pixels");
    cr_assert_eq(read(ends[0], fetches, sizeof *fetches), (ssize_t)sizeof *fetches, "nothing came out");
    for (ssize_t got = 1; at < bytes && got > 0; at += (size_t)got)
        got = read(ends[0], (char *)pixels + at, bytes - at);
    cr_assert_eq(at, bytes, "%zu of %zu bytes came out", at, bytes);
    close(ends[0]);
    wait(NULL);
    return pixels;
}
static void check_blocks(const char *scene, int resolution, double most)
{
    double fetches, fetches_everything;
    float *got = pixels_apart(scene, resolution, false, &fetches);
    float *everything = pixels_apart(scene, resolution, true, &fetches_everything);
    // the same bits: a stride ends in the very voxel that single steps come to
    cr_assert_eq(memcmp(got, everything, (size_t)SIZE * SIZE * 16), 0, "%s: another picture", scene);
    cr_assert(fetches < most * fetches_everything, "%s: %g fetches instead of %g", scene, fetches,
              fetches_everything);
    free(got);
    free(everything);
}
Test(walk, strides_across_empty_blocks_and_sees_the_same)
{
    check_blocks("bunny", 64, 0.7);
    check_blocks("cornell", 61, 0.7);
    check_blocks("colonnade", 50, 1.0); // from inside, few blocks are empty
}

// One voxel in the far corner of a block: its block alone is not empty. To cross it as if it were would lose the voxel.
Test(walk, a_block_with_one_voxel_is_not_empty)
{
    gl_open(GL_PLATFORM_OSMESA, 16, 16, "test");
    VoxelGrid grid = {{0, 0, 0}, 1.0, {21, 19, 17}};
    for (int corner = 0; corner < 2; corner++) {
        int voxel = corner ? 15 : 8;
        uint32_t *bits = memory_new(grid_words(&grid), 4, "bits");
        size_t i = (size_t)(voxel * 19 + voxel) * 21 + (size_t)voxel;
        bits[i >> 5] |= 1u << (i & 31);
        WalkBench bench = walk_open(&grid, bits, SIZE);
        cr_assert_eq(blocks_empty(&grid, bench.blocks), blocks_count(&grid) - 1,
                     "voxel %d: not one block is full", voxel);
        Camera camera = {.eye = vec3_make(40, 30, 50),
                         .target = vec3_make(11, 11, 11),
                         .up = vec3_make(0, 1, 0),
                         .vertical_fov_rad = 0.4f};
        float *seen = walk_pixels(&bench, WALK_NORMALS, &camera, SIZE);
        gl.ClearNamedBufferData(bench.blocks, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, NULL);
        float *lost = walk_pixels(&bench, WALK_NORMALS, &camera, SIZE);
        int differ = 0;
        for (int p = 0; p < SIZE * SIZE; p++)
            differ += memcmp(seen + 4 * p, lost + 4 * p, 16) != 0;
        // a voxel seen from 55 voxels away covers about 128² / (0.4 · 55)² = 34 pixels a face
        cr_assert(differ > 20, "voxel %d: %d pixels show it", voxel, differ);
        free(seen);
        free(lost);
        free(bits);
    }
}

// Rows of 21 voxels begin anywhere in a word, so blocks' rows of 8 lie across two words in every way.
Test(walk, each_voxel_alone_fills_its_block)
{
    gl_open(GL_PLATFORM_OSMESA, 16, 16, "test");
    VoxelGrid grid = {{0, 0, 0}, 1.0, {21, 9, 3}};
    uint32_t bits[(21 * 9 * 3 + 31) / 32] = {0};
    WalkBench bench = walk_open(&grid, bits, SIZE);
    for (size_t i = 0; i < grid_voxels(&grid); i++) {
        bits[i >> 5] = 1u << (i & 31);
        gl.NamedBufferSubData(bench.voxels.words, 0, sizeof bits, bits);
        blocks_find(&bench.walker, &bench.voxels, bench.blocks);
        cr_assert_eq(blocks_empty(&grid, bench.blocks), blocks_count(&grid) - 1,
                     "voxel %zu: not one block is full", i);
        bits[i >> 5] = 0;
    }
}

// A ray exactly through lattice edges, x = y + 3: at each edge it crosses the x plane first, so it goes by (11, 7) and (11, 8), never by
// (10, 8). It comes to the edge at (11, 8) by a stride across an empty block.
Test(walk, crosses_x_before_y_where_a_stride_ends_in_an_edge)
{
    gl_open(GL_PLATFORM_OSMESA, 16, 16, "test");
    VoxelGrid grid = {{0, 0, 0}, 1.0, {40, 40, 40}};
    Camera camera = {.eye = vec3_make(-2, -5, 20.5f),
                     .target = vec3_make(8, 5, 20.5f),
                     .up = vec3_make(0, 0, 1),
                     .vertical_fov_rad =
                         1e-8f}; // so small that the middle ray is the view direction to its last bit
    const struct {
        int x, y;
        bool hit;
    } cases[] = {{10, 8, false}, {11, 8, true}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        uint32_t *bits = memory_new(grid_words(&grid), 4, "bits");
        size_t voxel = (size_t)(20 * 40 + cases[i].y) * 40 + (size_t)cases[i].x;
        bits[voxel >> 5] |= 1u << (voxel & 31);
        WalkBench bench = walk_open(&grid, bits, 1);
        float *seen = walk_pixels(&bench, WALK_DISTANCE, &camera, 1);
        cr_assert_eq(seen[0] > 0.5f, cases[i].hit, "voxel (%d, %d): red %g", cases[i].x, cases[i].y,
                     (double)seen[0]);
        free(seen);
        free(bits);
    }
}

// ---------------------------------------------------------------- addresses

// Grids of more than 2^32 voxels do not fit here, but their words' numbers can be asked for.
Test(walk, words_are_numbered_right_beyond_32_bits)
{
    char folder[] = "/tmp/addresses-XXXXXX";
    cr_assert(mkdtemp(folder) != NULL, "no folder");
    char *path = text_format("%s/address.comp", folder);
    FILE *file = fopen(path, "w");
    fputs("#include \"common/grid.glsl\"\n"
          "layout(local_size_x = 1) in;\n"
          "layout(std430, binding = 0) buffer Out { uint word, place; };\n"
          "uniform ivec3 voxel;\n"
          "void main() { word = grid_word(voxel, place); }\n",
          file);
    fclose(file);
    gl_open(GL_PLATFORM_OSMESA, 16, 16, "test");
    shader_search_first(folder);
    Shader *shader = shader_open("address", NULL, "address.comp");
    GLuint out = gl_buffer(.label = "out", .bytes = 8);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, out);
    const int cases[][6] = {{5000, 4999, 4001, 4999, 4998, 4000}, {2000, 2000, 2000, 1999, 1999, 1999},
                            {1626, 1626, 1626, 37, 1625, 1625},   {1625, 1625, 1625, 1624, 1624, 1624},
                            {65536, 65536, 1, 65535, 65535, 0},   {33, 7, 5, 1, 1, 0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const int *size = cases[i], *voxel = cases[i] + 3;
        uint64_t bit = ((uint64_t)voxel[2] * (uint64_t)size[1] + (uint64_t)voxel[1]) * (uint64_t)size[0] +
                       (uint64_t)voxel[0];
        shader_use(shader);
        shader_set_ivec3(shader, "grid_size", size);
        shader_set_ivec3(shader, "voxel", voxel);
        gl.DispatchCompute(1, 1, 1);
        gl.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
        uint32_t got[2];
        gl_buffer_read(out, 0, 8, got);
        cr_assert(got[0] == (uint32_t)(bit >> 5) && got[1] == (bit & 31), "%d x %d x %d: word %u, bit %u",
                  size[0], size[1], size[2], got[0], got[1]);
    }
    unlink(path);
    rmdir(folder);
    free(path);
}
