// grid: where voxels lie and where a voxel's bit is. Taught line by line in chapter 01.
// Voxel (x, y, z) is the closed box from grid_origin + (x, y, z)·voxel_size to grid_origin + (x+1, y+1, z+1)·voxel_size.
// Bits as grid_words of common/scene.h says: bit i & 31 of word i >> 5, i = (z·size.y + y)·size.x + x.
#ifndef GRID_GLSL
#define GRID_GLSL

uniform ivec3 grid_size; // voxels

//[address
// The word that holds a voxel's bit, and the bit's place in it. i needs more than 32 bits from 1626³ voxels on; the word's number
// does not before 5160³.
uint grid_word(ivec3 voxel, out uint place)
{
    uint row = uint(voxel.z) * uint(grid_size.y) + uint(voxel.y), high, low, carry;
    umulExtended(row, uint(grid_size.x), high, low);
    low = uaddCarry(low, uint(voxel.x), carry);
    place = low & 31u;
    return ((high + carry) << 27) | (low >> 5);
}
//]

bool grid_inside(ivec3 voxel)
{
    return all(greaterThanEqual(voxel, ivec3(0))) && all(lessThan(voxel, grid_size));
}

#endif
