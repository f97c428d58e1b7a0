// scene_builtin_colonnade: the parts that the courtyard is put together from. A side is a frame: x along the wall, y up, z into the court.
#ifndef SCENE_BUILTIN_COLONNADE_H
#define SCENE_BUILTIN_COLONNADE_H

#include "scene_builtin.h"

static const float BAY = 3; // from column to column, metres
static const float FIRST_FLOOR = 5.2f, EAVES = 9.5f;

typedef enum Stuff {
    STONE,
    PALE_STONE,
    DARK_STONE,
    PLASTER,
    BRICK,
    WOOD,
    ROOF_RED,
    ROOF_BROWN,
    OCHRE,
    POMPEIAN_RED,
    TEAL,
    CLOTH_RED,
    CLOTH_GREEN,
    CLOTH_BLUE,
    TERRACOTTA,
    LEAF,
    WATER,
    BRONZE,
    TILE_WARM,
    TILE_GREY,
    TILE_PALE,
    STUFF_COUNT
} Stuff;

// A part between two corners, in the side's frame.
void colonnade_block(Mesh *mesh, const Frame *side, vec3 lower, vec3 upper, Stuff stuff);
void colonnade_lower_column(Mesh *mesh, const Frame *side, float along);
void colonnade_upper_column(Mesh *mesh, const Frame *side, float along);
void colonnade_balustrade(Mesh *mesh, const Frame *side, float start);
// On a rod behind an arch, drawn together more or less.
void colonnade_curtain(Mesh *mesh, const Frame *side, float centre, Stuff cloth, Random *random);
void colonnade_pot_and_tree(Mesh *mesh, vec3 foot, Random *random);
void colonnade_fountain(Mesh *mesh);

typedef struct Arch {
    float centre, springing, top; // along the wall; heights
    float radius, band;           // of the opening; width of the moulding around it
    float half_thickness;
    Stuff wall, stones[2]; // the ring's stones alternate
} Arch;

// The wall of one bay above its columns: opening, moulded ring of stones, spandrels up to the top.
void colonnade_arch(Mesh *mesh, const Frame *side, const Arch *arch);

#endif
