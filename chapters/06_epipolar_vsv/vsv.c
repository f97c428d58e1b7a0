// vsv: see vsv.h.
#include "vsv.h"
#include "spread.h"

#include <stdlib.h>
#include <string.h>

bool vsv_spreads(const VsvSettings *settings)
{
    return strcmp(settings->warp, "borders") == 0;
}

char *vsv_definitions(const VsvSettings *settings)
{
    const int warp = strcmp(settings->warp, "square") == 0 ? 1 : vsv_spreads(settings) ? 2 : 0;
    return text_format("WARP %d\nTHETA_TABLE %d", warp, strcmp(settings->slices, "pixel") == 0);
}

static int level_count(const Vsv *vsv, int level) // α of a level of the mip chain
{
    int count = vsv->settings.alpha;
    for (int i = 0; i < level; i++)
        count = (count + 1) / 2;
    return count;
}

Vsv vsv_open(const VsvSettings *settings, const DepthMap *map)
{
    Vsv vsv = {.settings = *settings, .levels = 1, .kind = map->kind};
    const bool steps = strcmp(settings->scan, "logstep") == 0;
    vsv.words = settings->phi / 32;
    vsv.columns = settings->theta * vsv.words;
    const size_t level_bytes = (size_t)vsv.columns * sizeof(uint32_t);
    vsv.bytes = (size_t)settings->alpha * level_bytes;
    for (; steps && level_count(&vsv, vsv.levels - 1) > 1; vsv.levels++)
        vsv.bytes += (size_t)level_count(&vsv, vsv.levels) * level_bytes;
    vsv.voxels = gl_buffer(.label = "voxels", .bytes = vsv.bytes);
    gl.CreateTextures(GL_TEXTURE_BUFFER, 1, &vsv.texels);
    gl.ObjectLabel(GL_TEXTURE, vsv.texels, -1, "voxels, 128 a texel");
    gl.TextureBuffer(vsv.texels, GL_RGBA32UI, vsv.voxels);
    gl.CreateTextures(GL_TEXTURE_BUFFER, 1, &vsv.single);
    gl.ObjectLabel(GL_TEXTURE, vsv.single, -1, "voxels, 32 a texel");
    gl.TextureBuffer(vsv.single, GL_R32UI, vsv.voxels);
    vsv.first = gl_buffer(.label = "first voxel", .bytes = (size_t)vsv.columns * sizeof(uint32_t));
    vsv.slices = gl_buffer(.label = "slices", .bytes = 2 * (size_t)settings->theta * sizeof(uint32_t));
    vsv.borders =
        gl_buffer(.label = "borders of slices", .bytes = ((size_t)settings->theta + 1) * sizeof(float));
    vsv.spread = gl_buffer(.label = "spread of phi", .bytes = spread_bytes(settings->phi));
    char *spread = vsv_definitions(settings);
    const bool halves = strcmp(settings->shape, "paraboloid") == 0;
    if (halves && map->kind != LIGHT_POINT)
        fail_request("--set shape=paraboloid: is for maps of all directions; this light's map covers its "
                     "cone or the scene alone");
    if (halves) {
        vsv.halves = gl_texture(.label = "two paraboloids", .target = GL_TEXTURE_2D_ARRAY, .format = GL_R32F,
                                .width = map->resolution, .height = map->resolution, .depth = 2);
        vsv.to_halves = shader_open("to paraboloids", NULL, "06_epipolar_vsv/paraboloid.comp");
    }
    char *definitions = text_format("%s\nMAP_KIND %d\nPARABOLOID %d", spread, (int)map->kind, halves);
    vsv.resample = shader_open("resample", definitions, "06_epipolar_vsv/resample.comp");
    if (steps) {
        vsv.scan[VSV_UP] = shader_open("scan, up", NULL, "06_epipolar_vsv/scan_up.comp");
        vsv.scan[VSV_DOWN] = shader_open("scan, down", NULL, "06_epipolar_vsv/scan_down.comp");
        vsv.scan[VSV_SLICES] = shader_open("scan, slices", NULL, "06_epipolar_vsv/scan_slices.comp");
    } else {
        vsv.scan[VSV_COLUMNS] = shader_open("scan", NULL, "06_epipolar_vsv/scan_columns.comp");
    }
    free(spread);
    free(definitions);
    return vsv;
}

void vsv_close(Vsv *vsv)
{
    gl_texture_delete(&vsv->texels);
    gl_texture_delete(&vsv->single);
    gl_texture_delete(&vsv->halves);
    gl_buffer_delete(&vsv->voxels);
    gl_buffer_delete(&vsv->first);
    gl_buffer_delete(&vsv->slices);
    gl_buffer_delete(&vsv->borders);
    gl_buffer_delete(&vsv->spread);
    shader_close(vsv->to_halves);
    shader_close(vsv->resample);
    for (int i = 0; i < VSV_SCANS; i++)
        shader_close(vsv->scan[i]);
}

