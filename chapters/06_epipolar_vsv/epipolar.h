// epipolar: the space (α, θ, φ) of Wyman 2011, section 2.1, for one eye and one light, and what of it a grid covers. shaders/common/epipolar.glsl
// says what the angles are.
#ifndef EPIPOLAR_H
#define EPIPOLAR_H

#include "scene.h"
#include "shader.h"

// Three unit vectors at right angles and a distance. The axis points from the eye to the light; θ = 0 is `up`, θ = π/2 is `side`.
typedef struct EpipolarFrame {
    vec3 eye, axis, up, side;
    float
        distance; // metres from the eye to the light; 0: the light is at the eye, the axis the camera's forward
    bool at_infinity; // a directional light: no distance, and distances from the axis in place of φ
} EpipolarFrame;
EpipolarFrame epipolar_frame(const Camera *camera, const Light *light);

// What the grid covers, and how many voxels along it (section 4.3). Angles in radians; phi in metres from the axis for a directional light.
typedef struct EpipolarRange {
    float alpha_least, alpha_most;
    float theta_least, theta_span; // span 2π: all planes; then the first slice follows the last
    float phi_least, phi_most;
    int alpha, theta, phi; // voxels; phi a multiple of 128
} EpipolarRange;
// All angles: [0, π] × 2π × [0, π]. A directional light's phi_most is 0, to be set: distances from the axis have no largest.
EpipolarRange epipolar_range_full(int alpha, int theta, int phi);
// α and θ cut down to what the picture shows. φ depends on where the rays end; it stays full.
EpipolarRange epipolar_range_seen(const EpipolarFrame *frame, const Camera *camera, float aspect, int alpha,
                                  int theta, int phi);
// The greatest φ at which a light ray can meet this box: beyond it all is lit. Where the light's half space does not hold the box, π.
float epipolar_phi_of_box(const EpipolarFrame *frame, vec3 lower, vec3 upper);
// Borders of θ slices for shaders with THETA_TABLE: range->theta + 1 floats that rise from 0 to 1 over the range, so that neighbours lie at most a pixel apart
// where slices suffice for that, and evenly many pixels apart where not. New memory. *needed: how many slices suffice.
float *epipolar_theta_borders(const EpipolarFrame *frame, const EpipolarRange *range, const Camera *camera,
                              int width, int height, int *needed);

// Sets the uniforms of shaders/common/epipolar.glsl.
void epipolar_set(const Shader *shader, const EpipolarFrame *frame, const EpipolarRange *range);

#endif
