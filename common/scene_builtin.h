// scene_builtin: what the generators of the built-in scenes share and nobody else needs.
#ifndef SCENE_BUILTIN_H
#define SCENE_BUILTIN_H

#include "scene.h"

// Everything in a model file, nodes' transforms applied, not yet validated (scene_import.c). Work error where Assimp cannot read it.
// Where an OBJ has no normals, edges flatter than `crease_degrees` are smoothed; from 175 on all are, in half the time.
void scene_import(Scene *scene, const char *path, float crease_degrees);
// The box of the triangles, NaN and bad indices left out; false and a cube of 1 m around the origin where there is none.
bool scene_bounds(const Mesh *mesh, vec3 *lower, vec3 *upper);

// Air with something in it: 1/m, nine tenths scattered, one absorbed, mostly forward.
Medium scene_haze(float extinction);

// Uniform numbers from a seed: SplitMix64 (Steele, Lea, Flood 2014, figure 9's constants).
typedef struct Random {
    uint64_t state;
} Random;
float random_between(Random *random, float least, float most);
vec3 random_direction(Random *random); // unit, uniform on the sphere

// Where a part stands and how it is turned: right-handed orthonormal axes, y up the part.
typedef struct Frame {
    vec3 origin, x, y, z;
} Frame;
Frame frame_at(vec3 origin, float yaw_rad);
vec3 frame_point(const Frame *frame, float x, float y, float z);
vec3 frame_vector(const Frame *frame, float x, float y, float z);

// A triangle with vertices of its own and their flat normal.
void mesh_add_flat_triangle(Mesh *mesh, vec3 a, vec3 b, vec3 c, uint32_t material);
// a, b, c, d counter-clockwise.
void frame_quad(Mesh *mesh, const Frame *frame, vec3 a, vec3 b, vec3 c, vec3 d, uint32_t material);
void frame_box(Mesh *mesh, const Frame *frame, vec3 lower, vec3 upper, uint32_t material);
// The surface that {radius, height} pairs sweep about the frame's y. Heights rise along an outer side; corners sharper than 50° stay sharp.
// Segments whose radius is 0 at one end become a fan.
void frame_revolve(Mesh *mesh, const Frame *frame, const vec2 *profile, int points, int segments,
                   uint32_t material);

void make_colonnade(Scene *scene, uint64_t seed);
void make_fence(Scene *scene, uint64_t seed);
void make_toroid(Scene *scene, uint64_t seed);
void make_forest(Scene *scene, uint64_t seed);
void make_slivers(Scene *scene, uint64_t seed);
void make_huge(Scene *scene, uint64_t seed);
void make_tiny(Scene *scene, uint64_t seed);
void make_degenerate(Scene *scene, uint64_t seed);
void make_planar(Scene *scene, uint64_t seed);

#endif
