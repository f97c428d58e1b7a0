// raster_internal: what raster's own files share.
#ifndef RASTER_INTERNAL_H
#define RASTER_INTERNAL_H

#include "raster.h"

struct Raster {
    GLuint empty_vertex_array; // a core context draws nothing without one
    Shader *gbuffer, *light_begin;
    Shader *depth_map[3], *reflective_map[3], *light[3]; // by LightKind of the map
};

// Shader storage of a mesh's materials, as gbuffer.frag and reflective_map.frag read them.
void raster_bind_materials(const RasterMesh *mesh);
// Draw to every attachment of `framebuffer`, all of the state as the header says.
void raster_target(GLuint framebuffer, int width, int height);
// Half the picture's width and height at 1 m, and the unit way that the camera looks.
void raster_view(const Camera *camera, float aspect, vec3 *right, vec3 *up, vec3 *forward);

#endif
