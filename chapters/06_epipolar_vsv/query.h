// query: what pixels ask of voxelized shadow volumes: airlight, counts, and before that which φ they will ask for.
#ifndef QUERY_H
#define QUERY_H

#include "vsv.h"

// Shaders that start from common/airlight_ray.glsl and 06_epipolar_vsv/query.glsl, for all of a scene's lights.
typedef struct Query {
    Airlight airlight, range, counts;
    GLuint phi; // least and most
} Query;
// `settings` as for common/airlight.h; integral: runs riemann factored.
Query query_open(const AirlightSettings *settings, const VsvSettings *volume, const char *integral,
                 const DepthMap *maps, size_t map_count);
void query_close(Query *query);

// One light in a scene that is seen: what all queries take.
typedef struct QueryView {
    const Scene *scene;
    const Light *light;
    const DepthMap *map;
    const Camera *camera;
    const GBuffer *gbuffer;
} QueryView;
// Cut vsv->range's φ down to what the view's rays reach; vsv has been aimed. `picture` gives the size alone.
void query_range(const Query *query, Vsv *vsv, const QueryView *view, GLuint picture);
// Add the light's airlight, W/(sr·m²); or the share of each ray's voxels that are set.
void query_airlight(const Query *query, const Vsv *vsv, const QueryView *view, GLuint picture);
void query_counts(const Query *query, const Vsv *vsv, const QueryView *view, GLuint picture);

#endif
