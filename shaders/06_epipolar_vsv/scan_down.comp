// The scan in log steps, way down: the level above, scanned, holds the or of all voxels up to the end of each pair. What is left is a mip chain of scanned volumes.
layout(local_size_x = 64) in;
#include "06_epipolar_vsv/levels.glsl"

//[down
void main()
{
    ivec2 at = ivec2(gl_GlobalInvocationID.xy); // word column, α of this level
    if (at.x >= epipolar_columns() || at.y >= level_count(level))
        return;
    int pair = at.y >> 1, own = level_word(level, at.y, at.x);
    bool second = (at.y & 1) != 0;
    uint before = second || pair > 0 ? voxels[level_word(level + 1, second ? pair : pair - 1, at.x)] : 0u;
    voxels[own] = second ? before : before | voxels[own];
}
//]
