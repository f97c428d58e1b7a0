// raster: reflective shadow maps, depth maps whose texels are lights of their own.
#include "raster_internal.h"

ReflectiveMap raster_reflective_map(const Scene *scene, const Light *light, int resolution)
{
    ReflectiveMap map = {.depth = raster_depth_map(scene, light, resolution, NULL, 1.0f)};
    bool cube = map.depth.kind == LIGHT_POINT;
#define LAYER(name, texel_format)                                                                            \
    gl_texture(.label = "reflective map " name, .target = cube ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D,        \
               .format = texel_format, .width = resolution, .height = resolution, .depth = cube ? 6 : 1)
    map.position = LAYER("position", GL_RGBA32F);
    map.normal = LAYER("normal", GL_RGBA16F);
    map.flux = LAYER("flux", GL_RGBA32F);
    map.nearest = LAYER("nearest", GL_DEPTH_COMPONENT32F);
#undef LAYER
    map.framebuffer = gl_framebuffer(.label = "reflective map",
                                     .color = {map.depth.distance, map.position, map.normal, map.flux},
                                     .depth = map.nearest);
    return map;
}

void raster_reflective_map_delete(ReflectiveMap *map)
{
    gl_framebuffer_delete(&map->framebuffer);
    GLuint *textures[] = {&map->position, &map->normal, &map->flux, &map->nearest};
    for (size_t i = 0; i < sizeof textures / sizeof *textures; i++)
        gl_texture_delete(textures[i]);
    raster_depth_map_delete(&map->depth);
}

// Area of a directional map's texel. Rows 0 and 1 of its matrix are the turned axes over half the map's width and height.
static float texel_area(const DepthMap *map)
{
    float area = 1.0f;
    for (int row = 0; row < 2; row++) {
        vec3 axis =
            vec3_make(map->to_clip.column[0][row], map->to_clip.column[1][row], map->to_clip.column[2][row]);
        area *= 2.0f / (vec3_length(axis) * (float)map->resolution);
    }
    return area;
}

void raster_reflective_map_draw(const Raster *raster, const ReflectiveMap *map, const Light *light,
                                const RasterMesh *mesh)
{
    static const float infinity[4] = {INFINITY}, zero[4] = {0};
    const DepthMap *depth = &map->depth;
    const Shader *shader = raster->reflective_map[depth->kind];
    gl.ClearNamedFramebufferfv(map->framebuffer, GL_COLOR, 0, infinity);
    for (int i = 1; i < 4; i++)
        gl.ClearNamedFramebufferfv(map->framebuffer, GL_COLOR, i, zero);
    gl.ClearNamedFramebufferfv(map->framebuffer, GL_DEPTH, 0, zero);

    raster_target(map->framebuffer, depth->resolution, depth->resolution);
    gl.Enable(GL_DEPTH_TEST);
    gl.DepthFunc(GL_GREATER); // the shader's depth is near/distance
    raster_bind_materials(mesh);
    shader_use(shader);
    shader_set_vec3(shader, "origin", (const float *)&depth->origin);
    shader_set_mat4(shader, "to_clip", (const float *)&depth->to_clip);
    shader_set_float(shader, "near_distance", depth->near_distance);
    raster_set_light(shader, light);
    shader_set_float(shader, "texel_size", depth->texel_size);
    shader_set_float(shader, "half_resolution", 0.5f * (float)depth->resolution);
    shader_set_float(shader, "texel_area", depth->kind == LIGHT_DIRECTIONAL ? texel_area(depth) : 0.0f);
    gl.BindVertexArray(mesh->vertex_array);
    gl.DrawElementsInstanced(GL_TRIANGLES, mesh->index_count, GL_UNSIGNED_INT, NULL,
                             depth->kind == LIGHT_POINT ? 6 : 1);
    gl.Disable(GL_DEPTH_TEST);
    gl.DepthFunc(GL_LESS);
}
