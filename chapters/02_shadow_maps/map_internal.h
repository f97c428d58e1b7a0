// map_internal: what map.c and map_ask.c share.
#ifndef MAP_INTERNAL_H
#define MAP_INTERNAL_H

#include "map.h"
#include <stdlib.h>

// As in bounds.glsl.
typedef struct LayerBounds {
    uint32_t pixels, from_end_x, from_end_y, end_x, end_y, farthest;
} LayerBounds;

// Use the shader, with the uniforms that map.glsl and its users read.
void map_set(const Shader *shader, const ShadowMap *map, const Light *light);

#endif
