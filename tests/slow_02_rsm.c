// Chapter 02, slow: gathered light at the extremes, and what a smaller radius leaves out.
#include "rsm_bounce.h"

// The same picture where all lengths are s times as long and the intensity s² times, and far away.
Test(slow_rsm, bounce_is_the_same_far_away_tiny_and_giant)
{
    const uint64_t seeds[] = {FAR_AWAY, TINY, GIANT};
    RsmPattern pattern = {.samples = 64, .radius = 1, .rotated = true};
    for (int kind = 0; kind < 3; kind++)
        for (int k = 0; k < 3; k++)
            for (int way = 0; way < 2; way++) {
                uint64_t walls = kind == LIGHT_DIRECTIONAL ? 0 : WALLS;
                Bounce here = bounce_open(make, walls, FEW), there = bounce_open(make, walls | seeds[k], FEW);
                Light near = light_of((LightKind)kind, 0), far = light_of((LightKind)kind, seeds[k]);
                Image expected = bounce_light(&here, &near, 32, 0.25f, way ? &pattern : NULL);
                Image got = bounce_light(&there, &far, 32, 0.25f * scale_of(seeds[k]), way ? &pattern : NULL);
                ImageError error = image_compare(&got, &expected);
                // The sun's frame is rounded at 1e-7 of 10⁶ m, so its texels lie elsewhere by 0.2 of one; else a few texels on edges.
                double tolerance = kind == LIGHT_DIRECTIONAL && seeds[k] == FAR_AWAY ? 0.1
                                   : way                                             ? 0.02
                                                                                     : 2e-3;
                cr_assert(error.nrmse < tolerance, "light %d, seed %d, way %d: nrmse %g", kind, (int)seeds[k],
                          way, error.nrmse);
                image_free(&expected), image_free(&got);
                bounce_close(&here), bounce_close(&there);
            }
}

// Finite everywhere, as bounce_light checks, with nothing held: texels on the very points that pixels see, lights at walls, one texel.
Test(slow_rsm, lights_at_and_on_walls_give_finite_pictures)
{
    Bounce b = bounce_open(make, WALLS, FEW);
    const vec3 places[] = {vec3_make(0, 1.5f, 0), vec3_make(0, 0.001f, 0), vec3_make(-4, 6, -5),
                           b.stage.scene->camera.eye};
    RsmPattern pattern = {.samples = 16, .radius = 1};
    for (size_t p = 0; p < sizeof places / sizeof *places; p++)
        for (int kind = 0; kind < 2; kind++)
            for (int side = 1; side <= 32; side *= 32)
                for (int way = 0; way < 2; way++) {
                    Light light = light_of((LightKind)kind, 0);
                    light.position = places[p];
                    light.radius = 0;
                    Image got = bounce_light(&b, &light, side, 0, way ? &pattern : NULL);
                    image_free(&got);
                }
    bounce_close(&b);
}

// A disc of the map round the pixel's place loses what lies outside it, and nothing is counted twice.
Test(slow_rsm, smaller_radius_loses_light)
{
    for (int kind = 0; kind < 3; kind++) {
        Bounce b = bounce_open(make, kind == LIGHT_DIRECTIONAL ? 0 : WALLS, FEW);
        Light light = light_of((LightKind)kind, 0);
        double before = 0;
        for (int k = 0; k < 4; k++) {
            RsmPattern pattern = {.samples = 256, .radius = 0.125f * (float)(1 << k), .rotated = true};
            Image some = bounce_light(&b, &light, 64, 0.5f, &pattern);
            cr_assert(mean_of(&some) > before * (k == 3 ? 0.98 : 1.02), "light %d, radius %g: %g after %g",
                      kind, (double)pattern.radius, mean_of(&some),
                      before); // a spot's texels are all within half of √2 sides for most pixels
            before = mean_of(&some);
            image_free(&some);
        }
        bounce_close(&b);
    }
}
