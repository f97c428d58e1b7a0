// render: a scene's depth maps and G-buffer, a picture to draw into, and the airlight of a scene from nothing, for comparisons.
#ifndef RENDER_H
#define RENDER_H

#include "airlight.h"
#include "image.h"

// An RGBA32F picture that can be drawn into and cleared.
typedef struct Target {
    GLuint texture, framebuffer;
} Target;
Target target_open(const char *label, int width, int height);
void target_close(Target *target);
void target_clear(const Target *target); // 0
Image target_read(const Target *target, int width,
                  int height); // top row first, 4 channels; the caller frees it

// What every method starts from. Keeps raster and scene.
typedef struct Renderer {
    const Raster *raster;
    const Scene *scene;
    RasterMesh mesh;
    GBuffer gbuffer;
    DepthMap *maps; // one a light
} Renderer;
Renderer renderer_open(const Raster *raster, const Scene *scene, int width, int height, int map_resolution);
void renderer_close(Renderer *renderer);
void renderer_draw_maps(const Renderer *renderer);

// The in-scattered radiance of all the scene's lights.
Image render_airlight(const Raster *raster, const Scene *scene, const Camera *camera, int width, int height,
                      int map_resolution, const AirlightSettings *settings);

#endif
