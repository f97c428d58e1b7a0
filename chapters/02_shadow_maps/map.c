// map: see map.h. The questions that pixels ask are in map_ask.c.
#include "map.h"
#include "map_internal.h"

static Shader *open_shape(const char *label, MapShape shape, const char *more, const char *file)
{
    char *definitions = text_format("SHAPE %d\n%s", (int)shape, more);
    Shader *shader = shader_open(label, definitions, file);
    free(definitions);
    return shader;
}

MapShaders map_shaders_open(void)
{
    return (MapShaders){
        .paint = shader_open("paint", NULL, "02_shadow_maps/paint.comp"),
        .show_flux = {shader_open("show flux", "LAYERED 0", "02_shadow_maps/show_flux.comp"),
                      shader_open("show flux", "LAYERED 1", "02_shadow_maps/show_flux.comp")}};
}

void map_shaders_add(MapShaders *s, MapShape shape)
{
    const bool paraboloid = shape == MAP_PARABOLOID;
    if (s->show[shape])
        return;
    s->receivers[shape] = open_shape("receivers", shape, "", "02_shadow_maps/receivers.comp");
    s->casters[shape] = open_shape("casters", shape, "", "02_shadow_maps/casters.comp");
    s->moments_x[shape] = open_shape("moments", shape, "ALONG_Y 0\n", "02_shadow_maps/moments.comp");
    s->moments_y[shape] = open_shape("moments", shape, "ALONG_Y 1\n", "02_shadow_maps/moments.comp");
    s->visibility[shape] = open_shape("visibility", shape, "", "02_shadow_maps/visibility.comp");
    s->light[shape] = open_shape("light", shape, "", "02_shadow_maps/light.comp");
    s->show[shape] = open_shape("show", shape, "", "02_shadow_maps/show.comp");
    char *whole =
        text_format("SHAPE %d\nMAP_KIND %d\nPATCHES 0", (int)shape, (int)shape); // MAP_KIND: depth_map.frag's
    char *cut = text_format("SHAPE %d\nPATCHES 1", (int)shape);
    s->depth[shape] = shader_open("depth map", whole, "02_shadow_maps/casters.vert",
                                  paraboloid ? "02_shadow_maps/paraboloid.frag" : "common/depth_map.frag");
    if (paraboloid)
        s->depth_cut =
            shader_open("depth map, cut", cut, "02_shadow_maps/casters.vert", "02_shadow_maps/casters.tesc",
                        "02_shadow_maps/casters.tese", "02_shadow_maps/paraboloid.frag");
    free(whole);
    free(cut);
}

void map_shaders_close(MapShaders *s)
{
    Shader **all[] = {s->receivers, s->casters,    s->depth, s->moments_x,
                      s->moments_y, s->visibility, s->light, s->show};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        for (int shape = 0; shape < MAP_SHAPES; shape++)
            shader_close(all[i][shape]);
    shader_close(s->show_flux[0]);
    shader_close(s->show_flux[1]);
    shader_close(s->depth_cut);
    shader_close(s->paint);
}

// Nearest and farthest point of the scene's box from the light, as the map measures distance.
static void range_of_scene(const ShadowMap *map, const Scene *scene, const Light *light, float range[2])
{
    const vec3 lower = scene->lower - map->depth.origin, upper = scene->upper - map->depth.origin;
    range[0] = INFINITY, range[1] = 0.0f;
    for (int corner = 0; corner < 8; corner++) {
        vec3 p = {0};
        for (int k = 0; k < 3; k++)
            p[k] = corner >> k & 1 ? upper[k] : lower[k];
        float distance = map->shape == MAP_DIRECTIONAL ? vec3_dot(p, light->direction) : vec3_length(p);
        range[0] = fminf(range[0], distance);
        range[1] = fmaxf(range[1], distance);
    }
    if (map->shape != MAP_DIRECTIONAL) // the box's own nearest point, 0 inside it
        range[0] = vec3_length(vec3_max(vec3_max(lower, -upper), vec3_make(0, 0, 0)));
    if (!(range[1] > range[0])) // the empty scene
        range[1] = range[0] + 1.0f;
}

static int side_of(int resolution, int layers)
{
    int side = (int)lround(resolution / sqrt(layers));
    return side < 1 ? 1 : side;
}

void map_aim(ShadowMap *map, const Scene *scene, const Light *light, const Camera *fit_to, float aspect)
{
    raster_depth_map_aim(&map->depth, scene, light, fit_to, aspect);
    range_of_scene(map, scene, light, map->depth_range);
}

