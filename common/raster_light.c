// raster: depth maps of every kind of light, and direct light through them.
#include "raster_internal.h"

#include <string.h>

// A wider spot gets a cube: the square around its circle would put tan(80°)² = 32 times more texels at the border than the same angle
// has on the axis.
static const float WIDEST_MAP_RAD = 1.396f;
// Near plane of point and spot lights, of the scene's diagonal: a hundredth of the light's own radius r0. Depth needs no precision of it.
static const float NEAR_SHARE = 1e-11f;

// Sutherland and Hodgman (1974): keep what of the polygon is on the plane's positive side.
static int polygon_clip(const vec3 *polygon, int count, vec3 normal, vec3 *kept)
{
    int kept_count = 0;
    for (int i = 0; i < count; i++) {
        vec3 a = polygon[i], b = polygon[(i + 1) % count];
        float from = vec3_dot(normal, a), to = vec3_dot(normal, b);
        if (from >= 0.0f)
            kept[kept_count++] = a;
        if ((from >= 0.0f) != (to >= 0.0f))
            kept[kept_count++] = a + from / (from - to) * (b - a);
    }
    return kept_count;
}

// What of the scene's box lies in the camera's view (all of it without a camera), as points whose hull it is, relative to `origin`: the box's
// faces cut by the four sides of the view, and the eye where it is inside. Returns how many; 0 where the view misses the box.
// A cut adds one corner, but rounding may bend a polygon that stands edge-on across the plane: half of its corners more at most, 4 6 9 13 19.
enum { FACE_POINTS = 19, VIEW_POINTS = 6 * FACE_POINTS + 1 };
static int view_of_box(const Scene *scene, const Camera *camera, float aspect, vec3 origin,
                       vec3 points[VIEW_POINTS])
{
    vec3 right, up, forward, sides[4], eye = origin;
    if (camera) {
        raster_view(camera, aspect, &right, &up, &forward);
        const vec3 x = vec3_dot(right, right) * forward, y = vec3_dot(up, up) * forward;
        sides[0] = x - right, sides[1] = x + right, sides[2] = y - up, sides[3] = y + up;
        eye = camera->eye;
    }
    const vec3 lower = scene->lower - eye, upper = scene->upper - eye;
    int count = 0;
    for (int face = 0; face < 6; face++) {
        vec3 polygon[FACE_POINTS] = {0}, clipped[FACE_POINTS];
        int axis = face / 2, corners = 4;
        for (int i = 0; i < 4; i++) { // round the face: (0, 0) (1, 0) (1, 1) (0, 1)
            vec3 at = {0};
            at[axis] = (float)(face % 2);
            at[(axis + 1) % 3] = i == 1 || i == 2 ? 1.0f : 0.0f;
            at[(axis + 2) % 3] = i >= 2 ? 1.0f : 0.0f;
            polygon[i] = lower + at * (upper - lower);
        }
        for (int side = 0; camera && side < 4; side++) {
            corners = polygon_clip(polygon, corners, sides[side], clipped);
            memcpy(polygon, clipped, sizeof polygon);
        }
        for (int i = 0; i < corners; i++)
            points[count++] = polygon[i] + (eye - origin);
    }
    bool inside = camera != NULL;
    for (int i = 0; i < 3; i++)
        inside = inside && lower[i] <= 0.0f && upper[i] >= 0.0f;
    if (inside)
        points[count++] = eye - origin;
    return count;
}

// Orthographic over what is to be lit; along the light over the whole scene, so that nothing that casts is cut off.
static void fit_directional(DepthMap *map, const Scene *scene, const Light *light, const Camera *camera,
                            float aspect, float diagonal)
{
    // before the whole scene, however the sum is rounded far from the world's origin
    map->origin = 0.5f * scene->lower + 0.5f * scene->upper - diagonal * light->direction;
    vec3 points[VIEW_POINTS];
    int count = view_of_box(scene, camera, aspect, map->origin, points);
    if (count == 0)
        count = view_of_box(scene, NULL, aspect, map->origin, points);
    mat4 turn = mat4_look_at(vec3_make(0, 0, 0), light->direction, vec3_make(0, 1, 0));
    vec3 lower = mat4_transform_point(turn, points[0]), upper = lower;
    for (int i = 1; i < count; i++) {
        vec3 point = mat4_transform_point(turn, points[i]);
        lower = vec3_min(lower, point);
        upper = vec3_max(upper, point);
    }
    // A texel more on each side, and what rounding may move (1e-7 of the diagonal a few times), which gives a scene seen edge-on a width.
    vec3 margin = (upper - lower) / (float)map->resolution + 1e-5f * diagonal;
    lower -= margin;
    upper += margin;
    map->texel_size = fmaxf(upper[0] - lower[0], upper[1] - lower[1]) / (float)map->resolution;
    map->to_clip =
        mat4_multiply(mat4_orthographic(lower[0], upper[0], lower[1], upper[1], 0.0f, 2.0f * diagonal), turn);
}

static void aim_spot(DepthMap *map, const Light *light)
{
    float tangent = fmaxf(tanf(light->half_angle_rad), 1e-6f); // a cone of no width lights nothing
    float near = map->near_distance;
    // z = w − 2·near: nearer than `near` is cut off, nothing is too far
    mat4 projection = {{{1.0f / tangent}, {0, 1.0f / tangent}, {0, 0, -1, -1}, {0, 0, -2.0f * near}}};
    mat4 turn = mat4_look_at(vec3_make(0, 0, 0), light->direction, vec3_make(0, 1, 0));
    map->to_clip = mat4_multiply(projection, turn);
    map->texel_size = 2.0f * tangent / (float)map->resolution;
}

