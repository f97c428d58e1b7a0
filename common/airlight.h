// airlight: the light that a homogeneous medium scatters once towards the eye, by brute force along each ray; and surfaces seen through it. Every
// chapter on media starts from it and is compared with it; chapter 04 teaches it, its GLSL is shaders/common/airlight*.
#ifndef AIRLIGHT_H
#define AIRLIGHT_H

#include "image.h"
#include "raster.h"

// What is drawn how. Methods that sample take `steps` samples a ray; segments takes `nodes` a lit stretch: 8, 16, 24, or 0: as many as
// 1e-4 takes.
typedef struct AirlightSettings {
    const char *method;  // march jittered equiangular factored segments
    const char *variant; // segments: intervals, or signed as Billeter et al. sum them
    const char *phase;   // uniform rayleigh henyey_greenstein hoffman_preetham hoffman_preetham_normalized
    int steps, nodes;
    float rayleigh_share; // Hoffman and Preetham
    uint32_t seed;        // jittered
    bool shadowed;        // whether the depth maps are asked
    bool exact;           // not they, but Airlight.reach: to tell their error from the method's own
    bool grey;            // extinction is the same in all channels: one exponential does for three
    bool count;           // lookups and rays left out are counted: costs time
    // A chapter's own method: its compute shader, or (.frag) its fragment shader, which starts from common/airlight_ray.glsl, METHOD in it, and an R32F image that
    // it reads at binding 3. NULL: one of the methods above; 0: no image.
    const char *shader, *definitions; // more of them, or NULL
    int number;
    GLuint table;
} AirlightSettings;
// PHASE in shaders/common/phase.glsl; another name ends the program.
int airlight_phase(const char *name);

// Where one light reaches each ray of a picture, as `length(first)` - 1 lists in one: of ray x + width · y, y upwards, spans first[i] up to first[i + 1],
// (from, to) along the ray, in order. Buffers of uint32_t and of pairs of float.
typedef struct AirlightReach {
    GLuint first, spans;
} AirlightReach;

// One method's shaders, compiled for the kinds of light of one scene, and what they need.
typedef struct Airlight {
    AirlightSettings settings;
    Shader *shader[3]; // by DepthMap.kind; NULL: no such light
    GLuint no_table;   // one texel
    GLuint no_attributes;
    bool drawn; // by a fragment shader
    GLuint counters;
    AirlightReach reach; // settings.exact: of the light that is added next; not kept
} Airlight;
Airlight airlight_open(const AirlightSettings *settings, const DepthMap *maps, size_t map_count);
void airlight_close(Airlight *airlight);

// Add one light's airlight to an RGBA32F picture, W/(sr·m²). The G-buffer says where each ray ends.
void airlight_add(const Airlight *airlight, const GBuffer *gbuffer, const Camera *camera, const Scene *scene,
                  const Light *light, const DepthMap *map, GLuint picture);
// All that airlight_add sets before it draws: for a chapter's own passes over something else than pixels.
void airlight_bind(const Airlight *airlight, const GBuffer *gbuffer, const Camera *camera, const Scene *scene,
                   const Light *light, const DepthMap *map, GLuint picture);
// Since the last call: rays that cannot meet light, and lookups in depth maps; 0 unless settings.count.
void airlight_counts(const Airlight *airlight, uint32_t *missed_rays, uint32_t *lookups);

// The in-scattered radiance of all the scene's lights, drawn from nothing, for comparisons: top row first, 4 channels; the caller frees it.
Image airlight_picture(const Raster *raster, const Scene *scene, const Camera *camera, int width, int height,
                       int map_resolution, const AirlightSettings *settings);
// The same, kept while nothing that it depends on changes: rows of a sweep are compared with one picture. `scene_hash` stands for the scene. Begins as {0};
// its image is the caller's to free.
typedef struct AirlightKept {
    uint64_t inputs;
    Image image;
} AirlightKept;
const Image *airlight_picture_kept(AirlightKept *kept, uint64_t scene_hash, const Raster *raster,
                                   const Scene *scene, const Camera *camera, int width, int height,
                                   int map_resolution, const AirlightSettings *settings);

// Surfaces through the medium, and the sum of both.
typedef struct AirlightHaze {
    Shader *attenuate, *add;
} AirlightHaze;
AirlightHaze airlight_haze_open(void);
void airlight_haze_close(AirlightHaze *haze);
// Add `surfaces`, lit by `light` alone (NULL: by no light but their own and the ambient), dimmed on the way from light and to the eye.
void airlight_haze_attenuate(const AirlightHaze *haze, const GBuffer *gbuffer, const Camera *camera,
                             const Scene *scene, const Light *light, GLuint surfaces, GLuint picture);
// picture = surface_share · surfaces + airlight.
void airlight_sum(const AirlightHaze *haze, const GBuffer *gbuffer, float surface_share, GLuint surfaces,
                  GLuint airlight, GLuint picture);

#endif
