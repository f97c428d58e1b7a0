// raster: meshes on the GPU, the G-buffer, the full screen, the camera's rays. raster_light.c has what lights need.
#include "raster_internal.h"

#include <limits.h>
#include <stdlib.h>

enum { MESH_POSITION = 0, MESH_NORMAL = 1 };                    // vertex attributes
enum { STORAGE_TRIANGLE_MATERIALS = 0, STORAGE_MATERIALS = 1 }; // as in gbuffer.frag, reflective_map.frag

Raster *raster_open(void)
{
    Raster *raster = memory_new(1, sizeof *raster, "the raster passes");
    gl.CreateVertexArrays(1, &raster->empty_vertex_array);
    raster->gbuffer = shader_open("G-buffer", NULL, "common/gbuffer.vert", "common/gbuffer.frag");
    raster->light_begin = shader_open("light begin", NULL, "common/light_begin.comp");
    for (int kind = 0; kind < 3; kind++) {
        char definition[] = "MAP_KIND 0";
        definition[sizeof definition - 2] = (char)('0' + kind);
        raster->depth_map[kind] = shader_open(
            "depth map", definition, kind == LIGHT_POINT ? "common/depth_cube.vert" : "common/depth_map.vert",
            "common/depth_map.frag");
        raster->reflective_map[kind] = shader_open("reflective map", definition, "common/reflective_map.vert",
                                                   "common/reflective_map.frag");
        raster->light[kind] = shader_open("light", definition, "common/light.comp");
    }
    return raster;
}

void raster_close(Raster *raster)
{
    if (!raster)
        return;
    gl.DeleteVertexArrays(1, &raster->empty_vertex_array);
    shader_close(raster->gbuffer);
    shader_close(raster->light_begin);
    for (int kind = 0; kind < 3; kind++) {
        shader_close(raster->depth_map[kind]);
        shader_close(raster->reflective_map[kind]);
        shader_close(raster->light[kind]);
    }
    free(raster);
}

// A buffer is never empty, so that it can always be bound.
static GLuint buffer_of(const char *label, const void *data, size_t count, size_t size)
{
    return gl_buffer(.label = label, .bytes = count ? count * size : 32, .data = count ? data : NULL);
}

RasterMesh raster_mesh(const Scene *scene)
{
    const Mesh *mesh = &scene->mesh;
    if (mesh->triangle_count > INT_MAX / 3)
        fail_work("%s: %zu triangles are more than one draw can take (%d)", scene->name, mesh->triangle_count,
                  INT_MAX / 3);
    RasterMesh result = {.index_count = (GLsizei)(3 * mesh->triangle_count)};
    result.positions = buffer_of("mesh positions", mesh->positions, mesh->vertex_count, 3 * sizeof(float));
    result.normals = buffer_of("mesh normals", mesh->normals, mesh->vertex_count, 3 * sizeof(float));
    result.indices = buffer_of("mesh indices", mesh->indices, mesh->triangle_count, 3 * sizeof(uint32_t));
    result.triangle_materials =
        buffer_of("triangle materials", mesh->triangle_material, mesh->triangle_count, sizeof(uint32_t));
    vec4 *materials = memory_new(2 * scene->material_count + 1, sizeof *materials, "the materials");
    for (size_t i = 0; i < scene->material_count; i++) {
        materials[2 * i] = scene->materials[i].albedo;
        materials[2 * i + 1] = scene->materials[i].emission;
    }
    result.materials = buffer_of("materials", materials, 2 * scene->material_count, sizeof *materials);
    free(materials);

    gl.CreateVertexArrays(1, &result.vertex_array);
    gl.ObjectLabel(GL_VERTEX_ARRAY, result.vertex_array, -1, "mesh");
    const GLuint buffers[] = {[MESH_POSITION] = result.positions, [MESH_NORMAL] = result.normals};
    for (GLuint i = 0; i < 2; i++) {
        gl.VertexArrayVertexBuffer(result.vertex_array, i, buffers[i], 0, 3 * sizeof(float));
        gl.VertexArrayAttribFormat(result.vertex_array, i, 3, GL_FLOAT, GL_FALSE, 0);
        gl.VertexArrayAttribBinding(result.vertex_array, i, i);
        gl.EnableVertexArrayAttrib(result.vertex_array, i);
    }
    gl.VertexArrayElementBuffer(result.vertex_array, result.indices);
    return result;
}

void raster_mesh_delete(RasterMesh *mesh)
{
    gl.DeleteVertexArrays(1, &mesh->vertex_array);
    gl_buffer_delete(&mesh->positions);
    gl_buffer_delete(&mesh->normals);
    gl_buffer_delete(&mesh->indices);
    gl_buffer_delete(&mesh->triangle_materials);
    gl_buffer_delete(&mesh->materials);
    *mesh = (RasterMesh){0};
}

void raster_draw(const RasterMesh *mesh)
{
    gl.BindVertexArray(mesh->vertex_array);
    gl.DrawElements(GL_TRIANGLES, mesh->index_count, GL_UNSIGNED_INT, NULL);
}

