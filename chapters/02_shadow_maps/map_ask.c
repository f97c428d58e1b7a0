// map_ask: what pixels ask of a map: which of its parts, how much light, in which picture.
#include "map.h"
#include "map_internal.h"

static void dispatch(int width, int height, int layers)
{
    gl.DispatchCompute((GLuint)(width + 7) / 8, (GLuint)(height + 7) / 8, (GLuint)layers);
    gl.MemoryBarrier(GL_ALL_BARRIER_BITS);
}

static void bind_image(GLuint unit, GLuint texture, GLenum access, GLenum format)
{
    gl.BindImageTexture(unit, texture, 0, GL_TRUE, 0, access, format);
}

// What receiver.glsl reads.
static void set_receivers(const Shader *shader, const ShadowMap *map, const Light *light,
                          const GBuffer *gbuffer, const Camera *camera)
{
    const vec3 eye_from_origin = camera->eye - map->depth.origin;
    map_set(shader, map, light);
    raster_set_camera(shader, camera, (float)gbuffer->width / (float)gbuffer->height);
    shader_set_vec3(shader, "eye_from_origin", (const float *)&eye_from_origin);
    bind_image(1, gbuffer->distance, GL_READ_ONLY, GL_R32F);
    bind_image(2, gbuffer->normal, GL_READ_ONLY, GL_RGBA16F);
}

// Texels from a pixel's own place to the farthest that it may read: the filter's box, a texel of interpolation and a texel for rounding, and what
// the normal offset moves.
static float reach_of(const MapLookup *lookup)
{
    float radius = lookup->filter == FILTER_NEAREST ? 0.0f : lookup->radius;
    float moved = lookup->bias == BIAS_NORMAL ? lookup->bias_size * (2.0f * radius + 1.0f) : 0.0f;
    return 2.0f * radius + 2.0f + moved;
}

MapAsked map_find_receivers(const MapShaders *shaders, const ShadowMap *map, const Light *light,
                            const GBuffer *gbuffer, const Camera *camera, const MapLookup *lookup)
{
    const Shader *shader = shaders->receivers[map->shape];
    gl.ClearNamedBufferData(map->bounds, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, NULL);
    set_receivers(shader, map, light, gbuffer, camera);
    shader_set_float(shader, "margin", reach_of(lookup));
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, map->bounds);
    dispatch(gbuffer->width, gbuffer->height, 1);

    LayerBounds bounds[6];
    gl_buffer_read(map->bounds, 0, sizeof bounds, bounds);
    MapAsked asked = {.hash = HASH_START};
    for (int i = 0; i < map->layers; i++) {
        asked.pixels += bounds[i].pixels;
        asked.layers += bounds[i].end_x > 0;
        asked.hash =
            hash_bytes(asked.hash, &bounds[i].from_end_x, sizeof bounds[i] - sizeof bounds[i].pixels);
    }
    return asked;
}

MapCasters map_find_casters(const MapShaders *shaders, const ShadowMap *map, const Light *light,
                            const RasterMesh *mesh, const MapLookup *lookup, float tessellation)
{
    const Shader *shader = shaders->casters[map->shape];
    gl.ClearNamedBufferData(map->count, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, NULL);
    map_set(shader, map, light);
    shader_set_uint(shader, "triangle_count", map->triangle_count);
    shader_set_float(shader, "tessellation", tessellation);
    shader_set_int(shader, "cut_far", lookup->filter != FILTER_VARIANCE);
    const GLuint buffers[] = {map->bounds, mesh->positions, mesh->indices, map->casters, map->count};
    for (GLuint i = 0; i < sizeof buffers / sizeof *buffers; i++)
        gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, i, buffers[i]);
    const GLuint groups = (map->triangle_count + 63) / 64, row = groups < 65535 ? groups : 65535;
    if (groups > 0)
        gl.DispatchCompute(row, (groups + row - 1) / row, 1);
    gl.MemoryBarrier(GL_ALL_BARRIER_BITS);
    uint32_t count[2];
    gl_buffer_read(map->count, 0, sizeof count, count);
    return (MapCasters){count[0], count[1], tessellation};
}

