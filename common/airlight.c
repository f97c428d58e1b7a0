// airlight: see airlight.h.
#include "airlight.h"

#include <stdlib.h>
#include <string.h>

static int index_of(const char *const *names, const char *name, const char *what)
{
    for (int i = 0; names[i]; i++)
        if (strcmp(names[i], name) == 0)
            return i;
    fail_work("no %s '%s'", what, name);
}

static const char *const sampled[] = {"march", "jittered", "equiangular", "factored", NULL};
static const char *const variants[] = {"intervals", "signed", NULL};
static const char *const phases[] = {
    "uniform", "rayleigh", "henyey_greenstein", "hoffman_preetham", "hoffman_preetham_normalized", NULL};

int airlight_phase(const char *name)
{
    return index_of(phases, name, "phase function");
}

Airlight airlight_open(const AirlightSettings *settings, const DepthMap *maps, size_t map_count)
{
    Airlight airlight = {.settings = *settings};
    airlight.no_table = gl_texture(.label = "no table", .format = GL_R32F, .width = 1, .height = 1);
    airlight.counters = gl_buffer(.label = "airlight counters", .bytes = 2 * sizeof(uint32_t));
    const bool segments = strcmp(settings->method, "segments") == 0;
    const char *file = settings->shader ? settings->shader
                       : segments       ? "common/airlight_segments.comp"
                                        : "common/airlight_march.comp";
    const int method = settings->shader ? settings->number
                       : segments       ? 0
                                        : index_of(sampled, settings->method, "method");
    airlight.drawn = strcmp(strrchr(file, '.'), ".frag") == 0;
    gl.CreateVertexArrays(1, &airlight.no_attributes);
    for (size_t i = 0; i < map_count; i++) {
        const int kind = (int)maps[i].kind;
        if (airlight.shader[kind])
            continue;
        // the order of LightKind; in the shaders: CUBE 0, SPOT 1, DIRECTIONAL 2
        char *definitions = text_format("METHOD %d\nVARIANT %d\nPHASE %d\nAIRLIGHT_NODES %d\nMAP_KIND "
                                        "%d\nSHADOWED %d\nEXACT %d\nCOUNT %d\nGREY %d\nRAY_FRAGMENT %d\n%s",
                                        method, index_of(variants, settings->variant, "variant"),
                                        airlight_phase(settings->phase), settings->nodes, kind,
                                        settings->shadowed, settings->exact, settings->count, settings->grey,
                                        airlight.drawn, settings->definitions ? settings->definitions : "");
        airlight.shader[kind] = airlight.drawn
                                    ? shader_open("airlight", definitions, "common/fullscreen.vert", file)
                                    : shader_open("airlight", definitions, file);
        free(definitions);
    }
    return airlight;
}

void airlight_close(Airlight *airlight)
{
    for (int i = 0; i < 3; i++)
        shader_close(airlight->shader[i]);
    gl_texture_delete(&airlight->no_table);
    gl_buffer_delete(&airlight->counters);
    gl.DeleteVertexArrays(1, &airlight->no_attributes);
    *airlight = (Airlight){0};
}

static void dispatch_pixels(const GBuffer *gbuffer)
{
    gl.DispatchCompute((GLuint)(gbuffer->width + 7) / 8, (GLuint)(gbuffer->height + 7) / 8, 1);
    gl.MemoryBarrier(GL_ALL_BARRIER_BITS);
}

static void blend_pixels(const Airlight *airlight, const GBuffer *gbuffer, GLuint picture)
{
    GLuint framebuffer = gl_framebuffer(.label = "airlight", .color = {picture});
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl.Viewport(0, 0, gbuffer->width, gbuffer->height);
    gl.Disable(GL_DEPTH_TEST);
    gl.Disable(GL_CULL_FACE);
    gl.Enable(GL_BLEND);
    gl.BlendFunc(GL_ONE, GL_ONE);
    gl.BindVertexArray(airlight->no_attributes);
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    gl.Disable(GL_BLEND);
    gl.MemoryBarrier(GL_ALL_BARRIER_BITS);
    gl_framebuffer_delete(&framebuffer);
}

void airlight_bind(const Airlight *airlight, const GBuffer *gbuffer, const Camera *camera, const Scene *scene,
                   const Light *light, const DepthMap *map, GLuint picture)
{
    const Shader *shader = airlight->shader[map->kind];
    const vec3 eye_from_origin = camera->eye - map->origin, scattering = scene->medium.scattering;
    const vec3 extinction = scattering + scene->medium.absorption;
    if (!airlight->drawn)
        gl.BindImageTexture(0, picture, 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA32F);
    gl.BindImageTexture(1, gbuffer->distance, 0, GL_FALSE, 0, GL_READ_ONLY, GL_R32F);
    gl.BindImageTexture(2, map->distance, 0, GL_TRUE, 0, GL_READ_ONLY, GL_R32F);
    const GLuint table = airlight->settings.table ? airlight->settings.table : airlight->no_table;
    gl.BindImageTexture(3, table, 0, GL_FALSE, 0, GL_READ_ONLY, GL_R32F);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, airlight->counters);
    if (airlight->settings.exact) {
        gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, airlight->reach.first);
        gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, airlight->reach.spans);
    }
    shader_use(shader);
    raster_set_camera(shader, camera, (float)gbuffer->width / (float)gbuffer->height);
    shader_set_mat4(shader, "to_clip", (const float *)&map->to_clip);
    shader_set_vec3(shader, "eye_from_origin", (const float *)&eye_from_origin);
    raster_set_light(shader, light);
    shader_set_vec3(shader, "scattering", (const float *)&scattering);
    shader_set_vec3(shader, "extinction", (const float *)&extinction);
    shader_set_float(shader, "mean_cosine", scene->medium.mean_cosine);
    shader_set_float(shader, "rayleigh_share", airlight->settings.rayleigh_share);
    shader_set_int(shader, "steps", airlight->settings.steps);
    shader_set_uint(shader, "seed", airlight->settings.seed);
}

