// sparse: what its passes share. Comes after 06_epipolar_vsv/query.glsl. A row's texel: airlight times sparse_smooth, and the span of φ that it comes from.
#ifndef SPARSE_GLSL
#define SPARSE_GLSL

const vec4 SPARSE_NONE = vec4(0.0, 0.0, 0.0, -1e9); // a row that speaks for no pixel

// Pixels that ask for themselves, and how many groups of 64 that makes, in rows of SPARSE_WIDE (defined by sparse.c): OpenGL promises 65535 a dimension.
layout(std430, binding = 6) buffer Left { uint left_wide, left_high, left_deep, left; uint left_pixel[]; };

// Airlight goes as 1/D with the light's distance from the ray; times D it is smooth, but for rays through the light's radius, where the inverse square is held.
float sparse_smooth(Ray ray)
{
#if MAP_KIND == DIRECTIONAL
    return 1.0;
#else
    return ray.nearest;
#endif
}

bool sparse_outside(Ray ray)
{
#if MAP_KIND == DIRECTIONAL
    return true;
#else
    return ray.nearest >= light_radius;
#endif
}

#endif
