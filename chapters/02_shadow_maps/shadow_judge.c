// shadow_judge: see shadow_judge.h.
#include "shadow_judge.h"
#include "shadow_scenes.h"
#include <stdlib.h>
#include <string.h>

// Surface points and normals are the G-buffer's, rays are our own: rounded to 3e-6 of the distance to the eye, a point may lie that much behind
// its triangle, and a shadow ray that starts there meets it. So it starts this share of the distance before the surface.
static const float OFF_SURFACE = 1e-5f;

static uint32_t *read_triangles(const GBuffer *gbuffer)
{
    const size_t pixels = (size_t)gbuffer->width * (size_t)gbuffer->height;
    uint32_t *triangles = memory_new(pixels, sizeof *triangles, "the triangles seen");
    gl_texture_read(gbuffer->triangle, 0, GL_RED_INTEGER, GL_UNSIGNED_INT, pixels * sizeof *triangles,
                    triangles);
    return triangles;
}

static float *read_floats(GLuint texture, GLenum format, size_t channels, size_t pixels)
{
    const size_t bytes = memory_bytes(pixels, channels * sizeof(float), "a texture read back");
    float *data = memory_new(pixels * channels, sizeof(float), "a texture read back");
    gl_texture_read(texture, 0, format, GL_FLOAT, bytes, data);
    return data;
}

Scene judge_scene(const Scene *scene, vec3 *offset)
{
    const float diagonal = vec3_length(scene->upper - scene->lower);
    const bool far = vec3_length(scene->lower) > 64.0f * diagonal && diagonal > 0.0f;
    *offset = far ? scene->lower : vec3_make(0, 0, 0);
    Scene moved = *scene;
    moved.lower -= *offset;
    moved.upper -= *offset;
    moved.camera.eye -= *offset;
    moved.camera.target -= *offset;
    moved.mesh.positions =
        memory_new(3 * scene->mesh.vertex_count + 1, sizeof(float), "the truth's positions");
    for (size_t i = 0; i < 3 * scene->mesh.vertex_count; i++)
        moved.mesh.positions[i] = scene->mesh.positions[i] - (*offset)[i % 3];
    moved.lights = memory_new(scene->light_count + 1, sizeof(Light), "the truth's lights");
    for (size_t i = 0; i < scene->light_count; i++) {
        moved.lights[i] = scene->lights[i];
        moved.lights[i].position -= *offset;
    }
    return moved;
}

void judge_scene_free(Scene *scene)
{
    free(scene->mesh.positions);
    free(scene->lights);
}

// The eye's ray through the middle of a pixel, unit; row 0 is the bottom.
static vec3 pixel_ray(const Camera *camera, int x, int y, int width, int height)
{
    const vec3 ahead = vec3_normalize(camera->target - camera->eye);
    vec3 right = vec3_normalize(vec3_cross(ahead, camera->up));
    if (vec3_length(right) < 0.5f) // straight up or down: as mat4_look_at takes another axis
        return vec3_make(0, 0, 0);
    const vec3 up = vec3_cross(right, ahead);
    const float scale = 2.0f * tanf(0.5f * camera->vertical_fov_rad) / (float)height;
    return vec3_normalize(ahead + scale * ((float)x + 0.5f - 0.5f * (float)width) * right +
                          scale * ((float)y + 0.5f - 0.5f * (float)height) * up);
}

// Whether the side of the triangle that the eye's ray meets looks away from the light.
static bool turned_away(const Mesh *mesh, uint32_t triangle, vec3 ray, vec3 to_light)
{
    vec3 corner[3];
    for (int k = 0; k < 3; k++) {
        const float *p = mesh->positions + 3 * (size_t)mesh->indices[3 * (size_t)triangle + (size_t)k];
        corner[k] = vec3_make(p[0], p[1], p[2]);
    }
    const vec3 normal = vec3_normalize(vec3_cross(corner[1] - corner[0], corner[2] - corner[0]));
    return vec3_dot(normal, ray) * vec3_dot(normal, to_light) > 0.0f;
}

