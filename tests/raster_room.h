// What the tests of raster share: closed forms of a closed room with a block that floats in it, or its floor alone with the block.
#ifndef RASTER_ROOM_H
#define RASTER_ROOM_H

#include "raster.h"

#include <criterion/criterion.h>
#include <stdlib.h>

typedef struct Box {
    double lower[3], upper[3];
} Box;
static const Box ROOM = {{-4, 0, -5}, {4, 6, 5}}, BLOCK = {{-1, 1, -0.5}, {1, 2, 1}};
enum { SIZE = 128, MAP = 128 };
// A seed says which scene: the floor alone or walls all round, and where and how large.
enum { WALLS = 1, FAR_AWAY = 2, TINY = 4, GIANT = 8, HANGING = 16 };

static inline float scale_of(uint64_t seed)
{
    return seed & TINY ? 1e-6f : seed & GIANT ? 1e6f : 1.0f;
}
// Far away all coordinates stay multiples of 1/16 below 2^20, which floats hold exactly.
static inline vec3 place(uint64_t seed, float x, float y, float z)
{
    float far = seed & FAR_AWAY ? 1e6f : 0.0f;
    return scale_of(seed) * vec3_make(x, y, z) + vec3_make(far, -far, far);
}
static inline vec3 corner_of(uint64_t seed, const double c[3])
{
    return place(seed, (float)c[0], (float)c[1], (float)c[2]);
}

static inline void make(Scene *scene, uint64_t seed)
{
    // half floats and halves: exact in the G-buffer
    uint32_t block =
        scene_add_material(scene, "block", vec3_make(0.25f, 0.5f, 0.75f), vec3_make(0, 0.125f, 0));
    uint32_t walls = scene_add_material(scene, "walls", vec3_make(0.5f, 0.5f, 0.5f), vec3_make(0, 0, 0));
    mesh_add_box(&scene->mesh, corner_of(seed, BLOCK.lower), corner_of(seed, BLOCK.upper), block);
    if (seed & WALLS)
        mesh_add_box(&scene->mesh, corner_of(seed, ROOM.lower), corner_of(seed, ROOM.upper), walls);
    else
        mesh_add_quad(&scene->mesh, corner_of(seed, ROOM.lower), scale_of(seed) * vec3_make(0, 0, 10),
                      scale_of(seed) * vec3_make(8, 0, 0), walls);
    if (seed & HANGING) // high above the floor, outside a view of it
        mesh_add_box(&scene->mesh, place(seed, -2, 20, -2), place(seed, 2, 21, 2), block);
    scene->camera = (Camera){.eye = place(seed, 3, 4, 4.5f),
                             .target = place(seed, 0, 1, 0),
                             .up = vec3_make(0, 1, 0),
                             .vertical_fov_rad = 1.0f};
}
static inline void make_nothing(Scene *scene, uint64_t seed)
{
    (void)scene, (void)seed;
}

// Distance along the unit direction to the first surface, +Inf for none; the normal on the side that is met.
static inline double trace(bool walls, const double origin[3], const double direction[3], double normal[3])
{
    double nearest = INFINITY;
    for (int b = 0; b < 2;
         b++) { // the block by where the ray enters it (or leaves, from inside), the room by where it leaves
        const Box *box = b ? &ROOM : &BLOCK;
        double enter = -INFINITY, leave = INFINITY;
        int enter_axis = 0, leave_axis = 0;
        for (int i = 0; i < 3; i++) {
            double t0 = (box->lower[i] - origin[i]) / direction[i],
                   t1 = (box->upper[i] - origin[i]) / direction[i];
            if (fmin(t0, t1) > enter)
                enter = fmin(t0, t1), enter_axis = i;
            if (fmax(t0, t1) < leave)
                leave = fmax(t0, t1), leave_axis = i;
        }
        bool inside = enter <= 0;
        double t = inside ? leave : enter;
        int axis = inside ? leave_axis : enter_axis;
        if (b && !walls) { // the floor alone
            axis = 1, t = -origin[1] / direction[1];
            for (int i = 0; i < 3; i += 2)
                if (fabs(origin[i] + t * direction[i]) > ROOM.upper[i])
                    t = -1;
        }
        if ((!b || !walls ? t > 0 && (b || enter <= leave) : true) && t < nearest) {
            nearest = t;
            for (int i = 0; i < 3; i++)
                normal[i] = i != axis ? 0 : direction[i] < 0 ? 1 : -1;
        }
    }
    return nearest;
}
static inline double trace_from(bool walls, vec3 origin, vec3 direction)
{
    double o[3], d[3], normal[3], length = 0;
    for (int i = 0; i < 3; i++)
        o[i] = origin[i], d[i] = direction[i], length += d[i] * d[i];
    for (int i = 0; i < 3; i++)
        d[i] /= sqrt(length);
    return trace(walls, o, d, normal);
}

