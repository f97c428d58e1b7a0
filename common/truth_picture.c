// truth: the picture of a scene in a homogeneous medium: single scattering by quadrature over exactly lit stretches, surfaces by Embree.
#include "truth_internal.h"

#include <gsl/gsl_errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// The camera's axes in double, x and y half as long as the picture is wide and high at 1 m.
typedef struct View {
    double eye[3], x[3], y[3], forward[3];
} View;

static View view_of(const Camera *camera, int width, int height)
{
    const mat4 turn = camera_view(*camera); // its rows are the axes
    const double half = tan(0.5 * (double)camera->vertical_fov_rad);
    View view;
    for (int k = 0; k < 3; k++) {
        view.eye[k] = (double)camera->eye[k];
        view.x[k] = half * width / height * (double)turn.column[k][0];
        view.y[k] = half * (double)turn.column[k][1];
        view.forward[k] = -(double)turn.column[k][2];
    }
    return view;
}

static void view_ray(const View *view, double u, double v, double direction[3]) // u, v in [-1, 1], v up
{
    double length = 0.0;
    for (int k = 0; k < 3; k++) {
        direction[k] = view->forward[k] + u * view->x[k] + v * view->y[k];
        length = hypot(length, direction[k]);
    }
    for (int k = 0; k < 3; k++)
        direction[k] /= length;
}

// The ray, and what it hits.
static TruthHit view_hit(const View *view, const Truth *truth, const Camera *camera, double u, double v,
                         double direction[3])
{
    view_ray(view, u, v, direction);
    return truth_ray(truth, camera->eye,
                     vec3_make((float)direction[0], (float)direction[1], (float)direction[2]));
}

// Barycentric, from the areas opposite each corner; on the side that the ray comes from.
static vec3 smooth_normal(const Mesh *mesh, TruthHit hit, vec3 point, vec3 along)
{
    vec3 corner[3], normal = {0};
    for (size_t i = 0; i < 3; i++) {
        const float *p = mesh->positions + 3 * (size_t)mesh->indices[3 * (size_t)hit.triangle + i];
        corner[i] = vec3_make(p[0], p[1], p[2]);
    }
    for (size_t i = 0; i < 3; i++) {
        const float *n = mesh->normals + 3 * (size_t)mesh->indices[3 * (size_t)hit.triangle + i];
        const vec3 area = vec3_cross(corner[(i + 1) % 3] - point, corner[(i + 2) % 3] - point);
        normal += vec3_dot(area, hit.normal) * vec3_make(n[0], n[1], n[2]);
    }
    normal = vec3_normalize(normal);
    return vec3_dot(hit.normal, along) > 0.0f ? -normal : normal;
}

// Lambertian surfaces lit past Embree's occluders, dimmed from the light (none for a directional one) and to the eye.
static void surface_truth(const Truth *truth, const Scene *scene, const View *view, const double direction[3],
                          TruthHit hit, float ambient, double radiance[3])
{
    const double distance = (double)hit.distance;
    vec3 point = {0}, along = {0};
    for (int k = 0; k < 3; k++) {
        point[k] = (float)(view->eye[k] + distance * direction[k]);
        along[k] = (float)direction[k];
    }
    const Material *material = &scene->materials[scene->mesh.triangle_material[hit.triangle]];
    const vec3 normal = smooth_normal(&scene->mesh, hit, point, along);
    const float diagonal = vec3_length(scene->upper - scene->lower);
    for (int k = 0; k < 3; k++) {
        const double sigma = (double)scene->medium.scattering[k] + (double)scene->medium.absorption[k];
        radiance[k] += ((double)material->emission[k] + (double)ambient * (double)material->albedo[k]) *
                       exp(-sigma * distance);
    }
    for (size_t i = 0; i < scene->light_count; i++) {
        const Light *light = &scene->lights[i];
        const bool sun = light->kind == LIGHT_DIRECTIONAL;
        const vec3 from = sun ? point - 2.0f * diagonal * light->direction : light->position,
                   way = from - point;
        const double far = (double)vec3_length(way), held = fmax(far, (double)light->radius);
        const double cosine = (double)vec3_dot(way, normal) / far;
        const bool outside = light->kind == LIGHT_SPOT &&
                             atan2((double)vec3_length(vec3_cross(light->direction, -way)),
                                   (double)vec3_dot(light->direction, -way)) > (double)light->half_angle_rad;
        if (cosine <= 0.0 || outside || truth_occluded(truth, point, from))
            continue;
        for (int k = 0; k < 3; k++) {
            const double sigma = (double)scene->medium.scattering[k] + (double)scene->medium.absorption[k];
            radiance[k] += (double)material->albedo[k] / M_PI * cosine * (double)light->intensity[k] /
                           (sun ? 1.0 : held * held) * exp(-sigma * (distance + (sun ? 0.0 : far)));
        }
    }
}

