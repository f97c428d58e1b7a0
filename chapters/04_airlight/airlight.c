// airlight: see airlight.h.
#include "airlight.h"

#include <gsl/gsl_integration.h>
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
static const char *const closed[] = {"sun", "pegoraro", "gauss", NULL};
static const char *const variants[] = {"intervals", "signed", NULL};
static const char *const phases[] = {
    "uniform", "rayleigh", "henyey_greenstein", "hoffman_preetham", "hoffman_preetham_normalized", NULL};

static bool is_one_of(const char *const *names, const char *name)
{
    while (*names && strcmp(*names, name) != 0)
        names++;
    return *names != NULL;
}

bool airlight_uses_map(const AirlightSettings *settings)
{
    return !is_one_of(closed, settings->method);
}

static double sun_integrand(double xi, void *u)
{
    return exp(-*(double *)u * tan(xi));
}

double sun_f(double u, double v)
{
    gsl_function function = {sun_integrand, &u};
    double result, error;
    size_t evaluations;
    gsl_integration_cquad_workspace *work = gsl_integration_cquad_workspace_alloc(100);
    gsl_integration_cquad(&function, 0.0, v, 0.0, 1e-9, work, &result, &error, &evaluations);
    gsl_integration_cquad_workspace_free(work);
    return result;
}

float *sun_table(int size)
{
    float *table = memory_new((size_t)size * (size_t)size, sizeof *table, "the table of F");
    for (int row = 0; row < size; row++)
        for (int column = 0; column < size; column++)
            table[row * size + column] =
                (float)sun_f(SUN_MOST_U * column / (size - 1.0), M_PI_2 * row / (size - 1.0));
    return table;
}

Airlight airlight_open(const AirlightSettings *settings, const DepthMap *maps, size_t map_count)
{
    Airlight airlight = {.settings = *settings};
    const bool sun = strcmp(settings->method, "sun") == 0;
    const int size = sun ? settings->table : 1;
    airlight.table = gl_texture(.label = "Sun's F", .format = GL_R32F, .width = size, .height = size);
    if (sun) {
        float *table = sun_table(size);
        gl.TextureSubImage2D(airlight.table, 0, 0, 0, size, size, GL_RED, GL_FLOAT, table);
        free(table);
    }
    airlight.counters = gl_buffer(.label = "airlight counters", .bytes = 2 * sizeof(uint32_t));
    const char *file = "04_airlight/segments.comp";
    int method = 0;
    if (is_one_of(sampled, settings->method)) {
        file = "04_airlight/march.comp";
        method = index_of(sampled, settings->method, "method");
    } else if (is_one_of(closed, settings->method)) {
        file = "04_airlight/closed.comp";
        method = index_of(closed, settings->method, "method");
    }
    for (size_t i = 0; i < map_count; i++) {
        const int kind = (int)maps[i].kind;
        if (airlight.shader[kind])
            continue;
        // the order of LightKind; in the shaders: CUBE 0, SPOT 1, DIRECTIONAL 2
        char *definitions = text_format(
            "METHOD %d\nVARIANT %d\nPHASE %d\nAIRLIGHT_NODES %d\nMAP_KIND %d\nSHADOWED %d\nCOUNT %d\nGREY %d",
            method, index_of(variants, settings->variant, "variant"),
            index_of(phases, settings->phase, "phase function"), settings->nodes, kind, settings->shadowed,
            settings->count, settings->grey);
        airlight.shader[kind] = shader_open("airlight", definitions, file);
        free(definitions);
    }
    return airlight;
}

void airlight_close(Airlight *airlight)
{
    for (int i = 0; i < 3; i++)
        shader_close(airlight->shader[i]);
    gl_texture_delete(&airlight->table);
    gl_buffer_delete(&airlight->counters);
    *airlight = (Airlight){0};
}

