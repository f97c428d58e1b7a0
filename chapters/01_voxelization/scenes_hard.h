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

#endif
