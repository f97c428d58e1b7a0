// baseline: see baseline.h.
#include "baseline.h"

#include <stdlib.h>
#include <string.h>

// What rays.h takes, read back from the GPU.
typedef struct Inputs {
    TruthPhase phase;
    float *distance, *angles;
    RaysView view;
} Inputs;

static void inputs_read(Inputs *inputs, const Vsv *vsv, const QueryView *view,
                        const AirlightSettings *settings, int samples)
{
    EpipolarRange range = vsv->range;
    range.phi = samples > 0 ? samples : range.phi;
    const int width = view->gbuffer->width, height = view->gbuffer->height;
    const size_t pixels = (size_t)width * (size_t)height;
    inputs->phase = (TruthPhase){settings->phase, (double)view->scene->medium.mean_cosine,
                                 (double)settings->rayleigh_share};
    inputs->distance = memory_new(pixels, sizeof(float), "distances");
    gl_texture_read(view->gbuffer->distance, 0, GL_RED, GL_FLOAT, pixels * sizeof(float), inputs->distance);
    inputs->angles = rays_angles(&range, strcmp(vsv->settings.warp, "square") == 0);
    inputs->view = (RaysView){.scene = view->scene,
                              .light = view->light,
                              .camera = view->camera,
                              .frame = vsv->frame,
                              .phase = &inputs->phase,
                              .width = width,
                              .height = height,
                              .distance = inputs->distance,
                              .border = inputs->angles,
                              .middle = inputs->angles + range.phi + 1,
                              .phi = range.phi};
}

static void inputs_free(Inputs *inputs)
{
    free(inputs->distance);
    free(inputs->angles);
}

RaysCount baseline_airlight(const Rays *rays, const Vsv *vsv, const QueryView *view,
                            const AirlightSettings *settings, int samples, GLuint picture)
{
    Inputs inputs;
    inputs_read(&inputs, vsv, view, settings, samples);
    const size_t values = 4 * (size_t)inputs.view.width * (size_t)inputs.view.height;
    float *radiance = memory_new(values, sizeof *radiance, "a picture");
    gl_texture_read(picture, 0, GL_RGBA, GL_FLOAT, values * sizeof *radiance, radiance);
    const RaysCount count = rays_draw(rays, &inputs.view, radiance);
    gl.TextureSubImage2D(picture, 0, 0, 0, inputs.view.width, inputs.view.height, GL_RGBA, GL_FLOAT,
                         radiance);
    free(radiance);
    inputs_free(&inputs);
    return count;
}

RaysCount baseline_bare(const Rays *rays, const Vsv *vsv, const QueryView *view,
                        const AirlightSettings *settings, int samples, int stride)
{
    Inputs inputs;
    inputs_read(&inputs, vsv, view, settings, samples);
    const RaysCount count = rays_bare(rays, &inputs.view, stride);
    inputs_free(&inputs);
    return count;
}
