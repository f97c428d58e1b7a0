// map: a light's depth map in each of its shapes, drawn only where the picture will ask it; its moments; the questions that pixels ask it.
//
//   spot, directional   one square (raster_depth_map: perspective; orthographic, fitted to the scene or to what a camera sees)
//   cube                six squares of 90° each, in one draw
//   paraboloid          two squares of a half space each (Brabec, Annen and Seidel 2002), in one draw; straight edges become arcs
//
// `resolution` says how many texels a map has in all: resolution². A cube's sides have resolution/√6 texels, a paraboloid's resolution/√2,
// so that shapes are compared at equal memory.
#ifndef MAP_H
#define MAP_H

#include "raster.h"

typedef enum MapShape { MAP_CUBE, MAP_SPOT, MAP_DIRECTIONAL, MAP_PARABOLOID, MAP_SHAPES } MapShape;
typedef enum MapBias { BIAS_NONE, BIAS_CONSTANT, BIAS_SLOPE, BIAS_NORMAL } MapBias;
typedef enum MapFilter { FILTER_NEAREST, FILTER_PCF, FILTER_VARIANCE } MapFilter;

// How a pixel asks.
typedef struct MapLookup {
    MapBias bias;
    float bias_size; // metres (constant), texels (slope, normal)
    MapFilter filter;
    float radius;           // texels: half the side of the filter's box; at least ½
    float minimum_variance; // m²
    float bleeding;         // 0 ≤ bleeding < 1: the part of Chebyshev's bound that counts as no light
} MapLookup;

typedef struct MapShaders {
    Shader *receivers[MAP_SHAPES], *casters[MAP_SHAPES], *depth[MAP_SHAPES], *moments_x[MAP_SHAPES],
        *moments_y[MAP_SHAPES], *visibility[MAP_SHAPES], *light[MAP_SHAPES], *show[MAP_SHAPES];
    Shader *depth_cut, *paint, *show_flux[2]; // [1]: a cube's
} MapShaders;
MapShaders map_shaders_open(void);
// Those of one shape, unless they are there already: compiling all of them takes longer than a picture.
void map_shaders_add(MapShaders *shaders, MapShape shape);
void map_shaders_close(MapShaders *shaders);

// The map of one light, with what the GPU needs to know about it. `depth.kind` is LIGHT_POINT for both shapes with layers.
typedef struct ShadowMap {
    MapShape shape;
    int layers;
    DepthMap depth;        // a paraboloid's texel_size is that of a unit of its place: 2 / resolution radians
    GLuint moments[2];     // RG32F, `layers` layers: along x alone, whole; 0 where no filter asks for them
    float depth_range[2];  // metres: nearest and farthest point of the scene's box from the light
    GLuint bounds;         // what of each layer is asked (bounds.glsl)
    GLuint casters, count; // which triangles are drawn into which layer
    uint32_t triangle_count;
} ShadowMap;
// Fitted to what the camera sees where `fit_to` is given (directional). A wide spot gets a cube.
ShadowMap map_create(const Scene *scene, const Light *light, bool paraboloid, bool moments, int resolution,
                     const Camera *fit_to, float aspect);
void map_delete(ShadowMap *map);
// After light or camera have moved; keeps the GPU's memory.
void map_aim(ShadowMap *map, const Scene *scene, const Light *light, const Camera *fit_to, float aspect);

// Which part of the map the picture will ask. `pixels` is the number of pixels that ask at all; 0: no map is needed.
typedef struct MapAsked {
    uint32_t pixels;
    int layers;    // that are asked
    uint64_t hash; // of the layers' bounds: equal where the same map will do
} MapAsked;
MapAsked map_find_receivers(const MapShaders *shaders, const ShadowMap *map, const Light *light,
                            const GBuffer *gbuffer, const Camera *camera, const MapLookup *lookup);
// The triangles that may cast into it, of layers · triangle_count; on a paraboloid those whose edges must be cut, so that none leaves its arc
// by more than `tessellation` texels (0: none is cut), apart from the others.
typedef struct MapCasters {
    uint32_t whole, cut;
    float tessellation;
} MapCasters;
MapCasters map_find_casters(const MapShaders *shaders, const ShadowMap *map, const Light *light,
                            const RasterMesh *mesh, const MapLookup *lookup, float tessellation);
void map_draw(const MapShaders *shaders, const ShadowMap *map, const Light *light, const RasterMesh *mesh,
              const MapCasters *casters);
void map_filter_moments(const MapShaders *shaders, const ShadowMap *map, const Light *light,
                        const MapLookup *lookup);

// R32F, the G-buffer's size: 0 to 1, -1 where a pixel asks nothing.
void map_visibility(const MapShaders *shaders, const ShadowMap *map, const Light *light,
                    const GBuffer *gbuffer, const Camera *camera, const MapLookup *lookup, GLuint visibility);
// Adds the light to the picture.
void map_light(const MapShaders *shaders, const ShadowMap *map, const Light *light, const GBuffer *gbuffer,
               const Camera *camera, GLuint visibility, GLuint picture);

// Pictures of a map, near white and far black, and of a visibility.
void map_show(const MapShaders *shaders, const ShadowMap *map, GLuint picture, int width, int height);
void map_show_flux(const MapShaders *shaders, const ReflectiveMap *map, GLuint picture, int width,
                   int height);
void map_paint(const MapShaders *shaders, GLuint visibility, GLuint picture, int width, int height);

#endif
