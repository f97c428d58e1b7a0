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

// Where in the map the samples lie, and what each counts for.
typedef enum RsmSampling {
    RSM_ABOUT_PIXEL, // at radius·ξ1 from the pixel's own place, so with density 1/r, which the weight 2 ξ1 undoes
    RSM_AS_PRINTED, // the same places with the paper's weight ξ1², normalized so that a constant is summed rightly: biased wherever near and
                    // far texels differ. Of a cube as RSM_ABOUT_PIXEL
    RSM_EVENLY,     // every texel as likely as any other: what the two above are to beat
} RsmSampling;
typedef struct RsmPattern {
    int samples; // a pixel, at least 1
    float
        radius; // 0 < radius ≤ 1: 1 reaches every texel from anywhere in the map, less leaves out what lies farther. Spot, directional: of √2 sides
                // of the map; cube: of 180°. RSM_EVENLY has none
    bool rotated; // a pattern of its own for each pixel: noise; else the same for all: bands
    RsmSampling sampling;
    uint32_t seed;
} RsmPattern;

// Both return how many texels each pixel asked for (of a cube: of all six faces).
double rsm_gather_all(const Rsm *rsm, const RsmGather *gather);
double rsm_gather_importance(const Rsm *rsm, const RsmGather *gather, const RsmPattern *pattern);

#endif
