// Where a word column's shadow begins, and where it has nothing else, by descent through the mip chain: at each level one look says in which half.
layout(local_size_x = 64) in;
#include "06_epipolar_vsv/levels.glsl"
#include "06_epipolar_vsv/slices.glsl"

//[descend
int descend(int column, bool whole) // the first α whose word has a set bit, or has all set; epipolar_count.x: none
{
    int alpha = 0;
    for (int at_level = level; at_level >= 0; at_level--) {
        alpha *= 2;
        uint word = alpha < level_count(at_level) ? voxels[level_word(at_level, alpha, column)] : ~0u;
        alpha += int(whole ? word != ~0u : word == 0u);
    }
    return min(alpha, epipolar_count.x);
}
//]

void main()
{
    int column = int(gl_GlobalInvocationID.x);
    if (column < epipolar_columns())
        slices_note(column / epipolar_row_words(), descend(column, false), descend(column, true));
}
