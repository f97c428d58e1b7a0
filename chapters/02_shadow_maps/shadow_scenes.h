// shadow_scenes: what the stability table is about. Each has a closed form: which share of the pixels that ask for light is lit, or where a shadow ends.
#ifndef SHADOW_SCENES_H
#define SHADOW_SCENES_H

#include "scene.h"

extern const SceneKind shadow_scenes[];

// The share of asking pixels that are lit, by the scene's name; −1: only the truth knows.
double scenes_lit(const char *scene);

// Whether a point is lit, where the truth's rays cannot say: they leave out 2^-16 of their way at both ends, and so the caster of `decades`. −1: they
// can.
double scenes_lit_at(const char *scene, LightKind kind, vec3 point);

// W that all surfaces together reflect, in red: 4πIρ in a closed room about a point light; −1: the scene is none.
double scenes_reflected_flux(const Scene *scene);

#endif
