// rays_internal: what the files of rays share.
#ifndef RAYS_INTERNAL_H
#define RAYS_INTERNAL_H

#include "rays.h"

#include <embree3/rtcore.h>

struct Rays {
    RTCScene scene; // holds the device
};

#endif
