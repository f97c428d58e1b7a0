// judge: what visibilities and pictures are judged by: Embree's shadow rays from the surface points of the G-buffer, and the truth's light.
#ifndef JUDGE_H
#define JUDGE_H

#include "map.h"
#include "run.h"
#include "truth.h"

// What was asked and answered, and in which view.
typedef struct Asked {
    const Scene *scene; // with the lights that were shown, which may not be its own
    Camera camera;
    const GBuffer *gbuffer;
    const GLuint *visibility; // one a light
} Asked;

// One light's visibility, the technique's and the truth's, a float a pixel, bottom row first: −1 where the pixel asks nothing, 0 or 1 (truth).
typedef struct Visibility {
    int width, height;
    float *got, *truth;
} Visibility;
Visibility judge_visibility(const Asked *asked, const Truth *truth, size_t light);
void judge_visibility_free(Visibility *visibility);

// Of all lights together.
typedef struct Judgement {
    double asked; // pixels that ask, summed over the lights
    double wrong; // share of them on the wrong side of ½
    double dark,
        leaked; // of these shares: lit in truth and shown dark (acne); dark in truth and shown lit (leaks, peter-panning)
    double difference; // mean |got − truth|, which sees a filter's soft border too
    // Pixels from a wrong pixel to the nearest whose true visibility is the other: half a pixel away the border lies. 0 where none is wrong.
    double distance_mean, distance_p99, distance_most;
} Judgement;
Judgement judge(const Asked *asked, const Truth *truth);
Judgement judge_of(const Visibility *visibilities, size_t count);

// Green where both agree on light, black on shadow; red: dark, though lit; blue: lit, though dark. Uploaded to the picture.
void judge_show(const Visibility *visibility, GLuint picture);
// The truth as map_paint shows the technique's.
Image judge_paint(const Visibility *visibility);

// Error rows of a sweep; the order of convergence comes with the last resolution of a series of rows of one name and scene.
void judge_sweep(Run *run, const Judgement *judgement, const Image *picture, const Image *truth);

#endif
