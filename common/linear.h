// linear: vectors are GCC/Clang vector extensions, so `vec3 p = origin + t * direction;` is C;
// matrices, cameras and quaternions come from GLM behind `extern "C"` (linear.cpp).
//
// Conventions: right-handed, y up, a camera looks down -z. Matrices are column-major, as GL and GLM store
// them: m.column[3] is the translation; a point p is transformed as m * (p, 1). Clip space depth is [-1, 1].
// A vec3 is four lanes whose last one is ignored (keep it 0); it has the size and alignment of a std430 vec3
// followed by padding. Angles are radians.
#ifndef LINEAR_H
#define LINEAR_H

#include <math.h>
#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef float vec2 __attribute__((vector_size(8)));
typedef float vec3 __attribute__((vector_size(16)));
typedef float vec4 __attribute__((vector_size(16)));
typedef struct mat4 {
    vec4 column[4];
} mat4;
typedef struct quat {
    float x, y, z, w;
} quat;

// Where the picture is taken from. Distances in metres, vertical field of view in radians.
typedef struct Camera {
    vec3 eye, target, up;
    float vertical_fov_rad;
    float near_distance, far_distance;
} Camera;

static inline vec3 vec3_make(float x, float y, float z)
{
    return (vec3){x, y, z, 0.0f};
}
static inline float vec3_dot(vec3 a, vec3 b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
static inline vec3 vec3_cross(vec3 a, vec3 b)
{
    return vec3_make(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
}
static inline float vec3_length(vec3 a)
{
    return sqrtf(vec3_dot(a, a));
}
// a / |a|; the zero vector stays zero. Safe for lengths whose square over- or underflows.
vec3 vec3_normalize(vec3 a);
vec3 vec3_min(vec3 a, vec3 b);
vec3 vec3_max(vec3 a, vec3 b);
bool vec3_is_finite(vec3 a);

mat4 mat4_multiply(mat4 a, mat4 b);            // a · b: b is applied first
vec4 mat4_transform(mat4 m, vec4 v);           // m · v
vec3 mat4_transform_point(mat4 m, vec3 point); // (m · (point, 1)).xyz / w
mat4 mat4_inverse(mat4 m);                     // not finite for a singular m
mat4 mat4_perspective(float vertical_fov_rad, float aspect, float near_distance, float far_distance);
mat4 mat4_orthographic(float left, float right, float bottom, float top, float near_distance,
                       float far_distance);
// `up` may be zero or parallel to the view direction: another axis is then taken; eye = target looks down -z.
mat4 mat4_look_at(vec3 eye, vec3 target, vec3 up);

// By the right-hand rule about a unit axis.
quat quat_rotation(float angle_rad, vec3 axis);
vec3 quat_rotate(quat rotation, vec3 v);

mat4 camera_view(Camera camera);
mat4 camera_projection(Camera camera, float aspect);
// Turn the eye about the target and scale its distance by `zoom`. Positive yaw turns about `up` by the right-hand rule,
// positive pitch raises the eye towards `up`, stopped 0.01 rad short of the poles. A turn or zoom that float cannot hold
// (eye on the target, or infinitely far) is left out.
Camera camera_orbit(Camera camera, float yaw_rad, float pitch_rad, float zoom);

#ifdef __cplusplus
}
#endif
#endif
