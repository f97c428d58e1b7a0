// scenes_hard: the scenes that are hard because of their triangles: none left, too small, too many, on a line of the
// grid.
#ifndef SCENES_HARD_H
#define SCENES_HARD_H

#include "scene.h"

void scenes_make_point(Scene *scene, uint64_t seed);
void scenes_make_speck(Scene *scene, uint64_t seed);
void scenes_make_crowd(Scene *scene, uint64_t seed);
void scenes_make_edge(Scene *scene, uint64_t seed);
void scenes_make_beam(Scene *scene, uint64_t seed);
// 8 · 11², 35², 112² and 354² triangles
void scenes_make_sphere_1000(Scene *scene, uint64_t seed);
void scenes_make_sphere_10000(Scene *scene, uint64_t seed);
void scenes_make_sphere_100000(Scene *scene, uint64_t seed);
void scenes_make_sphere_1000000(Scene *scene, uint64_t seed);

#endif
