// camera: the rays of the picture. raster_set_camera (common/raster.h) sets the uniforms.
uniform vec3 eye; // world, metres
uniform vec3 ray_lower_left, ray_right, ray_up;

// The unit direction of the ray through picture position uv in [0, 1]², v up.
vec3 camera_ray(vec2 uv)
{
    return normalize(ray_lower_left + uv.x * ray_right + uv.y * ray_up);
}

// Clip position of a point relative to the eye, for drawing; depth is near_distance/z: 1 at the near plane, 0 at infinity (clip control
// zero to one, depth test GL_GREATER). It stands on the same vectors as camera_ray, so both agree on where a pixel is.
vec4 camera_clip(vec3 from_eye, float near_distance)
{
    vec3 forward = ray_lower_left + 0.5 * (ray_right + ray_up); // unit
    return vec4(2.0 * dot(from_eye, ray_right) / dot(ray_right, ray_right),
                2.0 * dot(from_eye, ray_up) / dot(ray_up, ray_up), near_distance, dot(from_eye, forward));
}