Visibility judge_visibility(const Asked *asked, const Truth *truth, size_t light_index)
{
    const int width = asked->gbuffer->width, height = asked->gbuffer->height;
    const size_t pixels = (size_t)width * (size_t)height;
    const Light *light = &asked->scene->lights[light_index];
    const float sky_gap =
        4.0f * vec3_length(asked->scene->upper - asked->scene->lower) +
        vec3_length(asked->camera.eye - asked->scene->lower); // leaves the scene from anywhere
    Visibility v = {width, height, read_floats(asked->visibility[light_index], GL_RED, 1, pixels),
                    memory_new(pixels, sizeof(float), "the true visibilities"),
                    memory_new(pixels, sizeof(bool), "pixels turned away")};
    uint32_t *triangles = read_triangles(asked->gbuffer); // number + 1
    float *distance = read_floats(asked->gbuffer->distance, GL_RED, 1, pixels);
    float *normals = read_floats(asked->gbuffer->normal, GL_RGBA, 4, pixels);
    // Where the truth's rays are blind, a closed form decides: −1 elsewhere.
    float *closed = memory_new(pixels, sizeof *closed, "closed forms");
    vec3 *from = memory_new(pixels, sizeof *from, "shadow rays"),
         *to = memory_new(pixels, sizeof *to, "shadow rays");
    size_t count = 0;
    for (size_t i = 0; i < pixels; i++) {
        if (v.got[i] < 0.0f)
            continue;
        const vec3 ray =
            pixel_ray(&asked->camera, (int)(i % (size_t)width), (int)(i / (size_t)width), width, height);
        const vec3 normal = vec3_make(normals[4 * i], normals[4 * i + 1], normals[4 * i + 2]);
        const vec3 point = asked->camera.eye + distance[i] * ray + OFF_SURFACE * distance[i] * (normal - ray);
        closed[i] = (float)scenes_lit_at(asked->scene->name, light->kind, point);
        from[count] = point;
        to[count] = light->kind == LIGHT_DIRECTIONAL ? point - sky_gap * light->direction : light->position;
        v.turned_away[i] = turned_away(&asked->scene->mesh, triangles[i] - 1, ray, to[count] - point);
        count++;
    }
    uint32_t *occluded = truth_occluded_many(truth, from, to, count);
    for (size_t i = 0, k = 0; i < pixels; i++) {
        v.truth[i] = v.got[i] < 0.0f ? -1.0f : occluded[k >> 5] >> (k & 31) & 1 ? 0.0f : 1.0f;
        k += v.got[i] >= 0.0f;
        if (v.turned_away[i])
            v.truth[i] = 0.0f;
        if (v.got[i] >= 0.0f && closed[i] >= 0.0f)
            v.truth[i] = closed[i];
    }
    free(occluded);
    free(triangles);
    free(closed);
    free(from);
    free(to);
    free(distance);
    free(normals);
    return v;
}

void judge_visibility_free(Visibility *visibility)
{
    free(visibility->got);
    free(visibility->truth);
    free(visibility->turned_away);
}

static bool is_judged(const Visibility *v, size_t i)
{
    return v->truth[i] >= 0.0f && !(v->turned_away && v->turned_away[i]);
}

static bool is_wrong(const Visibility *v, size_t i)
{
    return is_judged(v, i) && (v->got[i] >= 0.5f) != (v->truth[i] >= 0.5f);
}

// Squares of growing size about the pixel, until none of the rest can be nearer. The picture's diagonal where there is no other pixel.
static double distance_to_edge(const Visibility *v, int x, int y)
{
    const float here = v->truth[(size_t)y * (size_t)v->width + (size_t)x];
    double nearest = hypot(v->width, v->height);
    for (int ring = 1; ring < nearest && (ring < v->width || ring < v->height); ring++)
        for (int dy = -ring; dy <= ring; dy++) {
            const int step = abs(dy) == ring ? 1 : 2 * ring;
            for (int dx = -ring; dx <= ring; dx += step) {
                const int px = x + dx, py = y + dy;
                if (px < 0 || py < 0 || px >= v->width || py >= v->height)
                    continue;
                const size_t there = (size_t)py * (size_t)v->width + (size_t)px;
                if (is_judged(v, there) && v->truth[there] != here)
                    nearest = fmin(nearest, hypot(dx, dy));
            }
        }
    return nearest;
}

