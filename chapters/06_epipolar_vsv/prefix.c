// prefix: see prefix.h.
#include "prefix.h"

#include <stdlib.h>

enum { BEYOND_STEPS = 256 }; // see shaders/06_epipolar_vsv/beyond.glsl

static GLuint texels_of(GLuint buffer, GLenum format, const char *label)
{
    GLuint texels;
    gl.CreateTextures(GL_TEXTURE_BUFFER, 1, &texels);
    gl.ObjectLabel(GL_TEXTURE, texels, -1, label);
    gl.TextureBuffer(texels, format, buffer);
    return texels;
}

static PrefixSums sums_open(const Prefix *prefix, bool grey)
{
    const size_t channels = grey ? 1 : 4, phi = (size_t)prefix->phi;
    const size_t rows = (size_t)prefix->alpha * (size_t)prefix->theta;
    PrefixSums of = {
        .weights = gl_buffer(.label = "weights of phi",
                             .bytes = channels * (size_t)prefix->alpha * phi / 8 * sizeof(float)),
        .sums = gl_buffer(.label = "prefix sums", .bytes = channels * rows * phi / 32 * sizeof(float)),
        .beyond = gl_buffer(.label = "weights beyond the grid",
                            .bytes = channels * (size_t)prefix->alpha * (BEYOND_STEPS + 1) * sizeof(float))};
    of.weight_texels = texels_of(of.weights, GL_RGBA32F, "weights of phi");
    of.sum_texels = texels_of(of.sums, grey ? GL_R32F : GL_RGBA32F, "prefix sums");
    of.beyond_texels = texels_of(of.beyond, grey ? GL_R32F : GL_RGBA32F, "weights beyond the grid");
    return of;
}

static const PrefixSums *sums_of(const Prefix *prefix, const QueryView *view)
{
    return &prefix->of[view->light - view->scene->lights];
}

Prefix prefix_open(const AirlightSettings *settings, const VsvSettings *volume, const DepthMap *maps,
                   size_t map_count, bool interpolated)
{
    char *spread = vsv_definitions(volume);
    Prefix prefix = {.alpha = volume->alpha,
                     .theta = volume->theta,
                     .phi = volume->phi,
                     .rayleigh_share = settings->rayleigh_share};
    for (int any = 0; any < 2; any++) {
        char *definitions = text_format("%s\nANY_RAY %d\nBEYOND_STEPS %d", spread, any, BEYOND_STEPS);
        AirlightSettings with = *settings;
        with.variant = "intervals"; // the brute force's; of no meaning here
        with.definitions = definitions;
        with.shader = "06_epipolar_vsv/airlight_prefix.frag";
        with.number = interpolated;
        prefix.ask[any] = airlight_open(&with, maps, map_count);
        free(definitions);
    }
    for (size_t i = 0; i < map_count; i++) {
        const int kind = (int)maps[i].kind;
        if (prefix.weigh[kind])
            continue;
        char *definitions = text_format("%s\nMAP_KIND %d\nPHASE %d\nGREY %d\nBEYOND_STEPS %d", spread, kind,
                                        airlight_phase(settings->phase), settings->grey, BEYOND_STEPS);
        prefix.weigh[kind] = shader_open("weights", definitions, "06_epipolar_vsv/weights.comp");
        prefix.sum[kind] = shader_open("prefix sums", definitions, "06_epipolar_vsv/prefix.comp");
        prefix.beyond[kind] = shader_open("weights beyond", definitions, "06_epipolar_vsv/beyond_sums.comp");
        free(definitions);
    }
    free(spread);
    prefix.lights = map_count;
    prefix.of = memory_new(map_count + 1, sizeof *prefix.of, "sums");
    for (size_t i = 0; i < map_count; i++)
        prefix.of[i] = sums_open(&prefix, settings->grey);
    return prefix;
}