void map_filter_moments(const MapShaders *shaders, const ShadowMap *map, const Light *light,
                        const MapLookup *lookup)
{
    const Shader *const passes[] = {shaders->moments_x[map->shape], shaders->moments_y[map->shape]};
    for (int i = 0; i < 2; i++) {
        map_set(passes[i], map, light);
        shader_set_float(passes[i], "radius", lookup->radius);
        gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, map->bounds);
        bind_image(0, map->moments[i], GL_WRITE_ONLY, GL_RG32F);
        bind_image(1, i ? map->moments[0] : map->depth.distance, GL_READ_ONLY, i ? GL_RG32F : GL_R32F);
        dispatch(map->depth.resolution, map->depth.resolution, map->layers);
    }
}

void map_visibility(const MapShaders *shaders, const ShadowMap *map, const Light *light,
                    const GBuffer *gbuffer, const Camera *camera, const MapLookup *lookup, GLuint visibility)
{
    const Shader *shader = shaders->visibility[map->shape];
    set_receivers(shader, map, light, gbuffer, camera);
    shader_set_int(shader, "bias_kind", (int)lookup->bias);
    shader_set_float(shader, "bias_size", lookup->bias_size);
    shader_set_int(shader, "filter_kind", (int)lookup->filter);
    shader_set_float(shader, "radius", lookup->radius);
    shader_set_float(shader, "minimum_variance", lookup->minimum_variance);
    shader_set_float(shader, "bleeding", lookup->bleeding);
    bind_image(0, visibility, GL_WRITE_ONLY, GL_R32F);
    bind_image(3, map->depth.distance, GL_READ_ONLY, GL_R32F);
    if (map->moments[1])
        bind_image(4, map->moments[1], GL_READ_ONLY, GL_RG32F);
    dispatch(gbuffer->width, gbuffer->height, 1);
}

void map_light(const MapShaders *shaders, const ShadowMap *map, const Light *light, const GBuffer *gbuffer,
               const Camera *camera, GLuint visibility, GLuint picture)
{
    const Shader *shader = shaders->light[map->shape];
    set_receivers(shader, map, light, gbuffer, camera);
    shader_set_vec3(shader, "light_intensity", (const float *)&light->intensity);
    shader_set_float(shader, "light_radius", light->radius);
    bind_image(0, picture, GL_READ_WRITE, GL_RGBA32F);
    bind_image(3, gbuffer->albedo, GL_READ_ONLY, GL_RGBA16F);
    bind_image(4, visibility, GL_READ_ONLY, GL_R32F);
    dispatch(gbuffer->width, gbuffer->height, 1);
}

void map_show(const MapShaders *shaders, const ShadowMap *map, GLuint picture, int width, int height)
{
    const Shader *shader = shaders->show[map->shape];
    const float nothing[] = {0.01f, 0.015f, 0.05f};
    shader_use(shader);
    shader_set_vec2(shader, "range", map->depth_range[0], map->depth_range[1]);
    shader_set_vec3(shader, "beside", nothing);
    bind_image(0, picture, GL_WRITE_ONLY, GL_RGBA32F);
    bind_image(1, map->depth.distance, GL_READ_ONLY, GL_R32F);
    dispatch(width, height, 1);
}

void map_show_flux(const MapShaders *shaders, const ReflectiveMap *map, GLuint picture, int width, int height)
{
    const bool cube = map->depth.kind == LIGHT_POINT;
    const size_t side = (size_t)map->depth.resolution, texels = (cube ? 6 : 1) * side * side;
    float *flux = memory_new(texels, 4 * sizeof(float), "the reflective map");
    gl_texture_read(map->flux, 0, GL_RGBA, GL_FLOAT, texels * 4 * sizeof(float), flux);
    double sum = 0, count = 0; // the mean of the texels that have any becomes a middle grey
    for (size_t i = 0; i < texels; i++) {
        const float watts = fmaxf(flux[4 * i], fmaxf(flux[4 * i + 1], flux[4 * i + 2]));
        sum += watts;
        count += watts > 0.0f;
    }
    free(flux);
    const Shader *shader = shaders->show_flux[cube];
    shader_use(shader);
    shader_set_float(shader, "scale", sum > 0 ? (float)(0.3 * count / sum) : 0.0f);
    bind_image(0, picture, GL_WRITE_ONLY, GL_RGBA32F);
    bind_image(1, map->flux, GL_READ_ONLY, GL_RGBA32F);
    dispatch(width, height, 1);
}

void map_paint(const MapShaders *shaders, GLuint visibility, GLuint picture, int width, int height)
{
    shader_use(shaders->paint);
    bind_image(0, picture, GL_WRITE_ONLY, GL_RGBA32F);
    bind_image(1, visibility, GL_READ_ONLY, GL_R32F);
    dispatch(width, height, 1);
}
