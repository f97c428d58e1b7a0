// rays: airlight by one shadow ray a sample, at the very light rays φ that an epipolar grid has (Wyman 2011, section 5: "firing a shadow ray for the same 512 φ
// samples"): Embree in its fastest form, rtcOccluded16 on coherent packets and all cores. A baseline in speed; what judges pictures is another (common/truth.h).
#ifndef RAYS_H
#define RAYS_H

#include "epipolar.h"
#include "truth.h"

// Embree's tree over the mesh's triangles, built for speed of rays.
typedef struct Rays Rays;
Rays *rays_open(const Mesh *mesh);
void rays_close(Rays *rays); // NULL is allowed

// What to draw: one light's airlight, a pixel's ray up to its first surface. Samples lie at the middles of `phi` cells; a light at the eye has none.
typedef struct RaysView {
    const Scene *scene;
    const Light *light;
    const Camera *camera;
    EpipolarFrame frame;
    const TruthPhase *phase;
    int width, height;
    const float *distance; // metres a pixel, +Inf: sky; bottom row first
    const float *border; // of the cells: phi + 1 that rise; radians (directional light: metres from the axis)
    const float *middle; // phi of them
    int phi;
} RaysView;

// A grid's φ: range->phi + 1 borders of its cells, then range->phi middles, spread evenly or as the square; new memory.
float *rays_angles(const EpipolarRange *range, bool square);

typedef struct RaysCount {
    double rays, seconds;     // sent, on all cores together; on the wall's clock
    double processor_seconds; // of one core, the mean of all: what others on the machine do is not in it
} RaysCount;
// Add it to a picture of 4 floats a pixel, bottom row first, W/(sr·m²).
RaysCount rays_draw(const Rays *rays, const RaysView *view, float *picture);
// The bare loop: the same packets of every `stride`-th tile of pixels, made before the clock starts, and nothing done with what they find.
RaysCount rays_bare(const Rays *rays, const RaysView *view, int stride);

#endif
