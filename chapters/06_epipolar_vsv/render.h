// render: the airlight of a scene by voxelized shadow volumes from nothing, for comparisons.
#ifndef RENDER_H
#define RENDER_H

#include "query.h"

typedef struct RenderSettings {
    AirlightSettings airlight;
    VsvSettings volume;
    QuerySettings asked;
    bool full; // all angles, not only those that the picture shows
    int map;   // texels a side
} RenderSettings;

// One light's volume: aimed, its range found, voxelized from its map and scanned. `scratch`: a picture of the view's size, not changed.
void render_volume(Vsv *vsv, const Query *query, const QueryView *view, bool full, GLuint scratch);

// The in-scattered radiance of all lights: top row first, 4 channels; the caller frees it.
Image render_picture(const Raster *raster, const Scene *scene, const Camera *camera, int width, int height,
                     const RenderSettings *settings);

#endif
