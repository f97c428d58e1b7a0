// rsm: see rsm.h. The sum itself stands in shaders/02_shadow_maps/rsm_*.
#include "rsm.h"

// An invocation's loops end in silence after 65 535 iterations (llvmpipe), so longer sums are several draws.
enum { MOST_ITERATIONS = 32768 };

Rsm rsm_open(void)
{
    Rsm rsm;
    for (int kind = 0; kind < 3; kind++) {
        char definition[] = "MAP_KIND 0";
        definition[sizeof definition - 2] = (char)('0' + kind);
        rsm.all[kind] = shader_open("gather all", definition, "02_shadow_maps/rsm_all.comp");
        rsm.importance[kind] =
            shader_open("gather by importance", definition, "02_shadow_maps/rsm_importance.comp");
    }
    return rsm;
}

void rsm_close(Rsm *rsm)
{
    for (int kind = 0; kind < 3; kind++) {
        shader_close(rsm->all[kind]);
        shader_close(rsm->importance[kind]);
    }
    *rsm = (Rsm){0};
}

static void begin(const Shader *shader, const RsmGather *gather)
{
    const ReflectiveMap *map = gather->map;
    const GBuffer *gbuffer = gather->gbuffer;
    const vec3 eye_from_origin = gather->camera->eye - map->depth.origin;
    gl.BindImageTexture(0, gather->picture, 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA32F);
    gl.BindImageTexture(1, gbuffer->distance, 0, GL_FALSE, 0, GL_READ_ONLY, GL_R32F);
    gl.BindImageTexture(2, gbuffer->normal, 0, GL_FALSE, 0, GL_READ_ONLY, GL_RGBA16F);
    gl.BindImageTexture(3, gbuffer->albedo, 0, GL_FALSE, 0, GL_READ_ONLY, GL_RGBA16F);
    gl.BindImageTexture(4, map->position, 0, GL_TRUE, 0, GL_READ_ONLY, GL_RGBA32F);
    gl.BindImageTexture(5, map->normal, 0, GL_TRUE, 0, GL_READ_ONLY, GL_RGBA16F);
    gl.BindImageTexture(6, map->flux, 0, GL_TRUE, 0, GL_READ_ONLY, GL_RGBA32F);
    shader_use(shader);
    raster_set_camera(shader, gather->camera, (float)gbuffer->width / (float)gbuffer->height);
    shader_set_vec3(shader, "eye_from_origin", (const float *)&eye_from_origin);
    shader_set_float(shader, "clamp_distance", gather->clamp);
    shader_set_int(shader, "texel_discs", gather->texel_discs);
}

// One invocation a pixel in groups of 8 × 8; what comes next may read the picture in any way.
static void dispatch_pixels(const GBuffer *gbuffer)
{
    gl.DispatchCompute((GLuint)(gbuffer->width + 7) / 8, (GLuint)(gbuffer->height + 7) / 8, 1);
    gl.MemoryBarrier(GL_ALL_BARRIER_BITS);
}

double rsm_gather_all(const Rsm *rsm, const RsmGather *gather)
{
    const DepthMap *depth = &gather->map->depth;
    const Shader *shader = rsm->all[depth->kind];
    const int side = depth->resolution, faces = depth->kind == LIGHT_POINT ? 6 : 1;
    const int rows = side < MOST_ITERATIONS ? MOST_ITERATIONS / side : 1;
    begin(shader, gather);
    for (int face = 0; face < faces; face++)
        for (int row = 0; row < side; row += rows) {
            shader_set_int(shader, "face", face);
            shader_set_int(shader, "first_row", row);
            shader_set_int(shader, "last_row", row + rows < side ? row + rows : side);
            dispatch_pixels(gather->gbuffer);
        }
    return (double)faces * side * side;
}

double rsm_gather_importance(const Rsm *rsm, const RsmGather *gather, const RsmPattern *pattern)
{
    const DepthMap *depth = &gather->map->depth;
    const Shader *shader = rsm->importance[depth->kind];
    const unsigned count = (unsigned)pattern->samples;
    const float whole =
        depth->kind == LIGHT_POINT ? (float)M_PI : (float)M_SQRT2; // from anywhere to anywhere
    begin(shader, gather);
    shader_set_mat4(shader, "to_clip", (const float *)&depth->to_clip);
    shader_set_float(shader, "radius", pattern->radius * whole);
    shader_set_int(shader, "rotated", pattern->rotated);
    shader_set_int(shader, "sampling", (int)pattern->sampling);
    shader_set_uint(shader, "seed", pattern->seed);
    shader_set_uint(shader, "sample_count", count);
    for (unsigned first = 0; first < count; first += MOST_ITERATIONS) {
        shader_set_uint(shader, "first_sample", first);
        shader_set_uint(shader, "last_sample",
                        count - first > MOST_ITERATIONS ? first + MOST_ITERATIONS : count);
        dispatch_pixels(gather->gbuffer);
    }
    return count;
}
