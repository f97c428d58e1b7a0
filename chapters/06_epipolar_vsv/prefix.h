// prefix: airlight summed up along the grid's own view rays, so that a pixel asks two numbers a view ray: the sum up to the word in which its ray ends, and that
// word's bits. Between view rays the sums are smooth, so they may be interpolated (Engelhardt and Dachsbacher 2010 interpolate airlight along epipolar lines): they
// belong to places in the air and know nothing of surfaces, so no edge of a surface is interpolated across.
#ifndef PREFIX_H
#define PREFIX_H

#include "vsv.h"

typedef struct PrefixSums { // of one light's volume
    GLuint weights, weight_texels, sums, sum_texels;
    GLuint beyond, beyond_texels; // of what is lit behind the grid
} PrefixSums;
typedef struct Prefix {
    Airlight ask
        [2]; // the pixels' shader: 0 where every ray ends in the grid and passes outside the light's radius; 1: any
    Shader *weigh[3], *sum[3], *beyond[3]; // by DepthMap.kind
    PrefixSums *of;                        // one a light: all are summed up before the first is asked
    size_t lights;
    int alpha, theta, phi; // voxels
    float rayleigh_share;
} Prefix;
// interpolated: between the four nearest of the grid's view rays; else the nearest alone.
Prefix prefix_open(const AirlightSettings *settings, const VsvSettings *volume, const DepthMap *maps,
                   size_t map_count, bool interpolated);
void prefix_close(Prefix *prefix);

// From a scanned volume: weights, then sums.
void prefix_weigh(const Prefix *prefix, const Vsv *vsv, const QueryView *view);
void prefix_sum(const Prefix *prefix, const Vsv *vsv, const QueryView *view);
// What draws a light's airlight then, and what it reads.
const Airlight *prefix_shader(const Prefix *prefix, const Vsv *vsv, const Light *light);
void prefix_bind(const Prefix *prefix, const Vsv *vsv, const QueryView *view);

#endif