// Everything that a picture of one light needs.
typedef struct Stage {
    Raster *raster;
    Scene *scene;
    RasterMesh mesh;
    GBuffer gbuffer;
    GLuint picture;
} Stage;
static inline Stage stage_open(void (*maker)(Scene *, uint64_t), uint64_t seed)
{
    static bool opened;
    if (!opened)
        gl_open(gl_headless_platform(), 0, 0, "test_raster");
    opened = true;
    shader_search_first("tests/data");
    const SceneKind kind = {"test", "a test", maker};
    Stage stage = {.raster = raster_open(), .scene = scene_from(&kind, seed)};
    stage.mesh = raster_mesh(stage.scene);
    stage.gbuffer = raster_gbuffer(SIZE, SIZE);
    stage.picture = gl_texture(.label = "picture", .format = GL_RGBA32F, .width = SIZE, .height = SIZE);
    return stage;
}
static inline void stage_close(Stage *stage)
{
    gl_texture_delete(&stage->picture);
    raster_gbuffer_delete(&stage->gbuffer);
    raster_mesh_delete(&stage->mesh);
    scene_close(stage->scene);
    raster_close(stage->raster);
    gl_check("the test");
}
static inline float *texels(GLuint texture, GLenum format, int channels, int count)
{
    size_t bytes = (size_t)channels * (size_t)count * sizeof(float);
    float *data = malloc(bytes);
    gl_texture_read(texture, 0, format, GL_FLOAT, bytes, data);
    return data;
}
static inline Light light_of(LightKind kind, uint64_t seed)
{
    float scale = scale_of(seed), intensity = kind == LIGHT_DIRECTIONAL ? 3 : 40 * scale * scale;
    return (Light){.kind = kind,
                   .position = place(seed, 0.5f, 5, 0.75f),
                   .direction = vec3_normalize(vec3_make(-0.25f, -1, -0.125f)),
                   .intensity = intensity * vec3_make(1, 0.5f, 0.25f),
                   .half_angle_rad = 0.6f,
                   .radius = 1e-3f * scale};
}
// Unit direction of a pixel's ray, from the projection and not from camera.glsl.
static inline vec3 pixel_ray(const Camera *camera, int x, int y)
{
    Camera at_origin = *camera;
    at_origin.eye = vec3_make(0, 0, 0);
    at_origin.target = camera->target - camera->eye;
    mat4 inverse = mat4_inverse(mat4_multiply(camera_projection(at_origin, 1), camera_view(at_origin)));
    float u = 2 * ((float)x + 0.5f) / SIZE - 1, v = 2 * ((float)y + 0.5f) / SIZE - 1;
    return vec3_normalize(mat4_transform_point(inverse, (vec4){u, v, 0, 1}));
}
// Interpolation over a triangle in floats, measured at up to 3e-6 of the distance.
static const double RELATIVE = 2e-5;
// Rays within rounding of an edge may fall on either side of it.
enum { EDGE_TEXELS = 4 };

#endif
