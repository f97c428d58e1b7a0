// texture: a light that is not the same in all directions: a leaded window, which colours its light rays. Since a texture belongs to light rays, (θ, φ) is all
// that it is asked by (Wyman 2011, figure 13). Comes after common/airlight_ray.glsl and common/epipolar.glsl.
#ifndef TEXTURE_GLSL
#define TEXTURE_GLSL

const float PANES = 4.0; // across a spot's cone, the sun's map, or a face of a point light's cube
const float LEAD = 0.12; // of a pane

//[texture
vec3 light_texture(float theta, float phi)
{
#if TEXTURE
#if MAP_KIND == DIRECTIONAL
    vec2 place = (to_clip * vec4(eye_from_origin + phi * epipolar_beside(theta), 1.0)).xy; // the window is as large as the map
#else
    vec3 direction = sin(phi) * epipolar_beside(theta) - cos(phi) * epipolar_axis;
#if MAP_KIND == SPOT
    vec4 clip = to_clip * vec4(direction, 1.0);
    vec2 place = clip.xy / max(clip.w, 1e-6);
#else
    vec3 on_face = cube_on_face(cube_face(direction), direction);
    vec2 place = on_face.xy / on_face.z;
#endif
#endif
    vec2 pane = floor(0.5 * PANES * place), inside = fract(0.5 * PANES * place);
    bool lead = any(lessThan(min(inside, 1.0 - inside), vec2(0.5 * LEAD)));
    float kind = mod(pane.x + 2.0 * pane.y, 3.0);
    vec3 glass = kind < 0.5 ? vec3(1.0, 0.35, 0.2) : kind < 1.5 ? vec3(0.3, 0.9, 0.4) : vec3(0.25, 0.4, 1.0);
    return lead || any(greaterThan(abs(place), vec2(1.0))) ? vec3(0.0) : glass;
#else
    return vec3(1.0);
#endif
}
//]

#endif
