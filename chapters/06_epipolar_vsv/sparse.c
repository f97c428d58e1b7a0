// sparse: see sparse.h.
#include "sparse.h"

#include <stdlib.h>

enum { SPARSE_WIDE = 256 }; // groups in a row of the list's dispatch; a power of 2

static Airlight open_pass(const AirlightSettings *with, const char *shader, const DepthMap *maps,
                          size_t map_count)
{
    AirlightSettings settings = *with;
    settings.shader = shader;
    return airlight_open(&settings, maps, map_count);
}

Sparse sparse_open(const AirlightSettings *settings, const VsvSettings *volume, const DepthMap *maps,
                   size_t map_count)
{
    char *spread = vsv_definitions(volume);
    char *definitions = text_format("%s\nSPARSE_WIDE %d", spread, SPARSE_WIDE);
    free(spread);
    AirlightSettings with = *settings;
    with.variant = "intervals"; // the brute force's; of no meaning here
    with.definitions = definitions;
    with.number = 0;
    const Sparse sparse = {.rows = open_pass(&with, "06_epipolar_vsv/sparse_rows.comp", maps, map_count),
                           .pixels = open_pass(&with, "06_epipolar_vsv/sparse_pixels.comp", maps, map_count),
                           .left = open_pass(&with, "06_epipolar_vsv/sparse_left.comp", maps, map_count),
                           .row_picture = gl_texture(.label = "airlight of rows", .format = GL_RGBA32F,
                                                     .width = volume->theta, .height = volume->alpha),
                           .alpha = volume->alpha,
                           .theta = volume->theta};
    free(definitions);
    return sparse;
}

void sparse_close(Sparse *sparse)
{
    airlight_close(&sparse->rows);
    airlight_close(&sparse->pixels);
    airlight_close(&sparse->left);
    gl_texture_delete(&sparse->row_picture);
}

static void bind(const Sparse *sparse, const Airlight *pass, const Vsv *vsv, const QueryView *view,
                 GLuint picture)
{
    vsv_bind(vsv, pass->shader[view->map->kind]);
    airlight_bind(pass, view->gbuffer, view->camera, view->scene, view->light, view->map, picture);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, sparse->pixels.counters);
    gl.BindImageTexture(5, sparse->row_picture, 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA32F);
}

static void dispatch(int wide, int high)
{
    gl.DispatchCompute((GLuint)(wide + 7) / 8, (GLuint)(high + 7) / 8, 1);
    gl.MemoryBarrier(GL_ALL_BARRIER_BITS);
}

//[sparse
void sparse_airlight(const Sparse *sparse, const Vsv *vsv, const QueryView *view, GLuint picture)
{
    const int width = view->gbuffer->width, height = view->gbuffer->height;
    const uint32_t start[4] = {SPARSE_WIDE, 0, 1, 0}; // groups, none yet; and no pixels
    GLuint list = gl_buffer(.label = "pixels that ask for themselves",
                            .bytes = sizeof start + (size_t)width * (size_t)height * sizeof(uint32_t));
    gl.NamedBufferSubData(list, 0, sizeof start, start);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 6, list);
    gl.BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, list);
    bind(sparse, &sparse->rows, vsv, view, picture);
    dispatch(sparse->theta, sparse->alpha);
    bind(sparse, &sparse->pixels, vsv, view, picture);
    dispatch(width, height);
    bind(sparse, &sparse->left, vsv, view, picture);
    gl.DispatchComputeIndirect(0);
    gl.MemoryBarrier(GL_ALL_BARRIER_BITS);
    gl_buffer_delete(&list);
}
//]
