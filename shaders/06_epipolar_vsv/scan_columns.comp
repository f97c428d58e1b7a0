// The scan, a bitwise or of all voxels nearer to the light: one invocation a word column (one θ, 32 φ), from its first set bit on to the last α. Neighbours
// work on neighbouring words, nothing waits for anything. What a word column learns of itself on the way helps the query: from where on its slice has any
// shadow, and from where on nothing else.
layout(local_size_x = 64) in;
#include "06_epipolar_vsv/voxels.glsl"
#include "06_epipolar_vsv/slices.glsl"

//[scan
void main()
{
    int column = int(gl_GlobalInvocationID.x), columns = epipolar_columns();
    if (column >= columns)
        return;
#if EVERYTHING
    int start = 0;
#else
    int start = int(first[column]);
#endif
    uint word = 0u;
    int full = epipolar_count.x;
    for (int alpha = start; alpha < epipolar_count.x; alpha++) {
        int at = alpha * columns + column;
        word |= voxels[at];
        voxels[at] = word;
        full = word == ~0u ? min(full, alpha) : full;
    }
    slices_note(column / epipolar_row_words(), int(first[column]), full);
}
//]
