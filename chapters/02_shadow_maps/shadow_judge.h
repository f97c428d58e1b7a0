// shadow_judge: what visibilities and pictures are judged by: Embree's shadow rays from the surface points of the G-buffer, and the truth's light.
#ifndef SHADOW_JUDGE_H
#define SHADOW_JUDGE_H

#include "map.h"
#include "run.h"
#include "truth.h"

// The scene where float32 is fine: far from the origin (more than 64 of its diagonals) its triangles and lights about the origin, in new memory, and
// the way there; near it nothing moves. So the truth's rays are not rounded more than the technique, which never forms a world coordinate.
Scene judge_scene(const Scene *scene, vec3 *offset);
void judge_scene_free(Scene *scene);

// What was asked and answered, and in which view; scene and camera as judge_scene has moved them.
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
    // Where the triangle faces away though the interpolated normal does not: dark in truth, as it hides itself, but no map's resolution can tell, for it
    // stores a surface that the light reaches. Not judged as visibility, but counted. NULL: nowhere.
    bool *turned_away;
} Visibility;
Visibility judge_visibility(const Asked *asked, const Truth *truth, size_t light);
void judge_visibility_free(Visibility *visibility);

// Of all lights together.
typedef struct Judgement {
    double asked; // pixels that ask and do not lie on a triangle that faces away, summed over the lights
    double turned_away; // pixels on those, as a share of all that ask
    double wrong;       // share of `asked` on the wrong side of ½
    double dark,
        leaked; // of these shares: lit in truth and shown dark (acne); dark in truth and shown lit (leaks, peter-panning)
    double difference; // mean |got − truth|, which sees a filter's soft border too
    // Pixels from a wrong pixel to the nearest whose true visibility is the other: half a pixel away the border lies. 0 where none is wrong.
    double distance_mean, distance_p99, distance_most;
} Judgement;
Judgement judge_all(const Asked *asked, const Truth *truth);
Judgement judge_of(const Visibility *visibilities, size_t count);

// Grey where technique and truth agree, light or dark; red: dark, though lit; blue: lit, though dark; cyan: the same on a triangle that
// faces away, which is not judged. Into the picture.
void judge_show(const Asked *asked, const Truth *truth, size_t light, GLuint picture);
// The truth as map_paint shows the technique's visibility.
Image judge_paint(const Asked *asked, const Truth *truth, size_t light);
// Brute force: the true visibility in place of the map's.
void judge_rays(const Asked *asked, const Truth *truth, size_t light);

// The truth's light through the middle of each pixel, cached under out/truth: direct light; the one bounce alone, in the reflective map's own
// model (nothing blocks its way) or as it is; both.
typedef enum JudgeLight { DIRECT_LIGHT, BOUNCE_UNOCCLUDED, BOUNCE_ALONE, LIGHT_AND_BOUNCE } JudgeLight;
// `least_distance` (metres; BOUNCE_UNOCCLUDED alone): the inverse square is held inside it, as falloff=clamp does; 0: nowhere.
Image judge_light(const Asked *asked, const Truth *truth, JudgeLight what, float least_distance);

// Error rows of a sweep; `order` is the slope of log(wrong) over log(a side in texels) over the rows of one name and scene so far: −1 where the
// wrong share is the border's length times a texel. Where `all_texels` is given, the
// picture is a bounce alone, and that is the bounce which its texels make all together.
typedef struct Series Series;
Series *judge_series_new(void); // free() it
void judge_sweep(Run *run, Series *series, const Asked *asked, const Truth *truth, GLuint picture,
                 GLuint all_texels);
// The checks of a stability case; those of a bounce where `reflective` (one light's) is given.
void judge_stability(Run *run, const Asked *asked, const Truth *truth, GLuint picture,
                     const ReflectiveMap *reflective);

#endif
