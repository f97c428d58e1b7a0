// about: what the program offers: scenes, parameters, steps, the rows of its sweep and of its stability table.
#ifndef ABOUT_H
#define ABOUT_H

#include "run.h"

extern const RunAbout epipolar_about;
enum {
    CLEAR,
    VOXELS,
    SCANNED,
    COUNTS,
    LIT_SURFACES,
    AIRLIGHT,
    PICTURE,
    PICTURES
}; // pictures, in the order of the steps

#endif