void raster_bind_materials(const RasterMesh *mesh)
{
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, STORAGE_TRIANGLE_MATERIALS, mesh->triangle_materials);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, STORAGE_MATERIALS, mesh->materials);
}

void raster_target(GLuint framebuffer, int width, int height)
{
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl.Viewport(0, 0, width, height);
    gl.Disable(GL_DEPTH_TEST);
    gl.Disable(GL_BLEND);
    gl.Disable(GL_CULL_FACE);
}

void raster_fullscreen(const Raster *raster, const Shader *shader, GLuint framebuffer, int width, int height)
{
    raster_target(framebuffer, width, height);
    shader_use(shader);
    gl.BindVertexArray(raster->empty_vertex_array);
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
}

void raster_view(const Camera *camera, float aspect, vec3 *right, vec3 *up, vec3 *forward)
{
    mat4 turn = mat4_look_at(vec3_make(0, 0, 0), camera->target - camera->eye, camera->up);
    float half_height = tanf(0.5f * camera->vertical_fov_rad);
    *right = half_height * aspect * vec3_make(turn.column[0][0], turn.column[1][0], turn.column[2][0]);
    *up = half_height * vec3_make(turn.column[0][1], turn.column[1][1], turn.column[2][1]);
    *forward = -vec3_make(turn.column[0][2], turn.column[1][2], turn.column[2][2]);
}

void raster_set_camera(const Shader *shader, const Camera *camera, float aspect)
{
    vec3 right, up, forward;
    raster_view(camera, aspect, &right, &up, &forward);
    const vec3 lower_left = forward - right - up, across = 2.0f * right, upwards = 2.0f * up;
    shader_set_vec3(shader, "eye", (const float *)&camera->eye);
    shader_set_vec3(shader, "ray_lower_left", (const float *)&lower_left);
    shader_set_vec3(shader, "ray_right", (const float *)&across);
    shader_set_vec3(shader, "ray_up", (const float *)&upwards);
}

GBuffer raster_gbuffer(int width, int height)
{
    GBuffer result = {.width = width, .height = height};
#define LAYER(name, texel_format)                                                                            \
    gl_texture(.label = "G-buffer " name, .format = texel_format, .width = width, .height = height)
    result.distance = LAYER("distance", GL_R32F);
    result.normal = LAYER("normal", GL_RGBA16F);
    result.albedo = LAYER("albedo", GL_RGBA16F);
    result.emission = LAYER("emission", GL_RGBA16F);
    result.triangle = LAYER("triangle", GL_R32UI);
    result.depth = LAYER("depth", GL_DEPTH_COMPONENT32F);
#undef LAYER
    result.framebuffer = gl_framebuffer(.label = "G-buffer",
                                        .color = {result.distance, result.normal, result.albedo,
                                                  result.emission, result.triangle},
                                        .depth = result.depth);
    return result;
}

void raster_gbuffer_delete(GBuffer *gbuffer)
{
    gl_framebuffer_delete(&gbuffer->framebuffer);
    GLuint *textures[] = {&gbuffer->distance, &gbuffer->normal,   &gbuffer->albedo,
                          &gbuffer->emission, &gbuffer->triangle, &gbuffer->depth};
    for (size_t i = 0; i < sizeof textures / sizeof *textures; i++)
        gl_texture_delete(textures[i]);
}

void raster_gbuffer_draw(const Raster *raster, const GBuffer *gbuffer, const Camera *camera,
                         const RasterMesh *mesh)
{
    static const float infinity[4] = {INFINITY}, zero[4] = {0};
    static const GLuint none[4] = {0};
    gl.ClearNamedFramebufferfv(gbuffer->framebuffer, GL_COLOR, 0, infinity);
    for (int i = 1; i < 4; i++)
        gl.ClearNamedFramebufferfv(gbuffer->framebuffer, GL_COLOR, i, zero);
    gl.ClearNamedFramebufferuiv(gbuffer->framebuffer, GL_COLOR, 4, none);
    gl.ClearNamedFramebufferfv(gbuffer->framebuffer, GL_DEPTH, 0, zero);

    // Depth is near/z (camera_clip): the zero of floats lies at infinity, so its relative precision is 2^-24 at every distance; the near plane
    // costs none and no far plane is needed (Reed, Depth precision visualized, 2015).
    raster_target(gbuffer->framebuffer, gbuffer->width, gbuffer->height);
    gl.Enable(GL_DEPTH_TEST);
    gl.DepthFunc(GL_GREATER);
    gl.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    raster_bind_materials(mesh);
    shader_use(raster->gbuffer);
    raster_set_camera(raster->gbuffer, camera, (float)gbuffer->width / (float)gbuffer->height);
    shader_set_float(raster->gbuffer, "near_distance", camera->near_distance);
    raster_draw(mesh);
    gl.Disable(GL_DEPTH_TEST);
    gl.DepthFunc(GL_LESS);
    gl.ClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
}
