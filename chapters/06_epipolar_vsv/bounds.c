// bounds: see bounds.h.
#include "bounds.h"

#include <stdlib.h>
#include <string.h>

// Absorbed by e^-14 on the way, light matters no more (AIRLIGHT_CUT); where nothing absorbs, ten times the scene's size must do.
static const float EXPONENTS = 14.0f, SIZES = 10.0f;

typedef struct Corner {
    float at[3];
    uint32_t number; // of the triangle's corner
} Corner;

static int by_place(const void *a, const void *b)
{
    return memcmp(((const Corner *)a)->at, ((const Corner *)b)->at, sizeof(float[3]));
}

typedef struct Edge {
    uint32_t from, to, triangle; // corners by place, from < to
    bool turned;                 // the triangle runs from `to` to `from`
} Edge;

static int by_ends(const void *a, const void *b)
{
    const Edge *x = a, *y = b;
    if (x->from != y->from)
        return x->from < y->from ? -1 : 1;
    return (x->to > y->to) - (x->to < y->to);
}

// Corners that lie in one place get one number, whatever vertices they were given.
static uint32_t *places_of(const Mesh *mesh)
{
    const size_t count = 3 * mesh->triangle_count;
    Corner *corners = memory_new(count + 1, sizeof *corners, "corners");
    uint32_t *place = memory_new(count + 1, sizeof *place, "corners");
    for (size_t i = 0; i < count; i++) {
        for (size_t k = 0; k < 3; k++)
            corners[i].at[k] = mesh->positions[3 * (size_t)mesh->indices[i] + k] + 0.0f; // -0 is 0
        corners[i].number = (uint32_t)i;
    }
    qsort(corners, count, sizeof *corners, by_place);
    uint32_t first = 0;
    for (size_t i = 0; i < count; i++) {
        if (i == 0 || by_place(&corners[i - 1], &corners[i]) != 0)
            first = corners[i].number;
        place[corners[i].number] = first;
    }
    free(corners);
    return place;
}

static vec3 corner_at(const Mesh *mesh, uint32_t corner)
{
    const float *p = mesh->positions + 3 * (size_t)mesh->indices[corner];
    return vec3_make(p[0], p[1], p[2]);
}

typedef struct Builder {
    const Mesh *mesh;
    const Light *light;
    float reach; // metres from the light to the far ends
    float *positions;
    size_t count, capacity;
} Builder;

static void add_vertex(Builder *b, vec3 p)
{
    if (b->count == b->capacity) {
        b->capacity = b->capacity ? 2 * b->capacity : 4096;
        b->positions = memory_grow(b->positions, 3 * b->capacity, sizeof(float), "shadow volumes");
    }
    for (size_t k = 0; k < 3; k++)
        b->positions[3 * b->count + k] = p[k];
    b->count++;
}

static vec3 thrown(const Builder *b, vec3 p)
{
    if (b->light->kind == LIGHT_DIRECTIONAL)
        return p + b->reach * b->light->direction;
    return b->light->position + b->reach * vec3_normalize(p - b->light->position);
}

static bool faces_light(const Builder *b, uint32_t triangle)
{
    const vec3 p = corner_at(b->mesh, 3 * triangle), u = corner_at(b->mesh, 3 * triangle + 1) - p,
               v = corner_at(b->mesh, 3 * triangle + 2) - p;
    const vec3 to_light = b->light->kind == LIGHT_DIRECTIONAL ? -b->light->direction : b->light->position - p;
    return vec3_dot(vec3_cross(vec3_normalize(u), vec3_normalize(v)), to_light) > 0.0f;
}

static void add_quad(Builder *b, uint32_t from, uint32_t to)
{
    const vec3 p = corner_at(b->mesh, from), q = corner_at(b->mesh, to), far_p = thrown(b, p),
               far_q = thrown(b, q);
    const vec3 corners[6] = {p, q, far_q, p, far_q, far_p};
    for (int i = 0; i < 6; i++)
        add_vertex(b, corners[i]);
}