static char *cache_path(const Scene *scene, const Camera *camera, int width, int height, int every,
                        const TruthPhase *phase, float ambient)
{
    const float view[] = {
        camera->eye[0],    camera->eye[1],           camera->eye[2], camera->target[0],
        camera->target[1], camera->target[2],        camera->up[0],  camera->up[1],
        camera->up[2],     camera->vertical_fov_rad, ambient,        (float)phase->rayleigh_share};
    const int size[] = {width, height, every};
    uint64_t inputs = hash_bytes(truth_hash_scene(scene), view, sizeof view);
    inputs = hash_bytes(hash_bytes(inputs, size, sizeof size), phase->name, strlen(phase->name));
    return truth_cache_path("airlight", inputs, ".exr");
}

// One picture that many threads draw, a row at a time.
typedef struct Drawing {
    const Truth *truth;
    const TruthShadows *shadows;
    const Scene *scene;
    const Camera *camera;
    const TruthPhase *phase;
    float ambient;
    int width, height, every; // of the whole picture; the image has its every-th rows and columns
    View view;
    Image image;
    atomic_int next;
} Drawing;

static void draw_pixel(const Drawing *drawing, int column, int row, float *pixel)
{
    double direction[3], radiance[3];
    const double u = 2.0 * (column + 0.5) / drawing->width - 1.0,
                 v = 1.0 - 2.0 * (row + 0.5) / drawing->height;
    const TruthHit hit = view_hit(&drawing->view, drawing->truth, drawing->camera, u, v, direction);
    truth_airlight_quiet(drawing->shadows, drawing->scene, drawing->phase, drawing->view.eye, direction,
                         (double)hit.distance, radiance);
    if (drawing->ambient >= 0.0f && isfinite(hit.distance))
        surface_truth(drawing->truth, drawing->scene, &drawing->view, direction, hit, drawing->ambient,
                      radiance);
    for (int k = 0; k < 3; k++)
        pixel[k] = (float)radiance[k];
    pixel[3] = 1.0f;
}

static void *draw_some(void *shared)
{
    Drawing *drawing = shared;
    const Image *image = &drawing->image;
    for (int row; (row = atomic_fetch_add(&drawing->next, 1)) < image->height;)
        for (int column = 0; column < image->width; column++)
            draw_pixel(drawing, drawing->every * column, drawing->every * row,
                       image->pixels + 4 * ((size_t)row * (size_t)image->width + (size_t)column));
    return NULL;
}

Image truth_airlight_draw(const Scene *scene, const Camera *camera, int width, int height, int every,
                          const TruthPhase *phase, float ambient, int threads)
{
    Truth *truth = truth_open(&scene->mesh);
    TruthShadows *shadows = truth_shadows_open(&scene->mesh, truth);
    Drawing drawing = {.truth = truth,
                       .shadows = shadows,
                       .scene = scene,
                       .camera = camera,
                       .phase = phase,
                       .ambient = ambient,
                       .width = width,
                       .height = height,
                       .every = every,
                       .view = view_of(camera, width, height),
                       .image = image_make((width - 1) / every + 1, (height - 1) / every + 1, 4)};
    gsl_error_handler_t *handler = gsl_set_error_handler_off(); // all threads have one handler
    truth_run(draw_some, &drawing, threads);
    gsl_set_error_handler(handler);
    truth_shadows_close(shadows);
    truth_close(truth);
    return drawing.image;
}

Image truth_airlight_picture(const Scene *scene, const Camera *camera, int width, int height, int every,
                             const TruthPhase *phase, float ambient)
{
    char *path = cache_path(scene, camera, width, height, every, phase, ambient);
    const bool kept = access(path, R_OK) == 0;
    Image image =
        kept ? image_read(path) : truth_airlight_draw(scene, camera, width, height, every, phase, ambient, 0);
    if (!kept)
        image_write(path, &image, 0.0f);
    free(path);
    return image;
}

int truth_every(int height)
{
    return height > 256 ? height / 256 : 1;
}

TruthSpan *truth_lit_picture(const Scene *scene, const Light *light, const Camera *camera, int width,
                             int height, uint32_t *first)
{
    const View view = view_of(camera, width, height);
    Truth *truth = truth_open(&scene->mesh);
    TruthShadows *shadows = truth_shadows_open(&scene->mesh, truth);
    TruthSpan *all = memory_new(1, sizeof *all, "lit spans");
    first[0] = 0;
    for (int i = 0; i < width * height; i++) {
        double direction[3];
        size_t count;
        const int column = i % width, row = i / width;
        const TruthHit hit = view_hit(&view, truth, camera, 2.0 * (column + 0.5) / width - 1.0,
                                      2.0 * (row + 0.5) / height - 1.0, direction);
        TruthSpan *spans =
            truth_lit_spans(shadows, light, view.eye, direction, 1.001 * (double)hit.distance, &count);
        if (first[i] + count > UINT32_MAX)
            fail_work("truth: more than 2^32 - 1 lit spans in a picture");
        first[i + 1] = first[i] + (uint32_t)count;
        all = memory_grow(all, (size_t)first[i + 1] + 1, sizeof *all, "lit spans");
        memcpy(all + first[i], spans, count * sizeof *spans);
        free(spans);
    }
    truth_shadows_close(shadows);
    truth_close(truth);
    return all;
}
