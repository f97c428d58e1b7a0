// The scan in log steps, way up: a level holds the or of pairs of voxels along α of the level below (Harris et al. 2008; Wyman 2011, section 2.2.2).
layout(local_size_x = 64) in;
#include "06_epipolar_vsv/levels.glsl"

//[up
void main()
{
    ivec2 at = ivec2(gl_GlobalInvocationID.xy); // word column, α of this level
    if (at.x >= epipolar_columns() || at.y >= level_count(level))
        return;
    uint word = voxels[level_word(level - 1, 2 * at.y, at.x)];
    if (2 * at.y + 1 < level_count(level - 1))
        word |= voxels[level_word(level - 1, 2 * at.y + 1, at.x)];
    voxels[level_word(level, at.y, at.x)] = word;
}
//]
