// airlight: the light that a homogeneous medium scatters once towards the eye, by any of the chapter's methods; and surfaces seen through it.
#ifndef AIRLIGHT_H
#define AIRLIGHT_H

#include "raster.h"

// What is drawn how. Methods that sample take `steps` samples a ray; gauss and segments take `nodes` a stretch: 8, 16, 24, or 0,
// as many as they need.
typedef struct AirlightSettings {
    const char *method;  // march jittered equiangular factored sun pegoraro gauss segments
    const char *variant; // segments: intervals, or signed as Billeter et al. sum them
    const char *phase;   // uniform rayleigh henyey_greenstein hoffman_preetham hoffman_preetham_normalized
    int steps, nodes, table; // table: texels a side of sun's F
    float rayleigh_share;    // Hoffman and Preetham
    uint32_t seed;           // jittered
    bool shadowed;           // whether the depth maps are asked
    bool grey;               // extinction is the same in all channels: one exponential does for three
    bool count;              // lookups and rays left out are counted: costs time
} AirlightSettings;

// One method's shaders, compiled for the kinds of light of one scene, and what they need.
typedef struct Airlight {
    AirlightSettings settings;
    Shader *shader[3]; // by DepthMap.kind; NULL: no such light
    GLuint table;      // sun's F; else one texel
    GLuint counters;
} Airlight;
Airlight airlight_open(const AirlightSettings *settings, const DepthMap *maps, size_t map_count);
void airlight_close(Airlight *airlight);
bool airlight_uses_map(const AirlightSettings *settings); // the closed forms know no shadow

// Add one light's airlight to an RGBA32F picture, W/(sr·m²). The G-buffer says where each ray ends.
void airlight_add(const Airlight *airlight, const GBuffer *gbuffer, const Camera *camera, const Scene *scene,
                  const Light *light, const DepthMap *map, GLuint picture);
// Since the last call: rays that cannot meet light, and lookups in depth maps; 0 unless settings.count.
void airlight_counts(const Airlight *airlight, uint32_t *missed_rays, uint32_t *lookups);

// Surfaces through the medium, and the sum of both.
typedef struct Haze {
    Shader *attenuate, *add;
} Haze;
Haze haze_open(void);
void haze_close(Haze *haze);
// Add `surfaces`, lit by `light` alone (NULL: by no light but their own and the ambient), dimmed on the way from light and to the eye.
void haze_attenuate(const Haze *haze, const GBuffer *gbuffer, const Camera *camera, const Scene *scene,
                    const Light *light, GLuint surfaces, GLuint picture);
// picture = surface_share · surfaces + airlight.
void haze_add(const Haze *haze, const GBuffer *gbuffer, float surface_share, GLuint surfaces, GLuint airlight,
              GLuint picture);

// Whether anything can cast a shadow into what the camera sees: false where the shadow of the scene's box is certain to miss the view.
bool airlight_can_shadow(const Scene *scene, const Light *light, const Camera *camera, float aspect);

// Sun et al.'s F(u, v) by GSL: size² values, u fastest, u in [0, SUN_MOST_U], v in [0, π/2]; new memory.
#define SUN_MOST_U 10.0 // as in shaders/04_airlight/sun.glsl
float *sun_table(int size);
double sun_f(double u, double v);

#endif
