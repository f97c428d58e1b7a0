// The least and greatest φ that any pixel's ray reaches where light can be (Wyman 2011, section 4.3): of surfaces, and of the sky, whose rays go on towards π - α.
// Beside it: how near the nearest surface is.
#define RAY_CONE (MAP_KIND == 1)
#include "common/airlight_ray.glsl"
#include "06_epipolar_vsv/query.glsl"
layout(std430, binding = 5) buffer Range { uint phi_least, phi_most, nearest; }; // positive floats are in order as integers

//[absorbed
// Beyond it next to nothing of the light is left: the way eye-point-light is longer than at the ray's begin by what dims to e^-14. Points of one such way lie on an
// ellipse about eye and light, for which t + √(D² - 2 t foot + t²) = way is solved by t = (way² - D²) / 2 (way - foot).
float absorbed_from(Ray ray)
{
    float least = AIRLIGHT_FAR; // the least extinction of a channel that scatters at all
    for (int k = 0; k < 3; k++)
        least = scattering[k] > 0.0 ? min(least, extinction[k]) : least;
    float longer = AIRLIGHT_CUT / least;
#if MAP_KIND == DIRECTIONAL
    return longer;
#else
#if RAY_CONE
    longer += max(ray.from + airlight_hypotenuse(ray.nearest, ray.from - ray.foot) - epipolar_distance, 0.0);
#endif
    return longer * ((longer + 2.0 * epipolar_distance) / (2.0 * max(longer + epipolar_distance - ray.foot, 1e-30)));
#endif
}
//]

//[range
void main()
{
    float least = 1.0 / 0.0, most = 0.0, surface = 1.0 / 0.0;
    for (int i = 0; i < ROWS; i++) { // what an invocation tells takes as long as a ray
        ivec2 pixel = ivec2(gl_GlobalInvocationID.x, ROWS * int(gl_GlobalInvocationID.y) + i);
        Ray ray = ray_to_surface(ray_direction(pixel), imageLoad(distances, pixel).x);
        vec2 alpha = vec2(length(cross(epipolar_axis, ray.direction)), dot(epipolar_axis, ray.direction));
        float to = epipolar_phi(alpha, min(ray.to, absorbed_from(ray)));
        bool seen = all(lessThan(pixel, imageSize(distances))), lit = seen && ray.inside > 0.0;
        surface = seen ? min(surface, imageLoad(distances, pixel).x) : surface;
        most = lit ? max(most, to) : most;
#if RAY_CONE
        least = lit ? min(least, max(epipolar_phi(alpha, ray.from), 0.0)) : least;
#else
        least = lit ? 0.0 : least;
#endif
    }
    atomicMin(nearest, floatBitsToUint(surface));
    atomicMin(phi_least, floatBitsToUint(least));
    atomicMax(phi_most, floatBitsToUint(most));
}
//]