void prefix_close(Prefix *prefix)
{
    for (int any = 0; any < 2; any++)
        airlight_close(&prefix->ask[any]);
    for (int i = 0; i < 3; i++) {
        shader_close(prefix->weigh[i]);
        shader_close(prefix->sum[i]);
        shader_close(prefix->beyond[i]);
    }
    for (size_t i = 0; i < prefix->lights; i++) {
        gl_texture_delete(&prefix->of[i].weight_texels);
        gl_texture_delete(&prefix->of[i].sum_texels);
        gl_buffer_delete(&prefix->of[i].weights);
        gl_buffer_delete(&prefix->of[i].sums);
        gl_texture_delete(&prefix->of[i].beyond_texels);
        gl_buffer_delete(&prefix->of[i].beyond);
    }
    free(prefix->of);
}

static void dispatch(const Shader *shader, int wide, int high)
{
    shader_use(shader);
    gl.DispatchCompute((GLuint)(wide + 63) / 64, (GLuint)high, 1);
    gl.MemoryBarrier(GL_ALL_BARRIER_BITS);
}

static void weigh_by(const Prefix *prefix, const Shader *shader, const Vsv *vsv, const QueryView *view,
                     GLuint weights, int wide, int high)
{
    const vec3 extinction = view->scene->medium.scattering + view->scene->medium.absorption;
    vsv_bind(vsv, shader);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 6, weights);
    shader_set_vec3(shader, "extinction", (const float *)&extinction);
    shader_set_float(shader, "mean_cosine", view->scene->medium.mean_cosine);
    shader_set_float(shader, "rayleigh_share", prefix->rayleigh_share);
    dispatch(shader, wide, high);
}

void prefix_weigh(const Prefix *prefix, const Vsv *vsv, const QueryView *view)
{
    const PrefixSums *of = sums_of(prefix, view);
    const int kind = (int)view->map->kind;
    weigh_by(prefix, prefix->weigh[kind], vsv, view, of->weights, prefix->phi / 8, prefix->alpha);
    if (view->light->kind !=
        LIGHT_DIRECTIONAL) // whose rest has a closed form that costs no more than a table
        weigh_by(prefix, prefix->beyond[kind], vsv, view, of->beyond, prefix->alpha, 1);
}

void prefix_sum(const Prefix *prefix, const Vsv *vsv, const QueryView *view)
{
    const Shader *shader = prefix->sum[view->map->kind];
    vsv_bind(vsv, shader);
    gl.BindImageTexture(7, sums_of(prefix, view)->weight_texels, 0, GL_FALSE, 0, GL_READ_ONLY, GL_RGBA32F);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 6, sums_of(prefix, view)->sums);
    dispatch(shader, prefix->theta, prefix->alpha);
}

// Whether every view ray ends where the grid does, and passes the light outside its radius.
static bool plain_rays(const Vsv *vsv, const Light *light)
{
    const float least = sinf(vsv->range.alpha_least), most = sinf(vsv->range.alpha_most);
    const bool outside = vsv->frame.at_infinity || vsv->frame.distance * fminf(least, most) > light->radius;
    return vsv->whole && outside;
}

const Airlight *prefix_shader(const Prefix *prefix, const Vsv *vsv, const Light *light)
{
    return &prefix->ask[!plain_rays(vsv, light)];
}

void prefix_bind(const Prefix *prefix, const Vsv *vsv, const QueryView *view)
{
    const GLenum format = prefix->ask[0].settings.grey ? GL_R32F : GL_RGBA32F;
    gl.BindImageTexture(0, sums_of(prefix, view)->beyond_texels, 0, GL_FALSE, 0, GL_READ_ONLY, format);
    gl.BindImageTexture(5, vsv->single, 0, GL_FALSE, 0, GL_READ_ONLY, GL_R32UI);
    gl.BindImageTexture(6, sums_of(prefix, view)->sum_texels, 0, GL_FALSE, 0, GL_READ_ONLY, format);
    gl.BindImageTexture(7, sums_of(prefix, view)->weight_texels, 0, GL_FALSE, 0, GL_READ_ONLY, GL_RGBA32F);
}