void vsv_aim(Vsv *vsv, const EpipolarFrame *frame, const EpipolarRange *range, const Camera *camera,
             int width, int height)
{
    vsv->frame = *frame;
    vsv->range = *range;
    if (vsv_spreads(&vsv->settings))
        spread_even(vsv->spread, range->phi);
    if (strcmp(vsv->settings.slices, "pixel") != 0)
        return;
    int needed;
    float *borders = epipolar_theta_borders(frame, range, camera, width, height, &needed);
    gl.NamedBufferSubData(vsv->borders, 0, ((GLsizeiptr)range->theta + 1) * (GLsizeiptr)sizeof(float),
                          borders);
    free(borders);
}

static void fill(GLuint buffer, uint32_t value)
{
    gl.ClearNamedBufferData(buffer, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &value);
}

void vsv_clear(const Vsv *vsv)
{
    fill(vsv->voxels, 0);
    fill(vsv->first, (uint32_t)vsv->settings.alpha);
}

void vsv_light_all(const Vsv *vsv)
{
    fill(vsv->slices, (uint32_t)vsv->settings.alpha);
}

bool vsv_apart(const Vsv *vsv, const Light *light)
{
    return vsv->frame.at_infinity || vsv->frame.distance > light->radius;
}

void vsv_bind(const Vsv *vsv, const Shader *shader)
{
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, vsv->voxels);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, vsv->first);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, vsv->borders);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 4, vsv->slices);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 7, vsv->spread);
    gl.BindImageTexture(4, vsv->texels, 0, GL_FALSE, 0, GL_READ_ONLY, GL_RGBA32UI);
    epipolar_set(shader, &vsv->frame, &vsv->range);
}

void vsv_voxelize_map(const Vsv *vsv, const Light *light, const DepthMap *map)
{
    const vec3 eye_from_origin = vsv->frame.eye - map->origin;
    vsv_bind(vsv, vsv->resample);
    gl.BindImageTexture(2, map->distance, 0, GL_TRUE, 0, GL_READ_ONLY, GL_R32F);
    if (vsv->to_halves) {
        const GLuint groups = (GLuint)(map->resolution + 7) / 8;
        gl.BindImageTexture(1, vsv->halves, 0, GL_TRUE, 0, GL_WRITE_ONLY, GL_R32F);
        shader_use(vsv->to_halves);
        gl.DispatchCompute(groups, groups, 2);
        gl.MemoryBarrier(GL_ALL_BARRIER_BITS);
        gl.BindImageTexture(2, vsv->halves, 0, GL_TRUE, 0, GL_READ_ONLY, GL_R32F);
    }
    shader_use(vsv->resample);
    shader_set_mat4(vsv->resample, "to_clip", (const float *)&map->to_clip);
    shader_set_vec3(vsv->resample, "eye_from_origin", (const float *)&eye_from_origin);
    shader_set_vec3(vsv->resample, "light_direction", (const float *)&light->direction);
    gl.DispatchCompute((GLuint)(vsv->settings.phi + 63) / 64, (GLuint)vsv->settings.theta, 1);
    gl.MemoryBarrier(GL_ALL_BARRIER_BITS);
}

static void scan_pass(const Vsv *vsv, int shader, int level, int rows)
{
    vsv_bind(vsv, vsv->scan[shader]);
    shader_use(vsv->scan[shader]);
    shader_set_int(vsv->scan[shader], "level", level);
    gl.DispatchCompute((GLuint)(vsv->columns + 63) / 64, (GLuint)rows, 1);
    gl.MemoryBarrier(GL_ALL_BARRIER_BITS);
}

void vsv_scan(const Vsv *vsv)
{
    // of each slice nothing is known yet: (no α has any shadow, all have nothing else) is what min and max begin from
    const uint32_t unknown[2] = {(uint32_t)vsv->settings.alpha, 0};
    gl.ClearNamedBufferData(vsv->slices, GL_RG32UI, GL_RG_INTEGER, GL_UNSIGNED_INT, unknown);
    if (vsv->scan[VSV_COLUMNS]) {
        scan_pass(vsv, VSV_COLUMNS, 0, 1);
        return;
    }
    const int top = vsv->levels - 1;
    for (int level = 1; level <= top; level++)
        scan_pass(vsv, VSV_UP, level, level_count(vsv, level));
    for (int level = top - 1; level >= 0; level--)
        scan_pass(vsv, VSV_DOWN, level, level_count(vsv, level));
    scan_pass(vsv, VSV_SLICES, top, 1);
}

int vsv_empty_columns(const Vsv *vsv)
{
    const size_t bytes = (size_t)vsv->columns * sizeof(uint32_t);
    uint32_t *first = memory_new((size_t)vsv->columns, sizeof *first, "word columns");
    int empty = 0;
    gl_buffer_read(vsv->first, 0, bytes, first);
    for (int i = 0; i < vsv->columns; i++)
        empty += first[i] >= (uint32_t)vsv->settings.alpha;
    free(first);
    return empty;
}

void vsv_show(const Vsv *vsv, const Shader *flat, GLuint picture, int width, int height)
{
    vsv_bind(vsv, flat);
    gl.BindImageTexture(0, picture, 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA32F);
    shader_use(flat);
    gl.DispatchCompute((GLuint)(width + 7) / 8, (GLuint)(height + 7) / 8, 1);
    gl.MemoryBarrier(GL_ALL_BARRIER_BITS);
}
