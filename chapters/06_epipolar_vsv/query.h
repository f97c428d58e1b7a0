// query: what pixels ask of voxelized shadow volumes: airlight, counts, and before that which φ they will ask for.
#ifndef QUERY_H
#define QUERY_H

#include "prefix.h"
#include "sparse.h"

// Shaders that start from common/airlight_ray.glsl and 06_epipolar_vsv/query.glsl, for all of a scene's lights.
typedef struct Query {
    Airlight airlight, range, borders, counts, surface, beyond;
    Prefix prefix;
    Sparse sparse;
    bool textured, prefixed, sparse_rows;
    GLuint phi;    // least and most; the nearest surface
    GLuint weight; // of borders
} Query;
typedef struct QuerySettings {
    const char *integral; // runs riemann factored prefix sparse; march: the map, `steps` times
    int slice;            // factored: voxels that share one evaluation of what is smooth
    bool filtered;        // four rows a pixel instead of the nearest
    bool textured;        // the light shines through a window
    bool rays;            // the scene itself will be asked: query_beyond
} QuerySettings;
// `airlight`: as for common/airlight.h, whose method does not matter.
Query query_open(const QuerySettings *settings, const AirlightSettings *airlight, const VsvSettings *volume,
                 const DepthMap *maps, size_t map_count);
void query_close(Query *query);

// What the view's rays reach: with `cut`, or for a directional light, vsv->range's φ is cut down to it; vsv has been aimed. `picture` gives the size alone. False:
// the light is so near the eye that it sees what the eye sees: between both, shadows are thinner than a pixel.
bool query_range(const Query *query, Vsv *vsv, const QueryView *view, bool cut, GLuint picture);
// With warp=borders, once the range is known and before there are voxels: spreads φ by where the view's shadows have borders.
void query_spread(const Query *query, const Vsv *vsv, const QueryView *view, GLuint picture);
// Once the volume is scanned, and before its airlight: what integral=prefix sums up. False: nothing is to be summed.
bool query_prepares(const Query *query, const Vsv *vsv, const Light *light);
void query_prepare(const Query *query, const Vsv *vsv, const QueryView *view);
// What draws its airlight, and counts (airlight_counts).
const Airlight *query_shader(const Query *query, const Vsv *vsv, const Light *light);
// Add the light's airlight, W/(sr·m²); or the share of each ray's voxels that are set.
void query_airlight(const Query *query, const Vsv *vsv, const QueryView *view, GLuint picture);
void query_counts(const Query *query, const Vsv *vsv, const QueryView *view, GLuint picture);
// Add what of the light's airlight lies beyond the φ that the grid covers, where nothing can cast shadow; only where the settings said `rays`.
void query_beyond(const Query *query, const Vsv *vsv, const QueryView *view, GLuint picture);
// Add what the light gives to surfaces that lie in lit voxels.
void query_surface(const Query *query, const Vsv *vsv, const QueryView *view, GLuint picture);

#endif