void airlight_add(const Airlight *airlight, const GBuffer *gbuffer, const Camera *camera, const Scene *scene,
                  const Light *light, const DepthMap *map, GLuint picture)
{
    airlight_bind(airlight, gbuffer, camera, scene, light, map, picture);
    if (airlight->drawn)
        blend_pixels(airlight, gbuffer, picture);
    else
        dispatch_pixels(gbuffer);
}

void airlight_counts(const Airlight *airlight, uint32_t *missed_rays, uint32_t *lookups)
{
    uint32_t counts[2];
    const uint32_t zero = 0;
    gl_buffer_read(airlight->counters, 0, sizeof counts, counts);
    gl.ClearNamedBufferData(airlight->counters, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &zero);
    *missed_rays = counts[0];
    *lookups = counts[1];
}

Image airlight_picture(const Raster *raster, const Scene *scene, const Camera *camera, int width, int height,
                       int map_resolution, const AirlightSettings *settings)
{
    RasterView view = raster_view_open(raster, scene, width, height, map_resolution);
    Airlight airlight = airlight_open(settings, view.maps, scene->light_count);
    RasterTarget target = raster_target_open("airlight to compare with", width, height);
    raster_view_draw_maps(&view);
    raster_gbuffer_draw(raster, &view.gbuffer, camera, &view.mesh);
    for (size_t i = 0; i < scene->light_count; i++)
        airlight_add(&airlight, &view.gbuffer, camera, scene, &scene->lights[i], &view.maps[i],
                     target.texture);
    Image image = raster_target_read(&target, width, height);
    raster_target_close(&target);
    airlight_close(&airlight);
    raster_view_close(&view);
    return image;
}

const Image *airlight_picture_kept(AirlightKept *kept, uint64_t scene_hash, const Raster *raster,
                                   const Scene *scene, const Camera *camera, int width, int height,
                                   int map_resolution, const AirlightSettings *settings)
{
    const float view[] = {camera->eye[0],          camera->eye[1],       camera->eye[2],
                          camera->target[0],       camera->target[1],    camera->target[2],
                          camera->up[0],           camera->up[1],        camera->up[2],
                          camera->near_distance,   camera->far_distance, camera->vertical_fov_rad,
                          settings->rayleigh_share};
    const int sizes[] = {width, height, map_resolution, settings->steps, settings->nodes, settings->number};
    const uint32_t others[] = {settings->shadowed, settings->exact, settings->grey, settings->seed,
                               settings->table};
    const char *texts[] = {settings->method, settings->variant, settings->phase, settings->shader,
                           settings->definitions};
    uint64_t inputs = hash_bytes(hash_bytes(scene_hash, view, sizeof view), sizes, sizeof sizes);
    inputs = hash_bytes(inputs, others, sizeof others);
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        const char *text = texts[i] ? texts[i] : "";
        inputs = hash_bytes(inputs, text, strlen(text) + 1);
    }
    if (!kept->image.pixels || kept->inputs != inputs) {
        image_free(&kept->image);
        kept->image = airlight_picture(raster, scene, camera, width, height, map_resolution, settings);
        kept->inputs = inputs;
    }
    return &kept->image;
}

AirlightHaze airlight_haze_open(void)
{
    return (AirlightHaze){shader_open("attenuation", NULL, "common/airlight_attenuate.comp"),
                          shader_open("sum", NULL, "common/airlight_sum.comp")};
}

void airlight_haze_close(AirlightHaze *haze)
{
    shader_close(haze->attenuate);
    shader_close(haze->add);
}

void airlight_haze_attenuate(const AirlightHaze *haze, const GBuffer *gbuffer, const Camera *camera,
                             const Scene *scene, const Light *light, GLuint surfaces, GLuint picture)
{
    const bool leg = light && light->kind != LIGHT_DIRECTIONAL;
    const vec3 eye_from_light = leg ? camera->eye - light->position : vec3_make(0, 0, 0);
    const vec3 extinction = scene->medium.scattering + scene->medium.absorption;
    gl.BindImageTexture(0, picture, 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA32F);
    gl.BindImageTexture(1, surfaces, 0, GL_FALSE, 0, GL_READ_ONLY, GL_RGBA32F);
    gl.BindImageTexture(2, gbuffer->distance, 0, GL_FALSE, 0, GL_READ_ONLY, GL_R32F);
    shader_use(haze->attenuate);
    raster_set_camera(haze->attenuate, camera, (float)gbuffer->width / (float)gbuffer->height);
    shader_set_vec3(haze->attenuate, "eye_from_light", (const float *)&eye_from_light);
    shader_set_float(haze->attenuate, "light_leg", leg ? 1.0f : 0.0f);
    shader_set_vec3(haze->attenuate, "extinction", (const float *)&extinction);
    dispatch_pixels(gbuffer);
}

void airlight_sum(const AirlightHaze *haze, const GBuffer *gbuffer, float surface_share, GLuint surfaces,
                  GLuint airlight, GLuint picture)
{
    gl.BindImageTexture(0, picture, 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA32F);
    gl.BindImageTexture(1, surfaces, 0, GL_FALSE, 0, GL_READ_ONLY, GL_RGBA32F);
    gl.BindImageTexture(2, airlight, 0, GL_FALSE, 0, GL_READ_ONLY, GL_RGBA32F);
    shader_use(haze->add);
    shader_set_float(haze->add, "surface_share", surface_share);
    dispatch_pixels(gbuffer);
}
