// render: see render.h.
#include "render.h"

#include <stdlib.h>
#include <string.h>

Target target_open(const char *label, int width, int height)
{
    Target target = {.texture =
                         gl_texture(.label = label, .format = GL_RGBA32F, .width = width, .height = height)};
    target.framebuffer = gl_framebuffer(.label = label, .color = {target.texture});
    target_clear(&target);
    return target;
}

void target_close(Target *target)
{
    gl_framebuffer_delete(&target->framebuffer);
    gl_texture_delete(&target->texture);
}

void target_clear(const Target *target)
{
    static const float black[4] = {0};
    gl.ClearNamedFramebufferfv(target->framebuffer, GL_COLOR, 0, black);
}

Image target_read(const Target *target, int width, int height)
{
    Image image = image_make(width, height, 4);
    const size_t row = 4 * (size_t)width, bytes = row * (size_t)height * sizeof(float);
    float *rows = memory_new(row * (size_t)height, sizeof *rows, "a picture");
    gl_texture_read(target->texture, 0, GL_RGBA, GL_FLOAT, bytes, rows);
    for (int y = 0; y < height; y++) // GL's first row is the bottom one
        memcpy(image.pixels + row * (size_t)(height - 1 - y), rows + row * (size_t)y, row * sizeof(float));
    free(rows);
    return image;
}

Renderer renderer_open(const Raster *raster, const Scene *scene, int width, int height, int map_resolution)
{
    Renderer renderer = {.raster = raster,
                         .scene = scene,
                         .mesh = raster_mesh(scene),
                         .gbuffer = raster_gbuffer(width, height)};
    renderer.maps = memory_new(scene->light_count + 1, sizeof *renderer.maps, "the depth maps");
    // of the whole scene, since the air beside what the camera sees of it may lie in shadow, too
    for (size_t i = 0; i < scene->light_count; i++)
        renderer.maps[i] = raster_depth_map(scene, &scene->lights[i], map_resolution, NULL, 1.0f);
    return renderer;
}

void renderer_close(Renderer *renderer)
{
    for (size_t i = 0; i < renderer->scene->light_count; i++)
        raster_depth_map_delete(&renderer->maps[i]);
    free(renderer->maps);
    raster_gbuffer_delete(&renderer->gbuffer);
    raster_mesh_delete(&renderer->mesh);
}

void renderer_draw_maps(const Renderer *renderer)
{
    for (size_t i = 0; i < renderer->scene->light_count; i++)
        raster_depth_map_draw(renderer->raster, &renderer->maps[i], &renderer->scene->lights[i],
                              &renderer->mesh);
}

Image render_airlight(const Raster *raster, const Scene *scene, const Camera *camera, int width, int height,
                      int map_resolution, const AirlightSettings *settings)
{
    Renderer renderer = renderer_open(raster, scene, width, height, map_resolution);
    Airlight airlight = airlight_open(settings, renderer.maps, scene->light_count);
    Target target = target_open("airlight to compare with", width, height);
    renderer_draw_maps(&renderer);
    raster_gbuffer_draw(raster, &renderer.gbuffer, camera, &renderer.mesh);
    for (size_t i = 0; i < scene->light_count; i++)
        airlight_add(&airlight, &renderer.gbuffer, camera, scene, &scene->lights[i], &renderer.maps[i],
                     target.texture);
    Image image = target_read(&target, width, height);
    target_close(&target);
    airlight_close(&airlight);
    renderer_close(&renderer);
    return image;
}
