// bounds: where along each view ray shadow may begin and end: the nearest and the farthest face of the occluders' shadow volumes (Wyman and Ramsey 2008, simply
// built). Between them a ray is marched against the light's map, outside them it is lit: what figure 14 of Wyman 2011 compares with.
#ifndef BOUNDS_H
#define BOUNDS_H

#include "raster.h"

// A light's shadow volumes as triangles: a quad from each edge at which the mesh turns away from the light (or ends) to beyond what can be seen, and the mesh's
// triangles at both ends of them.
typedef struct Bounds {
    Shader *shader;
    GLuint vertices, vertex_array;
    GLsizei vertex_count;
    GLuint texture,
        framebuffer; // RG32F: metres to the nearest face, minus metres to the farthest; +Inf both where there is none
    size_t edges; // from which quads go
} Bounds;
Bounds bounds_open(const Scene *scene, const Light *light, int width, int height);
void bounds_close(Bounds *bounds);
// For this camera; then bound as image 5, for 06_epipolar_vsv/bounds.comp.
void bounds_draw(const Bounds *bounds, const Camera *camera, int width, int height);

#endif