ShadowMap map_create(const Scene *scene, const Light *light, bool paraboloid, bool moments, int resolution,
                     const Camera *fit_to, float aspect)
{
    ShadowMap map = {.triangle_count = (uint32_t)scene->mesh.triangle_count};
    if (raster_depth_map_is_cube(light)) {
        map.layers = paraboloid ? 2 : 6;
        map.shape = paraboloid ? MAP_PARABOLOID : MAP_CUBE;
    } else {
        map.layers = 1;
        map.shape = light->kind == LIGHT_SPOT ? MAP_SPOT : MAP_DIRECTIONAL;
    }
    const int side = side_of(resolution, map.layers);
    if (map.shape == MAP_PARABOLOID) { // the one shape that raster does not make
        map.depth = (DepthMap){.kind = LIGHT_POINT, .resolution = side};
        map.depth.distance = gl_texture(.label = "depth map", .target = GL_TEXTURE_2D_ARRAY,
                                        .format = GL_R32F, .width = side, .height = side, .depth = 2);
        map.depth.framebuffer = gl_framebuffer(.label = "depth map", .color = {map.depth.distance});
    } else {
        map.depth = raster_depth_map(scene, light, side, fit_to, aspect);
    }
    map_aim(&map, scene, light, fit_to, aspect);
    for (int i = 0; i < 2 && moments; i++)
        map.moments[i] = gl_texture(.label = "moments", .target = GL_TEXTURE_2D_ARRAY, .format = GL_RG32F,
                                    .width = side, .height = side, .depth = map.layers);
    map.bounds = gl_buffer(.label = "asked bounds", .bytes = sizeof(LayerBounds[6]));
    map.casters = gl_buffer(.label = "casters",
                            .bytes = sizeof(uint32_t) * ((size_t)map.layers * map.triangle_count + 1));
    map.count = gl_buffer(.label = "caster count", .bytes = sizeof(uint32_t[2]));
    return map;
}

void map_delete(ShadowMap *map)
{
    raster_depth_map_delete(&map->depth);
    for (int i = 0; i < 2; i++)
        gl_texture_delete(&map->moments[i]);
    gl_buffer_delete(&map->bounds);
    gl_buffer_delete(&map->casters);
    gl_buffer_delete(&map->count);
}

void map_set(const Shader *shader, const ShadowMap *map, const Light *light)
{
    const bool cone = light->kind == LIGHT_SPOT;
    shader_use(shader);
    shader_set_vec3(shader, "origin", (const float *)&map->depth.origin);
    shader_set_mat4(shader, "to_clip", (const float *)&map->depth.to_clip);
    shader_set_float(shader, "texel_size", map->depth.texel_size);
    shader_set_float(shader, "near_distance", map->depth.near_distance);
    shader_set_int(shader, "map_size", map->depth.resolution);
    shader_set_vec2(shader, "depth_range", map->depth_range[0], map->depth_range[1]);
    shader_set_vec3(shader, "light_direction", (const float *)&light->direction);
    shader_set_vec3(shader, "direction", (const float *)&light->direction); // depth_map.frag's
    shader_set_vec2(shader, "light_cone", cone ? sinf(light->half_angle_rad) : 0.0f,
                    cone ? cosf(light->half_angle_rad) : -1.0f);
}

// llvmpipe counts what the tessellator makes in one draw by 16 bits, and draws garbage beyond: patches of 64 pieces a side have 65² vertices.
enum { PATCHES_A_DRAW = 65535 / (65 * 65) };

//[draw
void map_draw(const MapShaders *shaders, const ShadowMap *map, const Light *light, const RasterMesh *mesh,
              const MapCasters *casters)
{
    static const float infinity[4] = {INFINITY};
    gl.ClearNamedFramebufferfv(map->depth.framebuffer, GL_COLOR, 0, infinity);
    gl.BindFramebuffer(GL_FRAMEBUFFER, map->depth.framebuffer);
    gl.Viewport(0, 0, map->depth.resolution, map->depth.resolution);
    gl.Enable(GL_BLEND);
    gl.BlendEquation(GL_MIN); // keeps the nearest: exact on the stored floats, in any order
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, mesh->positions);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, mesh->indices);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, map->casters);
    gl.BindVertexArray(mesh->vertex_array);
    if (map->shape == MAP_PARABOLOID)
        gl.Enable(GL_CLIP_DISTANCE0);
    map_set(shaders->depth[map->shape], map, light);
    gl.DrawArrays(GL_TRIANGLES, 0, (GLsizei)(3 * casters->whole));
    if (casters->cut > 0) { // at the list's end; patches of three corners, GL's default
        map_set(shaders->depth_cut, map, light);
        shader_set_float(shaders->depth_cut, "tessellation", casters->tessellation);
        const uint32_t first = (uint32_t)map->layers * map->triangle_count - casters->cut;
        for (uint32_t done = 0; done < casters->cut; done += PATCHES_A_DRAW) {
            const uint32_t left = casters->cut - done, count = left < PATCHES_A_DRAW ? left : PATCHES_A_DRAW;
            gl.DrawArrays(GL_PATCHES, (GLint)(3 * (first + done)), (GLsizei)(3 * count));
        }
    }
    gl.Disable(GL_CLIP_DISTANCE0);
    gl.BlendEquation(GL_FUNC_ADD);
    gl.Disable(GL_BLEND);
}
//]