// An edge of two triangles casts where one of them faces the light and one does not; an edge of one triangle, or of more than two, always does.
static size_t add_quads(Builder *b)
{
    const size_t count = 3 * b->mesh->triangle_count;
    uint32_t *place = places_of(b->mesh);
    Edge *edges = memory_new(count + 1, sizeof *edges, "edges");
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t a = place[i], c = place[i / 3 * 3 + (i + 1) % 3];
        edges[i] = (Edge){a < c ? a : c, a < c ? c : a, i / 3, a > c};
    }
    qsort(edges, count, sizeof *edges, by_ends);
    size_t found = 0;
    for (size_t first = 0, next; first < count; first = next) {
        for (next = first + 1; next < count && by_ends(&edges[first], &edges[next]) == 0;)
            next++;
        // seen the same way round, one of the two triangles is turned over
        const bool inner =
            next == first + 2 && (faces_light(b, edges[first].triangle) ^ edges[first].turned) !=
                                     (faces_light(b, edges[first + 1].triangle) ^ edges[first + 1].turned);
        if (!inner) {
            add_quad(b, edges[first].from, edges[first].to);
            found++;
        }
    }
    free(edges);
    free(place);
    return found;
}

Bounds bounds_open(const Scene *scene, const Light *light, int width, int height)
{
    const Mesh *mesh = &scene->mesh;
    const vec3 extinction = scene->medium.scattering + scene->medium.absorption;
    const float size = vec3_length(scene->upper - scene->lower),
                least = fminf(extinction[0], fminf(extinction[1], extinction[2]));
    Builder b = {.mesh = mesh, .light = light};
    b.reach = SIZES * (size + vec3_length(scene->camera.eye - 0.5f * (scene->lower + scene->upper)));
    if (light->kind != LIGHT_DIRECTIONAL)
        b.reach += vec3_length(light->position - 0.5f * (scene->lower + scene->upper));
    if (least > 0.0f)
        b.reach = fmaxf(b.reach, EXPONENTS / least);
    Bounds bounds = {.edges = add_quads(&b)};
    for (uint32_t i = 0; i < mesh->triangle_count; i++)
        for (uint32_t k = 0; k < 6; k++) { // also those turned away: an open mesh casts by both sides
            const vec3 p = corner_at(mesh, 3 * i + k % 3);
            add_vertex(&b, k < 3 ? p : thrown(&b, p));
        }
    bounds.shader = shader_open("bounds", NULL, "06_epipolar_vsv/bounds.vert", "06_epipolar_vsv/bounds.frag");
    bounds.vertex_count = (GLsizei)b.count;
    add_vertex(&b, vec3_make(0, 0, 0)); // so that no buffer is empty
    bounds.vertices =
        gl_buffer(.label = "shadow volumes", .bytes = 3 * b.count * sizeof(float), .data = b.positions);
    free(b.positions);
    gl.CreateVertexArrays(1, &bounds.vertex_array);
    gl.VertexArrayVertexBuffer(bounds.vertex_array, 0, bounds.vertices, 0, 3 * sizeof(float));
    gl.VertexArrayAttribFormat(bounds.vertex_array, 0, 3, GL_FLOAT, GL_FALSE, 0);
    gl.VertexArrayAttribBinding(bounds.vertex_array, 0, 0);
    gl.EnableVertexArrayAttrib(bounds.vertex_array, 0);
    bounds.texture = gl_texture(.label = "bounds", .format = GL_RG32F, .width = width, .height = height);
    bounds.framebuffer = gl_framebuffer(.label = "bounds", .color = {bounds.texture});
    return bounds;
}

void bounds_close(Bounds *bounds)
{
    shader_close(bounds->shader);
    gl_buffer_delete(&bounds->vertices);
    if (bounds->vertex_array)
        gl.DeleteVertexArrays(1, &bounds->vertex_array);
    gl_texture_delete(&bounds->texture);
    gl_framebuffer_delete(&bounds->framebuffer);
}

void bounds_draw(const Bounds *bounds, const Camera *camera, int width, int height)
{
    static const float none[4] = {INFINITY, INFINITY};
    gl.ClearNamedFramebufferfv(bounds->framebuffer, GL_COLOR, 0, none);
    gl.BindFramebuffer(GL_FRAMEBUFFER, bounds->framebuffer);
    gl.Viewport(0, 0, width, height);
    gl.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE); // as camera_clip says
    gl.Enable(GL_BLEND);
    gl.BlendEquation(GL_MIN);
    shader_use(bounds->shader);
    raster_set_camera(bounds->shader, camera, (float)width / (float)height);
    shader_set_float(bounds->shader, "near_distance", camera->near_distance);
    gl.BindVertexArray(bounds->vertex_array);
    gl.DrawArrays(GL_TRIANGLES, 0, bounds->vertex_count);
    gl.BlendEquation(GL_FUNC_ADD);
    gl.Disable(GL_BLEND);
    gl.ClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    gl.MemoryBarrier(GL_ALL_BARRIER_BITS);
    gl.BindImageTexture(5, bounds->texture, 0, GL_FALSE, 0, GL_READ_ONLY, GL_RG32F);
}
