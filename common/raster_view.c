// raster: render targets, and what a view of a scene starts from (see raster.h).
#include "raster.h"

#include <stdlib.h>
#include <string.h>

RasterTarget raster_target_open(const char *label, int width, int height)
{
    RasterTarget target = {
        .texture = gl_texture(.label = label, .format = GL_RGBA32F, .width = width, .height = height)};
    target.framebuffer = gl_framebuffer(.label = label, .color = {target.texture});
    raster_target_clear(&target);
    return target;
}

void raster_target_close(RasterTarget *target)
{
    gl_framebuffer_delete(&target->framebuffer);
    gl_texture_delete(&target->texture);
}

void raster_target_clear(const RasterTarget *target)
{
    static const float black[4] = {0};
    gl.ClearNamedFramebufferfv(target->framebuffer, GL_COLOR, 0, black);
}

Image raster_target_read(const RasterTarget *target, int width, int height)
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

RasterView raster_view_open(const Raster *raster, const Scene *scene, int width, int height,
                            int map_resolution)
{
    RasterView view = {.raster = raster,
                       .scene = scene,
                       .mesh = raster_mesh(scene),
                       .gbuffer = raster_gbuffer(width, height)};
    view.maps = memory_new(scene->light_count + 1, sizeof *view.maps, "the depth maps");
    // of the whole scene, since the air beside what the camera sees of it may lie in shadow, too
    for (size_t i = 0; i < scene->light_count; i++)
        view.maps[i] = raster_depth_map(scene, &scene->lights[i], map_resolution, NULL, 1.0f);
    return view;
}

void raster_view_close(RasterView *view)
{
    for (size_t i = 0; i < view->scene->light_count; i++)
        raster_depth_map_delete(&view->maps[i]);
    free(view->maps);
    raster_gbuffer_delete(&view->gbuffer);
    raster_mesh_delete(&view->mesh);
}

void raster_view_aim(const RasterView *view)
{
    for (size_t i = 0; i < view->scene->light_count; i++)
        raster_depth_map_aim(&view->maps[i], view->scene, &view->scene->lights[i], NULL, 1.0f);
}

void raster_view_draw_maps(const RasterView *view)
{
    raster_view_aim(view);
    for (size_t i = 0; i < view->scene->light_count; i++)
        raster_depth_map_draw(view->raster, &view->maps[i], &view->scene->lights[i], &view->mesh);
}

//[can_shadow
// The box's shadow is what lies behind it as the light sees it: every corner p, and from p on all along the light. It misses the view where all of that is outside
// one of the view's four sides, planes through the eye.
bool raster_can_shadow(const Scene *scene, const Light *light, const Camera *camera, float aspect)
{
    if (scene->mesh.triangle_count == 0)
        return false;
    const mat4 turn = camera_view(*camera); // its rows are the camera's axes
    const vec3 right = vec3_make(turn.column[0][0], turn.column[1][0], turn.column[2][0]);
    const vec3 up = vec3_make(turn.column[0][1], turn.column[1][1], turn.column[2][1]);
    const vec3 forward = -vec3_make(turn.column[0][2], turn.column[1][2], turn.column[2][2]);
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
