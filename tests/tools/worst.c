// worst: where chapter 04's methods are most wrong: random eyes, lights, media and phase functions, 64 rays each, every method's own shader against the truth.
//
//     build/worst [--views N] [--seed N] [--keep N] > chapters/04_airlight/worst.inc
//
// 1563 views are 10⁵ rays a method. The worst views become cases of the chapter's stability table, as rows of C. A minute or two on two cores.
#include <argp.h>
#include <gsl/gsl_errno.h>
#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "../../chapters/04_airlight/closed_form.h"
#include "../../chapters/04_airlight/judge.h"
#include "../../chapters/04_airlight/scenes.h"
#include "truth.h"

enum { SIDE = 8, RAYS = SIDE * SIDE, MOST_THREADS = 64 };

typedef struct Request {
    long views, keep;
    uint64_t seed;
} Request;

static const struct argp_option options[] = {
    {"views", 'v', "N", 0, "Views of 64 rays (default 1563: 100 000 rays)", 0},
    {"keep", 'k', "N", 0, "The worst views of each method that are written (default 10)", 0},
    {"seed", 's', "N", 0, "What is random is drawn from it (default 1)", 0},
    {0},
};

static error_t parse(int key, char *argument, struct argp_state *state)
{
    Request *request = state->input;
    char *end = NULL;
    const long value = argument ? strtol(argument, &end, 10) : 0;
    if (argument && (*end || value < 1 || value > 1000000))
        argp_error(state, "'%s': a whole number from 1 to 1000000 is needed", argument);
    switch (key) {
    case 'v':
        request->views = value;
        return 0;
    case 'k':
        request->keep = value;
        return 0;
    case 's':
        request->seed = (uint64_t)value;
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

// In [0, 1): splitmix64 (Steele et al. 2014), so that a seed draws the same everywhere.
static double draw(uint64_t *state)
{
    uint64_t z = *state += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}
static double draw_power(uint64_t *state, double least, double most) // of ten, each decade alike
{
    return pow(10.0, least + (most - least) * draw(state));
}
static vec3 draw_direction(uint64_t *state)
{
    const double z = 2.0 * draw(state) - 1.0, turn = 2.0 * M_PI * draw(state), r = sqrt(1.0 - z * z);
    return vec3_make((float)(r * cos(turn)), (float)(r * sin(turn)), (float)z);
}

// What a case sets; degrees and metres as on the command line.
typedef struct View {
    vec3 eye, target, position, towards;
    double fov_deg, half_angle_deg;
    float scattering, absorption, mean_cosine;
} View;

// A light a millimetre to a hundred metres off, at any angle to the view and often near a ray of it; mist that hardly is there, up to 10 optical depths to the
// light; a peak of any width to a thousandth, forward and backward.
static View view_draw(uint64_t seed, long number)
{
    uint64_t state = seed * 0x2545f4914f6cdd1du + (uint64_t)number * 0x9e3779b97f4a7c15u;
    View view = {.eye = (float)(4.0 * draw(&state)) * draw_direction(&state)};
    const vec3 to_light = draw_direction(&state);
    const double far = draw_power(&state, -3, 2), aside = draw_power(&state, -3, 0.7);
    const vec3 ahead = vec3_normalize(to_light + (float)aside * draw_direction(&state));
    view.position = view.eye + (float)far * to_light;
    view.target = view.eye + ahead;
    view.fov_deg = draw_power(&state, -1, 2);
    const double sigma = draw_power(&state, -6, 1) / far, share = 0.05 + 0.95 * draw(&state);
    view.scattering = (float)(share * sigma);
    view.absorption = (float)((1.0 - share) * sigma);
    const double g = fmin(1.0 - draw_power(&state, -3, 0), 0.999);
    view.mean_cosine = (float)(draw(&state) < 0.5 ? -g : g);
    const vec3 lit = view.eye + (float)(2.0 * far * draw(&state)) * ahead;
    view.towards = vec3_normalize(lit - view.position + (float)(0.3 * far) * draw_direction(&state));
    view.half_angle_deg = draw_power(&state, 0, 1.9);
    return view;
}

static void view_apply(const View *view, Scene *scene)
{
    Light *light = &scene->lights[0];
    light->position = view->position;
    if (light->kind == LIGHT_SPOT) {
        light->direction = view->towards;
        light->half_angle_rad = (float)(view->half_angle_deg * M_PI / 180.0);
    }
    scene->camera.eye = view->eye;
    scene->camera.target = view->target;
    scene->camera.vertical_fov_rad = (float)(view->fov_deg * M_PI / 180.0);
    scene->medium = (Medium){view->scattering * vec3_make(1, 1, 1), view->absorption * vec3_make(1, 1, 1),
                             view->mean_cosine};
}

// --- the truth ------------------------------------------------------------------------------------------------------------

typedef struct Truths {
    const Request *request;
    const SceneKind *kind;
    const TruthPhase *phase;
    double *red; // RAYS a view, bottom row first
    atomic_long next;
} Truths;

static void truth_of(const Scene *scene, const TruthPhase *phase, double red[RAYS])
{
    const mat4 turn = camera_view(scene->camera); // its rows are the axes
    const double half = tan(0.5 * (double)scene->camera.vertical_fov_rad);
    Truth *truth = truth_open(&scene->mesh);
    TruthShadows *shadows = truth_shadows_open(&scene->mesh, truth);
    for (int i = 0; i < RAYS; i++) {
        const int column = i % SIDE, row = i / SIDE;
        const double u = half * (2.0 * (column + 0.5) / SIDE - 1.0),
                     v = half * (2.0 * (row + 0.5) / SIDE - 1.0);
        double origin[3], direction[3], radiance[3], length = 0.0;
        for (int k = 0; k < 3; k++) {
            origin[k] = (double)scene->camera.eye[k];
            direction[k] =
                u * (double)turn.column[k][0] + v * (double)turn.column[k][1] - (double)turn.column[k][2];
            length = hypot(length, direction[k]);
        }
        for (int k = 0; k < 3; k++)
            direction[k] /= length;
        truth_airlight(shadows, scene, phase, origin, direction, INFINITY, radiance);
        size_t count;
        TruthSpan *spans = truth_lit_spans(shadows, &scene->lights[0], origin, direction, INFINITY, &count);
        const double far = (double)vec3_length(scene->lights[0].position - scene->camera.eye);
        red[i] =
            count > 0 && airlight_chord_counts(spans[0], far) && radiance[0] >= 1.2e-38 ? radiance[0] : -1.0;
        free(spans);
    }
    truth_shadows_close(shadows);
    truth_close(truth);
}

static void *truths_some(void *data)
{
    Truths *truths = data;
    Scene *scene = scene_from(truths->kind, 1);
    for (long i; (i = atomic_fetch_add(&truths->next, 1)) < truths->request->views;) {
        const View view = view_draw(truths->request->seed, i);
        view_apply(&view, scene);
        const TruthPhase phase = {truths->phase->name, (double)scene->medium.mean_cosine, 0.0};
        truth_of(scene, &phase, truths->red + i * RAYS);
    }
    scene_close(scene);
    return NULL;
}

static double *truths_make(const Request *request, const SceneKind *kind, const char *phase)
{
    Truths truths = {.request = request, .kind = kind, .phase = &(TruthPhase){.name = phase}};
    truths.red = memory_new((size_t)request->views * RAYS, sizeof(double), "the truth");
    pthread_t threads[MOST_THREADS];
    const long wanted = sysconf(_SC_NPROCESSORS_ONLN);
    int started = 0;
    while (started < wanted - 1 && started < MOST_THREADS &&
           pthread_create(&threads[started], NULL, truths_some, &truths) == 0)
        started++;
    truths_some(&truths);
    for (int i = 0; i < started; i++)
        pthread_join(threads[i], NULL);
    return truths.red;
}

// --- the methods ----------------------------------------------------------------------------------------------------------

typedef struct Method {
    const char *name, *scene, *phase, *set, *method, *variant;
} Method;
// In mist alone a point light's ray is one lit stretch; a spot's cone cuts one out, which tells segments from signed sums.
#define OPEN(name, phase, set, method)                                                                       \
    {                                                                                                        \
        name, "haze", phase, set, method, "intervals"                                                        \
    }
#define PEAKED "henyey_greenstein"
static const Method methods[] = {
    OPEN("march", PEAKED, "method=march steps=64", "march"),
    OPEN("jittered", PEAKED, "method=jittered steps=64", "jittered"),
    OPEN("equiangular", PEAKED, "method=equiangular steps=64", "equiangular"),
    OPEN("factored", PEAKED, "method=factored steps=64", "factored"),
    OPEN("gauss", PEAKED, "method=gauss", "gauss"),
    OPEN("sun", "uniform", "method=sun", "sun"),
    OPEN("pegoraro", "uniform", "method=pegoraro", "pegoraro"),
    {"segments", "beam", PEAKED, "method=segments", "segments", "intervals"},
    {"signed", "beam", PEAKED, "method=segments variant=signed", "segments", "signed"},
};
enum { METHODS = sizeof methods / sizeof *methods };

static const SceneKind *kind_of(const char *name)
{
    const SceneKind *kind = airlight_scenes;
    while (strcmp(kind->name, name) != 0)
        kind++;
    return kind;
}

typedef struct Found {
    double error;
    long view;
} Found;
static int by_error(const void *a, const void *b)
{
    const double x = ((const Found *)a)->error, y = ((const Found *)b)->error;
    return (x < y) - (x > y);
}

// As the stability cases judge it: the pixels' largest error over the truth. Negative truths are pixels that do not count: short chords, no normal float.
static double view_error(const float *got, const double *truth)
{
    double largest = 0.0;
    for (int i = 0; i < RAYS; i++) {
        const double error = fabs((double)got[4 * i] - truth[i]) / truth[i];
        if (truth[i] > 0.0)
            largest = isnan(error) ? INFINITY : fmax(largest, error);
    }
    return largest;
}

static void row_print(const Method *method, const View *view, long place, double error)
{
    printf("{\"worst of %s, %ld\", \"%s\", \"%s phase=%s ", method->name, place, method->scene, method->set,
           method->phase);
    printf("eye=%.9g,%.9g,%.9g target=%.9g,%.9g,%.9g fov_deg=%.17g ", (double)view->eye[0],
           (double)view->eye[1], (double)view->eye[2], (double)view->target[0], (double)view->target[1],
           (double)view->target[2], view->fov_deg);
    printf("light_position=%.9g,%.9g,%.9g ", (double)view->position[0], (double)view->position[1],
           (double)view->position[2]);
    if (strcmp(method->scene, "beam") == 0)
        printf("light_direction=%.9g,%.9g,%.9g light_half_angle_deg=%.17g ", (double)view->towards[0],
               (double)view->towards[1], (double)view->towards[2], view->half_angle_deg);
    printf(
        "scattering=%.9g,%.9g,%.9g absorption=%.9g,%.9g,%.9g mean_cosine=%.9g\", \"8x8\"}, // off by %.3g\n",
        (double)view->scattering, (double)view->scattering, (double)view->scattering,
        (double)view->absorption, (double)view->absorption, (double)view->absorption,
        (double)view->mean_cosine, error);
}

static void method_search(const Request *request, const Raster *raster, const Method *method,
                          const double *truth)
{
    Scene *scene = scene_from(kind_of(method->scene), 1);
    RasterView view = raster_view_open(raster, scene, SIDE, SIDE, 16);
    RasterTarget target = raster_target_open("airlight", SIDE, SIDE);
    GLuint table = closed_form_table(64);
    AirlightSettings settings = closed_form_settings((AirlightSettings){.method = method->method,
                                                                        .variant = method->variant,
                                                                        .phase = method->phase,
                                                                        .steps = 64,
                                                                        .seed = 1,
                                                                        .grey = true},
                                                     table);
    Airlight airlight = airlight_open(&settings, view.maps, 1);
    Found *found = memory_new((size_t)request->views, sizeof *found, "errors");
    raster_gbuffer_draw(raster, &view.gbuffer, &scene->camera, &view.mesh); // nothing is seen
    for (long i = 0; i < request->views; i++) {
        const View drawn = view_draw(request->seed, i);
        float got[4 * RAYS];
        view_apply(&drawn, scene);
        raster_view_aim(&view);
        raster_target_clear(&target);
        airlight_add(&airlight, &view.gbuffer, &scene->camera, scene, &scene->lights[0], &view.maps[0],
                     target.texture);
        gl_texture_read(target.texture, 0, GL_RGBA, GL_FLOAT, sizeof got, got);
        found[i] = (Found){view_error(got, truth + i * RAYS), i};
    }
    qsort(found, (size_t)request->views, sizeof *found, by_error);
    for (long place = 0; place < request->keep && place < request->views; place++) {
        const View drawn = view_draw(request->seed, found[place].view);
        row_print(method, &drawn, place + 1, found[place].error);
    }
    fprintf(stderr, "%-12s worst %.3g, the %ldth %.3g, the median %.3g\n", method->name, found[0].error,
            request->keep, found[request->keep - 1].error, found[request->views / 2].error);
    free(found);
    airlight_close(&airlight);
    gl_texture_delete(&table);
    raster_target_close(&target);
    raster_view_close(&view);
    scene_close(scene);
}

int main(int argc, char **argv)
{
    Request request = {1563, 10, 1};
    const struct argp argp = {options, parse, "",  "Search for the views in which airlight is most wrong.",
                              NULL,    NULL,  NULL};
    argp_parse(&argp, argc, argv, 0, NULL, &request);
    if (request.keep > request.views)
        fail_request("--keep %ld: more than the %ld views", request.keep, request.views);
    gsl_set_error_handler_off(); // GSL's handler is one for all threads
    gl_open(GL_PLATFORM_OSMESA, 16, 16, "worst");
    Raster *raster = raster_open();
    printf("// By build/worst --views %ld --seed %llu: of %ld random rays the worst views of each method.\n",
           request.views, (unsigned long long)request.seed, request.views * RAYS);
    double *peaked = truths_make(&request, kind_of("haze"), PEAKED),
           *uniform = truths_make(&request, kind_of("haze"), "uniform"),
           *cone = truths_make(&request, kind_of("beam"), PEAKED);
    for (int i = 0; i < METHODS; i++)
        method_search(&request, raster, &methods[i],
                      strcmp(methods[i].scene, "beam") == 0   ? cone
                      : strcmp(methods[i].phase, PEAKED) == 0 ? peaked
                                                              : uniform);
    free(peaked);
    free(uniform);
    free(cone);
    raster_close(raster);
    gl_close();
    return 0;
}
