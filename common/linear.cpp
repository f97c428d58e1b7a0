// linear: matrices, cameras and quaternions from GLM behind `extern "C"`.
//
// GLM works in double here and the result is rounded once: a view of a scene 10⁶ m from the origin, a near plane at 10⁻³ m
// under a far one at 10⁶ m, or the determinant of a 10⁻⁶ m box would lose most of float's 24 bits on the way. A frame asks
// for a few dozen of these, so their time does not matter.
#include "linear.h"

#define GLM_FORCE_EXPLICIT_CTOR // no silent narrowing between GLM's own types
#include <glm/glm.hpp>
#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

namespace
{

// Below this sine two directions are parallel: float inputs define their cross product no better than 2⁻²⁴ ≈ 6e-8, and
// ten times that keeps its direction good to a tenth of a radian.
constexpr double PARALLEL_SINE = 6e-7;
// How near the poles an orbit comes: half a degree, far above what float makes of the next step's up and view directions.
constexpr double POLE_GAP_RAD = 0.01;

glm::dvec3 to_glm(vec3 a)
{
    return {a[0], a[1], a[2]};
}
vec4 from_glm(const glm::dvec4 &a)
{
    const glm::vec4 rounded(a);
    return vec4{rounded.x, rounded.y, rounded.z, rounded.w};
}
vec3 from_glm(const glm::dvec3 &a)
{
    return from_glm(glm::dvec4(a, 0.0));
}
glm::dvec4 to_glm4(vec4 a)
{
    return {a[0], a[1], a[2], a[3]};
}
glm::dmat4 to_glm(const mat4 &m)
{
    return glm::dmat4(to_glm4(m.column[0]), to_glm4(m.column[1]), to_glm4(m.column[2]), to_glm4(m.column[3]));
}
mat4 from_glm(const glm::dmat4 &m)
{
    return mat4{{from_glm(m[0]), from_glm(m[1]), from_glm(m[2]), from_glm(m[3])}};
}

// Squares of floats neither over- nor underflow in double.
glm::dvec3 unit_or_zero(const glm::dvec3 &a)
{
    const double length = glm::length(a);
    return length > 0.0 ? a / length : a;
}

// `up` made fit to be crossed with the unit vector `view`: where they are parallel, the world axis farthest from `view`.
glm::dvec3 usable_up(const glm::dvec3 &view, const glm::dvec3 &up)
{
    const glm::dvec3 unit = unit_or_zero(up), size = glm::abs(view);
    if (glm::length(glm::cross(view, unit)) > PARALLEL_SINE)
        return unit;
    const bool x = size.x <= glm::min(size.y, size.z), y = !x && size.y <= size.z;
    return glm::dvec3(x, y, !x && !y);
}

} // namespace

extern "C" {

vec3 vec3_normalize(vec3 a)
{
    return from_glm(unit_or_zero(to_glm(a)));
}
vec3 vec3_min(vec3 a, vec3 b)
{
    return from_glm(glm::min(to_glm(a), to_glm(b)));
}
vec3 vec3_max(vec3 a, vec3 b)
{
    return from_glm(glm::max(to_glm(a), to_glm(b)));
}
bool vec3_is_finite(vec3 a)
{
    return std::isfinite(a[0]) && std::isfinite(a[1]) && std::isfinite(a[2]);
}

mat4 mat4_multiply(mat4 a, mat4 b)
{
    return from_glm(to_glm(a) * to_glm(b));
}
vec4 mat4_transform(mat4 m, vec4 v)
{
    return from_glm(to_glm(m) * to_glm4(v));
}
vec3 mat4_transform_point(mat4 m, vec3 point)
{
    const glm::dvec4 moved = to_glm(m) * glm::dvec4(to_glm(point), 1.0);
    return from_glm(glm::dvec3(moved) / moved.w);
}
mat4 mat4_inverse(mat4 m)
{
    return from_glm(glm::inverse(to_glm(m)));
}
mat4 mat4_perspective(float vertical_fov_rad, float aspect, float near_distance, float far_distance)
{
    return from_glm(glm::perspectiveRH_NO<double>(vertical_fov_rad, aspect, near_distance, far_distance));
}
mat4 mat4_orthographic(float left, float right, float bottom, float top, float near_distance,
                       float far_distance)
{
    return from_glm(glm::orthoRH_NO<double>(left, right, bottom, top, near_distance, far_distance));
}
mat4 mat4_look_at(vec3 eye, vec3 target, vec3 up)
{
    const glm::dvec3 from = to_glm(eye);
    glm::dvec3 view = unit_or_zero(to_glm(target) - from);
    if (view == glm::dvec3(0.0))
        view = {0, 0, -1};
    return from_glm(glm::lookAtRH(from, from + view, usable_up(view, to_glm(up))));
}

quat quat_rotation(float angle_rad, vec3 axis)
{
    const glm::quat turn(glm::angleAxis(static_cast<double>(angle_rad), to_glm(axis)));
    return quat{turn.x, turn.y, turn.z, turn.w};
}
vec3 quat_rotate(quat rotation, vec3 v)
{
    return from_glm(glm::dquat(rotation.w, rotation.x, rotation.y, rotation.z) * to_glm(v));
}

mat4 camera_view(Camera camera)
{
    return mat4_look_at(camera.eye, camera.target, camera.up);
}
mat4 camera_projection(Camera camera, float aspect)
{
    return mat4_perspective(camera.vertical_fov_rad, aspect, camera.near_distance, camera.far_distance);
}
Camera camera_orbit(Camera camera, float yaw_rad, float pitch_rad, float zoom)
{
    const glm::dvec3 offset = to_glm(camera.eye) - to_glm(camera.target);
    const double distance = glm::length(offset);
    if (!(distance > 0.0))
        return camera;
    const glm::dvec3 towards_eye = offset / distance;
    glm::dvec3 up = unit_or_zero(to_glm(camera.up));
    if (up == glm::dvec3(0.0))
        up = {0, 1, 0};
    const glm::dvec3 right = glm::normalize(glm::cross(usable_up(towards_eye, up), towards_eye));

    const double elevation = std::atan2(glm::dot(towards_eye, up), glm::length(glm::cross(towards_eye, up)));
    const double limit = glm::half_pi<double>() - POLE_GAP_RAD;
    const double raised = glm::clamp(elevation + pitch_rad, -limit, limit);
    // turning about `right` by the right-hand rule lowers the eye, hence the sign
    const quat pitch = quat_rotation(static_cast<float>(elevation - raised), from_glm(right));
    const quat yaw = quat_rotation(yaw_rad, from_glm(up));
    const glm::dvec3 turned = to_glm(quat_rotate(yaw, quat_rotate(pitch, from_glm(towards_eye))));

    Camera moved = camera;
    moved.eye = from_glm(to_glm(camera.target) + glm::normalize(turned) * (distance * zoom));
    const glm::dvec3 kept = to_glm(moved.eye) - to_glm(camera.target);
    return vec3_is_finite(moved.eye) && kept != glm::dvec3(0.0) ? moved : camera;
}

} // extern "C"
