// sparse: airlight of the grid's own view rays alone, as many as alpha × theta; pixels are interpolated between those whose rays end alike (Engelhardt and
// Dachsbacher 2010, who place samples along lines through the light's image). Pixels between none that do ask the volume themselves.
#ifndef SPARSE_H
#define SPARSE_H

#include "vsv.h"

typedef struct Sparse {
    Airlight rows, pixels, left; // pixels: counts for all three
    GLuint row_picture;          // RGBA32F, a texel a view ray
    int alpha, theta;
} Sparse;
Sparse sparse_open(const AirlightSettings *settings, const VsvSettings *volume, const DepthMap *maps,
                   size_t map_count);
void sparse_close(Sparse *sparse);

// Add the light's airlight, from a scanned volume.
void sparse_airlight(const Sparse *sparse, const Vsv *vsv, const QueryView *view, GLuint picture);

#endif
