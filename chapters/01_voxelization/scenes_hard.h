// scenes_hard: the scenes that are hard because of their triangles: none left, too small, too many, on a line of the grid; and the
// same sphere in ever more triangles.
#ifndef SCENES_HARD_H
#define SCENES_HARD_H

#include "scene.h"

void scenes_make_point(Scene *scene, uint64_t seed);
void scenes_make_speck(Scene *scene, uint64_t seed);
void scenes_make_crowd(Scene *scene, uint64_t seed);
void scenes_make_edge(Scene *scene, uint64_t seed);
void scenes_make_beam(Scene *scene, uint64_t seed);

// About `triangles` of them, in rings from pole to pole; every corner lies on the sphere, so its volume is a little too small.
void scenes_add_sphere(Scene *scene, vec3 centre, float radius, double triangles);
void scenes_make_sphere_1e3(Scene *scene, uint64_t seed);
void scenes_make_sphere_1e4(Scene *scene, uint64_t seed);
void scenes_make_sphere_1e5(Scene *scene, uint64_t seed);
void scenes_make_sphere_1e6(Scene *scene, uint64_t seed);

#endif
