// technique: one setting's volumes, a light each, and what asks them; or brute force on the lights' maps in their place.
#ifndef TECHNIQUE_H
#define TECHNIQUE_H

#include "baseline.h"
#include "bounds.h"
#include "run.h"
#include "triangles_vsv.h"

typedef struct Technique {
    bool brute;     // on the map: no volume at all
    bool by_rays;   // shadow rays at the volume's angles: no voxels
    bool geometric; // voxels come from triangles, else from the light's map
    bool solid;     // and hold what is inside
    bool seen;      // the grids cover what the picture shows
    VsvSettings size;
    QuerySettings asked;
    AirlightSettings airlight;
    Airlight march; // brute force, but for a textured light
    Query query;
    Triangles triangles;
    Rays *rays;
    int samples;    // of theirs a view ray; 0: as many as the volume has φ
    bool bounded;   // brute force between bounds of shadow alone
    Bounds *bounds; // one a light
    Vsv *vsv;       // one a light
    bool *at_eye;   // a light so near the eye that both see the same
} Technique;
// Wrong combinations of settings end the program.
Technique technique_open(const Run *run, const RasterView *view);
void technique_close(Technique *technique, size_t lights);

// What a frame needs of one light's volume.
typedef struct TechniqueNeeds {
    bool changed;        // eye, light, scene or medium
    bool casts;          // some shadow can be seen
    const char *why_not; // if one is false
} TechniqueNeeds;
// Passes of `run`: what the light's volume covers, its voxels; then their shadow. `picture` gives its size.
void technique_voxels(Technique *technique, Run *run, const RasterView *view, const Camera *camera,
                      size_t light, const TechniqueNeeds *needs, GLuint picture);
void technique_scan(const Technique *technique, Run *run, const RasterView *view, const Camera *camera,
                    size_t light, const TechniqueNeeds *needs);
// The scene has moved: what stands on its triangles is built anew.
void technique_moved(Technique *technique, const Scene *scene);
// All lights' airlight into a picture that has been cleared.
void technique_airlight(const Technique *technique, Run *run, const RasterView *view, const Camera *camera,
                        GLuint picture);
QueryView technique_view(const RasterView *view, const Camera *camera, size_t light);

#endif
