// solid_scenes: balls for the inside of a mesh, sound and unsound ones. Each fits a box of 16 m, and its volume has a closed form.
#ifndef SOLID_SCENES_H
#define SOLID_SCENES_H

#include "scene.h"

void make_ball(Scene *scene, uint64_t seed);            // of 7.5 m
void make_ball_inside_out(Scene *scene, uint64_t seed); // its triangles wound the other way
void make_ball_twice(Scene *scene, uint64_t seed);      // each triangle twice
void make_ball_holes(Scene *scene, uint64_t seed);      // one triangle of 96 is missing
void make_balls(Scene *scene, uint64_t seed);           // two of 5 m that overlap, their middles 6 m apart

// m³ that are inside by the rule of solid.h, of the balls themselves and not of their facets; 0 for another scene.
double solid_scene_volume(const char *scene);

#endif
