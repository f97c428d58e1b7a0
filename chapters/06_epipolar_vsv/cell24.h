// cell24: the edges of the 24-cell, a regular body of four dimensions, turning there and seen in three: a scene that changes its shape in every frame.
#ifndef CELL24_H
#define CELL24_H

#include "raster.h"

// The scene `cell24` as it stands in frame 0.
void cell24_make(Scene *scene, uint64_t seed);

// A copy of that scene with positions and normals of its own; `rest` keeps everything else and has to outlive it.
Scene cell24_begin(const Scene *rest);
void cell24_end(Scene *scene);
// Turn it as it stands in this frame, on the GPU too. Returns a hash of where everything is now: equal where nothing has moved.
uint64_t cell24_turn(Scene *scene, int frame, const RasterMesh *mesh);

#endif
