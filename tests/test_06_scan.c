// 06 epipolar voxelized shadow volumes: both scans against a plain loop, the mip chain, and what slices know.
#include "../chapters/06_epipolar_vsv/vsv.h"

#include <criterion/criterion.h>
#include <stdlib.h>

static const VsvSettings small = {.alpha = 37,
                                  .theta = 12,
                                  .phi = 128,
                                  .scan = "columns",
                                  .warp = "even",
                                  .slices = "uniform",
                                  .shape = "cube"};

// Random occluders, `share` of all voxels, as a voxelization leaves them; every fifth word column empty, every seventh with one word of all bits.
static uint32_t *occluders(const Vsv *vsv, double share)
{
    const size_t columns = (size_t)vsv->columns, alphas = (size_t)vsv->settings.alpha,
                 count = columns * alphas;
    uint32_t *words = memory_new(count, sizeof *words, "words");
    uint32_t *first = memory_new(columns, sizeof *first, "first words");
    uint64_t state = 9;
    for (size_t i = 0; i < count; i++)
        for (int bit = 0; bit < 32; bit++) {
            state = state * 6364136223846793005u + 1442695040888963407u;
            if ((double)(state >> 11) * 0x1p-53 < share && i % columns % 5 != 0)
                words[i] |= 1u << bit;
        }
    for (size_t column = 0; column < columns; column++) {
        if (column % 7 == 3)
            words[alphas / 2 * columns + column] = ~0u;
        first[column] = (uint32_t)alphas;
        for (size_t alpha = alphas; alpha-- > 0;)
            first[column] = words[alpha * columns + column] ? (uint32_t)alpha : first[column];
    }
    vsv_clear(vsv);
    gl.NamedBufferSubData(vsv->voxels, 0, (GLsizeiptr)(count * sizeof *words), words);
    gl.NamedBufferSubData(vsv->first, 0, (GLsizeiptr)(columns * sizeof *first), first);
    free(first);
    return words;
}

static Vsv volume_of(const VsvSettings *settings)
{
    const DepthMap map = {.kind = LIGHT_POINT, .resolution = 16};
    const Camera camera = {vec3_make(0, 0, 0), vec3_make(0, 0, -1), vec3_make(0, 1, 0), 1, 0, 0};
    const Light light = {.kind = LIGHT_POINT, .position = vec3_make(1, 1, -2)};
    const EpipolarFrame frame = epipolar_frame(&camera, &light);
    const EpipolarRange range = epipolar_range_full(settings->alpha, settings->theta, settings->phi);
    Vsv vsv = vsv_open(settings, &map);
    vsv_aim(&vsv, &frame, &range, &camera, 16, 16);
    return vsv;
}

static void check_scan(VsvSettings settings, double share)
{
    gl_open(GL_PLATFORM_OSMESA, 16, 16, "test");
    Vsv vsv = volume_of(&settings);
    uint32_t *words = occluders(&vsv, share);
    const size_t columns = (size_t)vsv.columns, alphas = (size_t)settings.alpha, row = (size_t)vsv.words;
    vsv_scan(&vsv);
    uint32_t *got = memory_new(vsv.bytes / sizeof *got, sizeof *got, "words");
    uint32_t(*slices)[2] = memory_new((size_t)settings.theta, sizeof *slices, "slices");
    gl_buffer_read(vsv.voxels, 0, vsv.bytes, got);
    gl_buffer_read(vsv.slices, 0, (size_t)settings.theta * sizeof *slices, slices);
    for (size_t i = columns; i < columns * alphas; i++)
        words[i] |= words[i - columns];
    for (size_t i = 0; i < columns * alphas; i++)
        cr_assert_eq(got[i], words[i], "alpha %zu, word column %zu", i / columns, i % columns);
    for (size_t theta = 0; theta < (size_t)settings.theta; theta++) {
        uint32_t any = (uint32_t)alphas, all = (uint32_t)alphas;
        for (size_t alpha = alphas; alpha-- > 0;) {
            bool some = false, whole = true;
            for (size_t w = 0; w < row; w++) {
                some = some || words[alpha * columns + theta * row + w] != 0;
                whole = whole && words[alpha * columns + theta * row + w] == ~0u;
            }
            any = some ? (uint32_t)alpha : any;
            all = whole ? (uint32_t)alpha : all;
        }
        cr_assert(slices[theta][0] == any && slices[theta][1] == all, "slice %zu: %u %u for %u %u", theta,
                  slices[theta][0], slices[theta][1], any, all);
    }
    // A level of the mip chain: the or of a block, which for what has been scanned is its last voxel's word; so it says nothing that the volume does not.
    size_t before = columns * alphas;
    for (int level = 1; level < vsv.levels; level++) {
        const size_t count = (alphas + ((size_t)1 << level) - 1) >> level;
        for (size_t i = 0; i < count * columns; i++) {
            const size_t last =
                (((i / columns + 1) << level) < alphas ? ((i / columns + 1) << level) : alphas) - 1;
            cr_assert_eq(got[before + i], words[last * columns + i % columns], "level %d", level);
        }
        before += count * columns;
    }
    cr_assert_eq(before * sizeof *got, vsv.bytes);
    free(words);
    free(got);
    free(slices);
    vsv_close(&vsv);
    gl_close();
}
static void check_scans(const char *scan)
{
    VsvSettings settings = small;
    settings.scan = scan;
    check_scan(settings, 0.02);
    settings.alpha = 64;
    settings.phi = 256;
    check_scan(settings, 0.2);
    settings.alpha = 1;
    check_scan(settings, 0.5);
    settings.alpha = 33;
    settings.phi = 512;
    check_scan(settings, 0.0005);
}
Test(vsv_scan, a_scan_of_columns_is_a_plain_or)
{
    check_scans("columns");
}
Test(vsv_scan, a_scan_in_log_steps_is_a_plain_or)
{
    check_scans("logstep");
}

Test(vsv_scan, empty_word_columns_are_counted)
{
    gl_open(GL_PLATFORM_OSMESA, 16, 16, "test");
    Vsv vsv = volume_of(&small);
    vsv_clear(&vsv);
    cr_assert_eq(vsv_empty_columns(&vsv), vsv.columns);
    free(occluders(&vsv, 0.2));
    int expected = 0;
    for (int i = 0; i < vsv.columns; i++)
        expected += i % 5 == 0 && i % 7 != 3;
    cr_assert_eq(vsv_empty_columns(&vsv), expected);
    vsv_close(&vsv);
    gl_close();
}
