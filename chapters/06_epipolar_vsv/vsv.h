// vsv: a voxelized shadow volume (Wyman 2011): which voxels (α, θ, φ) of an epipolar grid lie in one light's shadow, a bit each.
//
// Layout: words of 32 φ, four of them a texel of 128 bits; the φ of a view ray (α, θ) lie side by side, then θ, then α: word w of (i, j) is number
// (i · theta + j) · words + w, bit k & 31 of word k >> 5 is φ k. Before the scan a set bit says that a surface begins to shade the light ray (θ, φ) at this α;
// after it that the voxel is in shadow. A voxel stands for the light ray through its middle, and for the α of its middle.
//
// In a frame: vsv_aim, vsv_clear, one voxelization, vsv_scan; then any shader that includes 06_epipolar_vsv/query.glsl, after vsv_bind.
#ifndef VSV_H
#define VSV_H

#include "airlight.h"
#include "epipolar.h"

typedef struct VsvSettings {
    int alpha, theta, phi; // voxels
    const char *scan;      // columns logstep
    const char *warp;      // of φ: even square borders
    const char *slices;    // of θ: uniform pixel
    const char *shape;     // of a point light's map: cube paraboloid
} VsvSettings;

enum { VSV_COLUMNS, VSV_UP, VSV_DOWN, VSV_SLICES, VSV_SCANS }; // shaders of the scan

typedef struct Vsv {
    VsvSettings settings;
    int words, columns; // words a row of φ; word columns, each of settings.alpha words
    int levels;         // of the mip chain: 1 unless scan is logstep
    size_t bytes;       // of all levels
    LightKind kind;     // of the light's map
    GLuint voxels, texels, single, first, slices, borders; // voxels as RGBA32UI: texels; as R32UI: single
    GLuint spread;                                         // of φ, by its borders
    GLuint halves;                                         // of the paraboloids
    Shader *to_halves, *resample, *scan[VSV_SCANS];
    EpipolarFrame frame;
    EpipolarRange range;
    bool whole; // no view ray goes on beyond the range's φ
} Vsv;
Vsv vsv_open(const VsvSettings *settings, const DepthMap *map);
void vsv_close(Vsv *vsv);

// What eye and light the volume is for, and what it covers; `width` × `height` pixels see it.
void vsv_aim(Vsv *vsv, const EpipolarFrame *frame, const EpipolarRange *range, const Camera *camera,
             int width, int height);
void vsv_clear(const Vsv *vsv); // no voxel is set
// No voxel that is seen lies in shadow: instead of the three passes that follow.
void vsv_light_all(const Vsv *vsv);
// Voxelization by one sample of the light's map a light ray (section 4.1.3).
void vsv_voxelize_map(const Vsv *vsv, const Light *light, const DepthMap *map);
// Shadow behind what is set (section 2.2.2).
void vsv_scan(const Vsv *vsv);

// Word columns that no occluder touches: the scan leaves them out.
int vsv_empty_columns(const Vsv *vsv);
// The grid laid flat into an RGBA32F picture, by 06_epipolar_vsv/show.comp.
void vsv_show(const Vsv *vsv, const Shader *flat, GLuint picture, int width, int height);

// One light in a scene that is seen: what all queries take.
typedef struct QueryView {
    const Scene *scene;
    const Light *light;
    const DepthMap *map;
    const Camera *camera;
    const GBuffer *gbuffer;
} QueryView;
// Whether φ tells the points of view rays apart, as sums and spans over it take for granted: not within the light's own radius of the eye.
bool vsv_apart(const Vsv *vsv, const Light *light);
// For a shader that voxelizes (includes voxels.glsl) or asks (query.glsl): the volume's buffers and uniforms.
void vsv_bind(const Vsv *vsv, const Shader *shader);
// Whether φ is spread by a table.
bool vsv_spreads(const VsvSettings *settings);
// Definitions that all of them are compiled with; the caller frees them.
char *vsv_definitions(const VsvSettings *settings);

#endif