bool raster_depth_map_is_cube(const Light *light)
{
    return light->kind == LIGHT_POINT ||
           (light->kind == LIGHT_SPOT && light->half_angle_rad > WIDEST_MAP_RAD);
}

void raster_depth_map_aim(DepthMap *map, const Scene *scene, const Light *light, const Camera *fit_to,
                          float aspect)
{
    float diagonal = vec3_length(scene->upper - scene->lower);
    if (!(diagonal > 0.0f))
        diagonal = 1.0f; // the empty scene
    map->origin = light->position;
    map->near_distance = NEAR_SHARE * diagonal;
    map->texel_size = 2.0f / (float)map->resolution;
    if (map->kind == LIGHT_SPOT)
        aim_spot(map, light);
    if (map->kind == LIGHT_DIRECTIONAL)
        fit_directional(map, scene, light, fit_to, aspect, diagonal);
}

DepthMap raster_depth_map(const Scene *scene, const Light *light, int resolution, const Camera *fit_to,
                          float aspect)
{
    bool cube = raster_depth_map_is_cube(light);
    DepthMap map = {.kind = cube ? LIGHT_POINT : light->kind, .resolution = resolution};
    raster_depth_map_aim(&map, scene, light, fit_to, aspect);
    map.distance =
        gl_texture(.label = "depth map", .target = cube ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D,
                   .format = GL_R32F, .width = resolution, .height = resolution, .depth = cube ? 6 : 1);
    map.framebuffer = gl_framebuffer(.label = "depth map", .color = {map.distance});
    return map;
}

void raster_depth_map_delete(DepthMap *map)
{
    gl_framebuffer_delete(&map->framebuffer);
    gl_texture_delete(&map->distance);
}

void raster_depth_map_draw(const Raster *raster, const DepthMap *map, const Light *light,
                           const RasterMesh *mesh)
{
    static const float infinity[4] = {INFINITY};
    const Shader *shader = raster->depth_map[map->kind];
    gl.ClearNamedFramebufferfv(map->framebuffer, GL_COLOR, 0, infinity);
    raster_target(map->framebuffer, map->resolution, map->resolution);
    gl.Enable(GL_BLEND);
    gl.BlendEquation(GL_MIN); // keeps the nearest: exact on the stored floats
    shader_use(shader);
    shader_set_vec3(shader, "origin", (const float *)&map->origin);
    shader_set_mat4(shader, "to_clip", (const float *)&map->to_clip);
    shader_set_vec3(shader, "direction", (const float *)&light->direction);
    shader_set_float(shader, "near_distance", map->near_distance);
    gl.BindVertexArray(mesh->vertex_array);
    gl.DrawElementsInstanced(GL_TRIANGLES, mesh->index_count, GL_UNSIGNED_INT, NULL,
                             map->kind == LIGHT_POINT ? 6 : 1);
    gl.BlendEquation(GL_FUNC_ADD);
    gl.Disable(GL_BLEND);
}

// One invocation a pixel in groups of 8 × 8; what comes next may read the picture in any way.
static void dispatch_pixels(const GBuffer *gbuffer)
{
    gl.DispatchCompute((GLuint)(gbuffer->width + 7) / 8, (GLuint)(gbuffer->height + 7) / 8, 1);
    gl.MemoryBarrier(GL_ALL_BARRIER_BITS);
}

void raster_light_begin(const Raster *raster, const GBuffer *gbuffer, GLuint picture, float ambient)
{
    gl.BindImageTexture(0, picture, 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA32F);
    gl.BindImageTexture(1, gbuffer->albedo, 0, GL_FALSE, 0, GL_READ_ONLY, GL_RGBA16F);
    gl.BindImageTexture(2, gbuffer->emission, 0, GL_FALSE, 0, GL_READ_ONLY, GL_RGBA16F);
    shader_use(raster->light_begin);
    shader_set_float(raster->light_begin, "ambient", ambient);
    dispatch_pixels(gbuffer);
}

void raster_set_light(const Shader *shader, const Light *light)
{
    const bool spot = light->kind == LIGHT_SPOT;
    shader_set_vec3(shader, "light_direction", (const float *)&light->direction);
    shader_set_vec3(shader, "light_intensity", (const float *)&light->intensity);
    shader_set_float(shader, "light_radius", light->radius);
    shader_set_vec2(shader, "light_cone", spot ? sinf(light->half_angle_rad) : 0.0f,
                    spot ? cosf(light->half_angle_rad) : -1.0f);
}

void raster_light_add(const Raster *raster, const GBuffer *gbuffer, const Camera *camera, const Light *light,
                      const DepthMap *map, GLuint picture)
{
    const Shader *shader = raster->light[map->kind];
    const vec3 eye_from_origin = camera->eye - map->origin;
    gl.BindImageTexture(0, picture, 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA32F);
    gl.BindImageTexture(1, gbuffer->distance, 0, GL_FALSE, 0, GL_READ_ONLY, GL_R32F);
    gl.BindImageTexture(2, gbuffer->normal, 0, GL_FALSE, 0, GL_READ_ONLY, GL_RGBA16F);
    gl.BindImageTexture(3, gbuffer->albedo, 0, GL_FALSE, 0, GL_READ_ONLY, GL_RGBA16F);
    gl.BindImageTexture(4, map->distance, 0, GL_TRUE, 0, GL_READ_ONLY, GL_R32F);
    shader_use(shader);
    raster_set_camera(shader, camera, (float)gbuffer->width / (float)gbuffer->height);
    shader_set_mat4(shader, "to_clip", (const float *)&map->to_clip);
    shader_set_float(shader, "texel_size", map->texel_size);
    shader_set_vec3(shader, "eye_from_origin", (const float *)&eye_from_origin);
    raster_set_light(shader, light);
    dispatch_pixels(gbuffer);
}
