// sway: a scene that leans from side to side, as in wind: --path deform. What casts has then changed, and with it every map.
#ifndef SWAY_H
#define SWAY_H

#include "raster.h"

// The scene with positions, normals and box of its own. `rest` keeps the rest and has to outlive it.
Scene sway_begin(const Scene *rest);
void sway_end(Scene *scene);
// Each point moves along x by `lean` times its height above the box's floor, so the floor stays where it is. Into the mesh on the GPU too.
// Returns a hash of where everything is now: equal where nothing has moved.
uint64_t sway_lean(Scene *scene, const Scene *rest, float lean, const RasterMesh *mesh);
// The lean of a frame, 60 of them there and back: at most 0.05 m a metre of height.
float sway_of_frame(int frame);

#endif
