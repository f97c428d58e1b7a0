// Chapter 02: light gathered from some texels of a reflective shadow map, against the sum over all of them.
#include "rsm_bounce.h"

// Towards the sum over every texel as samples grow. A shift for each pixel makes each sample uniform, so the order is 1/2 or better:
// 8 times less error by 64 times the samples; 6 leaves room for the noise of the first.
Test(rsm_importance, importance_converges_to_all)
{
    for (int k = 0; k < 4; k++) {
        LightKind kind = (LightKind)(k % 3);
        Bounce b = bounce_open(make, kind == LIGHT_DIRECTIONAL ? 0 : WALLS, FEW);
        Light light = light_of(kind, 0);
        if (k == 3) // a spot that looks up: most pixels lie behind it
            light.direction = vec3_normalize(vec3_make(0.5f, 0.25f, -0.5f)),
            light.position = vec3_make(-1, 3, 2);
        if (k == 3)
            light.kind = LIGHT_SPOT;
        Image all = bounce_light(&b, &light, 64, 0.5f, NULL);
        for (int way = 0; way < 2; way++) {
            double first = 0;
            for (int samples = 16; samples <= 1024; samples *= 64) {
                RsmPattern pattern = {.samples = samples,
                                      .radius = 1,
                                      .rotated = true,
                                      .sampling = way ? RSM_EVENLY : RSM_ABOUT_PIXEL,
                                      .seed = 5};
                Image some = bounce_light(&b, &light, 64, 0.5f, &pattern);
                ImageError error = image_compare(&some, &all);
                image_free(&some);
                if (samples == 16) {
                    first = error.nrmse;
                    continue;
                }
                cr_assert(error.nrmse < first / 6, "light %d, way %d: nrmse %g from %g", k, way, error.nrmse,
                          first);
                // 1024 pixels' means of independent signs, of which few hold most of the light: a tenth of a pixel's
                cr_assert(fabs(error.mean_ratio - 1) < 0.1 * error.nrmse + 1e-3,
                          "light %d, way %d: mean ratio %g", k, way, error.mean_ratio);
            }
        }
        image_free(&all);
        bounce_close(&b);
    }
}

// Dachsbacher and Stamminger's weight ξ1² for samples at radius·ξ1 converges, but to another picture.
Test(rsm_importance, the_printed_weight_is_biased)
{
    Bounce b = bounce_open(make, WALLS, FEW);
    Light light = light_of(LIGHT_SPOT, 0);
    Image all = bounce_light(&b, &light, 64, 0.5f, NULL);
    double error[2];
    for (int k = 0; k < 2; k++) {
        RsmPattern pattern = {
            .samples = 2048, .radius = 1, .rotated = true, .sampling = k ? RSM_AS_PRINTED : RSM_ABOUT_PIXEL};
        Image some = bounce_light(&b, &light, 64, 0.5f, &pattern);
        error[k] = image_compare(&some, &all).nrmse;
        image_free(&some);
    }
    cr_assert(error[0] < 0.04 && error[1] > 0.2, "nrmse %g, as printed %g", error[0], error[1]);
    image_free(&all);
    bounce_close(&b);
}

Test(rsm_importance, more_samples_than_one_draw_can_count)
{
    Bounce b = bounce_open(make, WALLS, 8);
    Light light = light_of(LIGHT_SPOT, 0);
    Image all = bounce_light(&b, &light, 64, 0.5f, NULL);
    RsmPattern pattern = {.samples = 100000, .radius = 1, .rotated = true};
    Image some = bounce_light(&b, &light, 64, 0.5f, &pattern);
    ImageError error = image_compare(&some, &all);
    cr_assert(error.nrmse < 5e-3, "nrmse %g", error.nrmse); // a third of the samples left out would be 0.3
    image_free(&all), image_free(&some);
    bounce_close(&b);
}
