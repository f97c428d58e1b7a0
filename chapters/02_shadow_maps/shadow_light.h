// shadow_light: the lights that the chapter shows: a scene's own, or one that is made for the scene, of the kind that a step is about.
#ifndef SHADOW_LIGHT_H
#define SHADOW_LIGHT_H

#include "scene.h"

typedef enum LightChoice { CHOICE_OWN, CHOICE_SPOT, CHOICE_DIRECTIONAL, CHOICE_POINT } LightChoice;

// The scene's own lights, or one of the kind asked for that stands where light `index` of the scene does (a sun: before the scene, a point
// light made from a sun: in its middle), and gives the middle of the scene as much. Returns new memory; *count may be 0 (own alone).
Light *light_choose(const Scene *scene, LightChoice choice, int index, size_t *count);

#endif
