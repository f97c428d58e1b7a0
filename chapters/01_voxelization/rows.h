// rows: what --sweep measures and --stability checks. Expected voxel counts stand in scenes.c, tolerances in judge.c.
#ifndef ROWS_H
#define ROWS_H

#include "run.h"

// Each ends with a row whose name is NULL.
extern const RunRow voxel_sweep[], voxel_stability[];

#endif
