// truth_internal: what truth's own files share. Positions are relative to Truth.base, where float32 is finest.
#ifndef TRUTH_INTERNAL_H
#define TRUTH_INTERNAL_H

#include "truth.h"

#include <embree3/rtcore.h>
#include <stdatomic.h>

struct Truth {
    RTCScene scene; // holds the device
    size_t triangle_count;
    const float *positions; // Embree's copies, relative to `base`
    const uint32_t *indices;
    vec3 base; // 0, or near a mesh that is far from the origin: every vertex − base is then exact in float32
};

#define NO_TRIANGLE UINT32_MAX

// The nearest triangle but `skipped` from `least` metres on.
typedef struct Meeting {
    float distance; // +Inf: none
    uint32_t triangle;
    float u, v; // of its second and third vertex
} Meeting;
Meeting truth_meet(const Truth *truth, vec3 origin, vec3 direction, float least, uint32_t skipped);
// truth_occluded with its margins, where `most` is the largest coordinate of either end as it was given; two triangles may be left out.
bool truth_between(const Truth *truth, vec3 from, vec3 to, float most, const uint32_t skipped[2]);
// Whether any triangle but `skipped` lies that way, at any distance.
bool truth_beyond(const Truth *truth, vec3 from, vec3 direction, uint32_t skipped);
vec3 truth_triangle_normal(const Truth *truth, uint32_t triangle, double *area); // unit, as it winds; m²
float truth_largest(vec3 a); // of the coordinates' absolute values

// Run `work` on so many threads (0: one a core) and wait for them. `work` takes pieces by atomic_fetch_add until none is left.
void truth_run(void *(*work)(void *), void *shared, int threads);

// truth_airlight where GSL's error handler, of which the program has one, is off already: whoever starts threads turns it off before the first of them.
void truth_airlight_quiet(const TruthShadows *shadows, const Scene *scene, const TruthPhase *phase,
                          const double origin[3], const double direction[3], double length,
                          double radiance[3]);

// --- light

// Triangles that emit, drawn by area and emission.
typedef struct Emitters {
    size_t count;
    uint32_t *triangles;
    double *cumulative; // sums of area · mean emission
    double total;
} Emitters;

typedef struct Tracer {
    const Truth *truth;
    const Scene *scene;
    TruthPathSettings settings;
    Emitters emitters;
} Tracer;

// Random numbers by their place: the hash (splitmix64's; Steele, Lea and Flood 2014) of a key and the number of the draw.
typedef struct Random {
    uint64_t key, draw;
} Random;
double random_next(Random *random); // [0, 1)

// A surface on the side from which it is seen.
typedef struct Surface {
    float distance;    // along the ray that saw it; +Inf: none, nothing else is set
    uint32_t triangle; // NO_TRIANGLE: a point that was given
    vec3
        at; // moved off the triangle and back along the ray by more than rounding may have put it beyond a surface
    vec3 side;   // the triangle's normal
    vec3 normal; // the interpolated one
    vec3 albedo, emission;
} Surface;
Surface tracer_see(const Tracer *tracer, vec3 origin, vec3 direction, float least, uint32_t skipped);
// The point moved off along the unit normal by 2^-21 of `most`.
vec3 tracer_lift(vec3 point, vec3 normal, float most);
// The unit direction at an angle to the unit axis.
vec3 tracer_turn(vec3 axis, double cosine, double sine, double around_rad);

Emitters tracer_emitters(const Truth *truth, const Scene *scene);
// Density by area, 1/m², with which tracer_direct draws a point of a triangle of this emission.
double emitters_density(const Emitters *emitters, vec3 emission);
// Irradiance of all point, spot and directional lights, and one sample of the emitters' that their settings ask for.
vec3 tracer_direct(const Tracer *tracer, const Surface *seen, Random *random);
// One sample of the irradiance that has bounced once, by rays from the lights.
vec3 tracer_flux(const Tracer *tracer, const Surface *seen, Random *random);

#endif
