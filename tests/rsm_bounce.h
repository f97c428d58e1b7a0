// What the tests of chapter 02's bounced light share: a room of raster_room.h, lit once by one light's reflective shadow map.
#ifndef RSM_BOUNCE_H
#define RSM_BOUNCE_H

#include "../chapters/02_shadow_maps/rsm.h"
#include "image.h"
#include "raster_room.h"

enum { FEW = 32 }; // pixels a side where no closed form needs more

typedef struct Bounce {
    Stage stage;
    Rsm rsm;
    GBuffer gbuffer;
    GLuint picture;
    int side;
} Bounce;
static inline Bounce bounce_open(void (*maker)(Scene *, uint64_t), uint64_t seed, int side)
{
    Bounce b = {.stage = stage_open(maker, seed), .side = side};
    b.rsm = rsm_open();
    b.gbuffer = raster_gbuffer(side, side);
    b.picture = gl_texture(.label = "bounce", .format = GL_RGBA32F, .width = side, .height = side);
    return b;
}
static inline void bounce_close(Bounce *b)
{
    rsm_close(&b->rsm);
    raster_gbuffer_delete(&b->gbuffer);
    gl_texture_delete(&b->picture);
    stage_close(&b->stage);
}
// The bounced light as a picture, bottom row first; by every texel where `pattern` is NULL; texels are discs where `clamp` is below 0.
static inline Image bounce_light(const Bounce *b, const Light *light, int resolution, float clamp,
                                 const RsmPattern *pattern)
{
    const Camera *camera = &b->stage.scene->camera;
    ReflectiveMap map = raster_reflective_map(b->stage.scene, light, resolution);
    raster_reflective_map_draw(b->stage.raster, &map, light, &b->stage.mesh);
    raster_gbuffer_draw(b->stage.raster, &b->gbuffer, camera, &b->stage.mesh);
    static const float black[4] = {0};
    gl.ClearTexImage(b->picture, 0, GL_RGBA, GL_FLOAT, black);
    RsmGather gather = {&b->gbuffer, camera, &map, clamp, b->picture, clamp < 0};
    double asked =
        pattern ? rsm_gather_importance(&b->rsm, &gather, pattern) : rsm_gather_all(&b->rsm, &gather);
    int layers = map.depth.kind == LIGHT_POINT ? 6 : 1;
    cr_assert(asked == (pattern ? pattern->samples : (double)layers * resolution * resolution), "%g texels",
              asked);
    Image image = image_make(b->side, b->side, 4);
    gl_texture_read(b->picture, 0, GL_RGBA, GL_FLOAT, 4 * sizeof(float) * (size_t)(b->side * b->side),
                    image.pixels);
    for (int i = 0; i < 4 * b->side * b->side; i++)
        cr_assert(isfinite(image.pixels[i]) && image.pixels[i] >= 0, "value %d is %g", i, image.pixels[i]);
    raster_reflective_map_delete(&map);
    return image;
}
static inline double mean_of(const Image *image)
{
    double sum = 0;
    for (int i = 0; i < image->width * image->height; i++)
        sum += image->pixels[4 * i];
    return sum / image->width / image->height;
}

#endif
