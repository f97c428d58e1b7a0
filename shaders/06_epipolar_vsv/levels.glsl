// levels: the mip chain along α behind the volume itself: each level has half as many α as the one below, rounded up.
#ifndef LEVELS_GLSL
#define LEVELS_GLSL
#include "06_epipolar_vsv/voxels.glsl"
uniform int level; // the one that is made; 0: the volume

int level_count(int at_level)
{
    return (epipolar_count.x + (1 << at_level) - 1) >> at_level;
}

int level_word(int at_level, int alpha, int column)
{
    int before = 0;
    for (int i = 0; i < at_level; i++)
        before += level_count(i);
    return (before + alpha) * epipolar_columns() + column;
}

#endif