static void dispatch_pixels(const GBuffer *gbuffer)
{
    gl.DispatchCompute((GLuint)(gbuffer->width + 7) / 8, (GLuint)(gbuffer->height + 7) / 8, 1);
    gl.MemoryBarrier(GL_ALL_BARRIER_BITS);
}

void airlight_add(const Airlight *airlight, const GBuffer *gbuffer, const Camera *camera, const Scene *scene,
                  const Light *light, const DepthMap *map, GLuint picture)
{
    const Shader *shader = airlight->shader[map->kind];
    const vec3 eye_from_origin = camera->eye - map->origin, scattering = scene->medium.scattering;
    const vec3 extinction = scattering + scene->medium.absorption;
    gl.BindImageTexture(0, picture, 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA32F);
    gl.BindImageTexture(1, gbuffer->distance, 0, GL_FALSE, 0, GL_READ_ONLY, GL_R32F);
    gl.BindImageTexture(2, map->distance, 0, GL_TRUE, 0, GL_READ_ONLY, GL_R32F);
    gl.BindImageTexture(3, airlight->table, 0, GL_FALSE, 0, GL_READ_ONLY, GL_R32F);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, airlight->counters);
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

Haze haze_open(void)
{
    return (Haze){shader_open("attenuation", NULL, "04_airlight/attenuate.comp"),
                  shader_open("sum", NULL, "04_airlight/add.comp")};
}

void haze_close(Haze *haze)
{
    shader_close(haze->attenuate);
    shader_close(haze->add);
}

void haze_attenuate(const Haze *haze, const GBuffer *gbuffer, const Camera *camera, const Scene *scene,
                    const Light *light, GLuint surfaces, GLuint picture)
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

void haze_add(const Haze *haze, const GBuffer *gbuffer, float surface_share, GLuint surfaces, GLuint airlight,
              GLuint picture)
{
    gl.BindImageTexture(0, picture, 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA32F);
    gl.BindImageTexture(1, surfaces, 0, GL_FALSE, 0, GL_READ_ONLY, GL_RGBA32F);
    gl.BindImageTexture(2, airlight, 0, GL_FALSE, 0, GL_READ_ONLY, GL_RGBA32F);
    shader_use(haze->add);
    shader_set_float(haze->add, "surface_share", surface_share);
    dispatch_pixels(gbuffer);
}

//[can_shadow
// The box's shadow is what lies behind it as the light sees it: every corner p, and from p on all along the light. It misses the view where all of that is outside
// one of the view's four sides, planes through the eye.
bool airlight_can_shadow(const Scene *scene, const Light *light, const Camera *camera, float aspect)
{
    if (scene->mesh.triangle_count == 0)
        return false;
    const mat4 view = camera_view(*camera); // its rows are the camera's axes
    const vec3 right = vec3_make(view.column[0][0], view.column[1][0], view.column[2][0]);
    const vec3 up = vec3_make(view.column[0][1], view.column[1][1], view.column[2][1]);
    const vec3 forward = -vec3_make(view.column[0][2], view.column[1][2], view.column[2][2]);
    const float tangent = tanf(0.5f * camera->vertical_fov_rad);
    const vec3 sides[5] = {forward * (tangent * aspect) + right, forward * (tangent * aspect) - right,
                           forward * tangent + up, forward * tangent - up, forward}; // inside: dot ≥ 0
    for (int side = 0; side < 5; side++) {
        bool outside = true;
        for (int i = 0; i < 8; i++) {
            const vec3 corner = vec3_make(i & 1 ? scene->upper[0] : scene->lower[0],
                                          i & 2 ? scene->upper[1] : scene->lower[1],
                                          i & 4 ? scene->upper[2] : scene->lower[2]);
            const vec3 onwards =
                light->kind == LIGHT_DIRECTIONAL ? light->direction : corner - light->position;
            outside = outside && vec3_dot(sides[side], corner - camera->eye) < 0.0f &&
                      vec3_dot(sides[side], onwards) <= 0.0f;
        }
        if (outside)
            return false;
    }
    return true;
}
//]
