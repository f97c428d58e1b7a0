// methods: the surface methods by name, for the parameter `method`. `exact` is not among them: the chapter does it pass by pass.
#ifndef METHODS_H
#define METHODS_H

#include "surface.h"

// What a method left out of its work, and of how much; 0 of 0 where it has nothing to leave out.
typedef struct MethodWork {
    const char *what; // "slices", "layers"
    double skipped, of;
} MethodWork;
// Clear `voxels` and set the bits that the method finds. `everything`: leave nothing out. A method not known ends the program.
MethodWork method_find(const char *method, const Voxelizer *voxelizer, const Surfaces *surfaces,
                       const RasterMesh *mesh, bool everything, const Voxels *voxels);

// Fragment and compute shader invocations between begin and end (GL_ARB_pipeline_statistics_query).
typedef struct MethodCounter {
    GLuint queries[2];
} MethodCounter;
MethodCounter method_count_begin(void);
void method_count_end(MethodCounter *counter, double *fragments, double *invocations);

#endif
