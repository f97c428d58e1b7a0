// rsm: the light that surfaces lit by a light pass on once, gathered from the texels of a reflective shadow map (Dachsbacher and Stamminger,
// "Reflective shadow maps", I3D 2005). Each texel p is a small Lambertian light of flux Φ_p (W) at x_p with normal n_p, so of radiant
// intensity Φ_p/π · cos θ. A G-buffer pixel of albedo ρ at x with normal n shows, at unit d from x to x_p and distance r,
//
//     L = ρ/π · Σ_p  Φ_p/π · max(0, −n_p·d) · max(0, n·d) / max(r, clamp)²        W/(sr·m²).
//
// Nothing blocks the way from x_p to x: that is the technique's own model. Two ways to the sum:
//
//   all         every texel of the map, in draws of as many texels as the renderer's loops can count
//   importance  N texels a pixel, drawn in polar coordinates about where the pixel itself lies in the map (section 4 of the paper)
#ifndef RSM_H
#define RSM_H

#include "raster.h"

// Shaders by LightKind of the map.
typedef struct Rsm {
    Shader *all[3], *importance[3];
} Rsm;
Rsm rsm_open(void);
void rsm_close(Rsm *rsm);

// What a gather reads, and where its light is added: an RGBA32F picture of the G-buffer's size.
typedef struct RsmGather {
    const GBuffer *gbuffer;
    const Camera *camera;
    const ReflectiveMap *map;
    float
        clamp; // metres: 1/r² is held inside, or a texel a micrometre away would outshine all others. 0: nothing is held
    GLuint picture;
    // Ours: each texel a disc of its own area A, whose light on a point that faces it is 1/(r² + A/π) exactly, instead of max(r, clamp)².
    // Nothing to choose, and nothing is lost at endless resolution.
    bool texel_discs;
} RsmGather;

// As printed: the paper's weight ξ1², normalized so that a constant is summed rightly. It is biased wherever near and far texels differ, since samples at
// r = radius·ξ1 lie with density 1/r, which the weight ξ1 makes good; unbiased is that.
typedef enum RsmWeight { RSM_WEIGHT_UNBIASED, RSM_WEIGHT_AS_PRINTED } RsmWeight;
typedef struct RsmPattern {
    int samples; // a pixel, at least 1
    float
        radius; // 0 < radius ≤ 1: 1 reaches every texel from anywhere in the map, less leaves out what lies farther. Spot, directional: of √2 sides
                // of the map; cube: of 180°
    bool rotated;     // a pattern of its own for each pixel: noise; else the same for all: bands
    RsmWeight weight; // cube: always unbiased
    uint32_t seed;
} RsmPattern;

// Both return how many texels each pixel asked for (of a cube: of all six faces).
double rsm_gather_all(const Rsm *rsm, const RsmGather *gather);
double rsm_gather_importance(const Rsm *rsm, const RsmGather *gather, const RsmPattern *pattern);

#endif