static int compare_doubles(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

Judgement judge_of(const Visibility *visibilities, size_t count)
{
    Judgement sum = {0};
    size_t wrong = 0, capacity = 0;
    double *distances = NULL;
    for (size_t l = 0; l < count; l++) {
        const Visibility *v = &visibilities[l];
        const size_t pixels = (size_t)v->width * (size_t)v->height;
        for (size_t i = 0; i < pixels; i++) {
            if (!is_judged(v, i)) {
                sum.turned_away += v->truth[i] >= 0.0f;
                continue;
            }
            sum.asked++;
            sum.difference += fabs((double)v->got[i] - (double)v->truth[i]);
            if (!is_wrong(v, i))
                continue;
            *(v->truth[i] > 0.5f ? &sum.dark : &sum.leaked) += 1;
            if (wrong == capacity) {
                capacity = capacity ? 2 * capacity : 256;
                distances = memory_grow(distances, capacity, sizeof *distances, "the wrong pixels");
            }
            distances[wrong] = distance_to_edge(v, (int)(i % (size_t)v->width), (int)(i / (size_t)v->width));
            sum.distance_mean += distances[wrong++];
        }
    }
    const double asked = fmax(sum.asked, 1.0);
    sum.turned_away /= fmax(sum.asked + sum.turned_away, 1.0);
    sum.wrong = (double)wrong / asked;
    sum.dark /= asked;
    sum.leaked /= asked;
    sum.difference /= asked;
    if (wrong > 0) {
        qsort(distances, wrong, sizeof *distances, compare_doubles);
        sum.distance_mean /= (double)wrong;
        sum.distance_p99 = distances[(size_t)ceil(0.99 * (double)wrong) - 1];
        sum.distance_most = distances[wrong - 1];
    }
    free(distances);
    return sum;
}

Judgement judge_all(const Asked *asked, const Truth *truth)
{
    const size_t count = asked->scene->light_count;
    Visibility *v = memory_new(count ? count : 1, sizeof *v, "the visibilities");
    for (size_t i = 0; i < count; i++)
        v[i] = judge_visibility(asked, truth, i);
    Judgement judgement = judge_of(v, count);
    for (size_t i = 0; i < count; i++)
        judge_visibility_free(&v[i]);
    free(v);
    return judgement;
}

static void upload(GLuint texture, const Visibility *v, GLenum format, const float *pixels)
{
    gl.TextureSubImage2D(texture, 0, 0, 0, v->width, v->height, format, GL_FLOAT, pixels);
    gl.MemoryBarrier(GL_ALL_BARRIER_BITS);
}

void judge_show(const Asked *asked, const Truth *truth, size_t light, GLuint picture)
{
    Visibility v = judge_visibility(asked, truth, light);
    const size_t pixels = (size_t)v.width * (size_t)v.height;
    float *rgba = memory_new(pixels, 4 * sizeof(float), "the difference");
    for (size_t i = 0; i < pixels; i++) {
        const float grey = v.truth[i] < 0.0f ? 0.01f : 0.03f + 0.25f * v.truth[i];
        const float error = v.truth[i] < 0.0f ? 0.0f : v.got[i] - v.truth[i];
        const float green = is_judged(&v, i) ? 0.0f : fmaxf(error, 0.0f); // with the blue below: cyan
        const float shown[] = {grey + fmaxf(-error, 0.0f), grey + green, grey + fmaxf(error, 0.0f), 1.0f};
        memcpy(rgba + 4 * i, shown, sizeof shown);
    }
    upload(picture, &v, GL_RGBA, rgba);
    free(rgba);
    judge_visibility_free(&v);
}

Image judge_paint(const Asked *asked, const Truth *truth, size_t light)
{
    static const float nothing[] = {0.01f, 0.015f, 0.05f}; // as paint.comp
    Image image = image_make(asked->gbuffer->width, asked->gbuffer->height, 3);
    if (light >= asked->scene->light_count)
        return image;
    Visibility v = judge_visibility(asked, truth, light);
    for (size_t i = 0; i < (size_t)v.width * (size_t)v.height; i++) {
        const size_t row = (size_t)v.height - 1 - i / (size_t)v.width;
        const float seen = v.truth[row * (size_t)v.width + i % (size_t)v.width];
        for (size_t c = 0; c < 3; c++)
            image.pixels[3 * i + c] = seen < 0.0f ? nothing[c] : seen;
    }
    judge_visibility_free(&v);
    return image;
}

void judge_rays(const Asked *asked, const Truth *truth, size_t light)
{
    Visibility v = judge_visibility(asked, truth, light);
    upload(asked->visibility[light], &v, GL_RED, v.truth);
    judge_visibility_free(&v);
}
