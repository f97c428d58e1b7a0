// stretch: airlight of a stretch of a pixel's ray that is lit throughout, in closed form. Comes after common/airlight_ray.glsl.
#ifndef STRETCH_GLSL
#define STRETCH_GLSL

vec3 stretch(Ray ray, float from, float to)
{
#if MAP_KIND == DIRECTIONAL
#define INTEGRAL(sigma) airlight_directional(from, to, sigma)
    float scattered = phase(phase_half_angle(light_direction, ray.direction));
#else
#define INTEGRAL(sigma) airlight_point(ray.nearest, ray.foot, light_radius, from, to, sigma)
    const float scattered = 1.0;
#endif
#if GREY && !EVERYTHING
    return vec3(scattered * INTEGRAL(extinction.x));
#else
    return scattered * vec3(INTEGRAL(extinction.x), INTEGRAL(extinction.y), INTEGRAL(extinction.z));
#endif
}

#endif
