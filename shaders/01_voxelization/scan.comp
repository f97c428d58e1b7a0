// scan: along every column of a grid, each bit becomes itself joined with all bits before it. With OR a voxel is set from the first set one on: a
// shadow volume (Wyman 2011, figure 2). With XOR it is set behind an odd number of flips: a solid. Serial along a column and 32 columns at
// once: that does the least work, and there are columns enough to fill the machine.
#include "common/grid.glsl"
#include "01_voxelization/turn.glsl"

layout(local_size_x = 64) in;
uniform int axis;       // the columns'
uniform bool backwards; // begin at the far end
layout(std430, binding = 0) readonly buffer From { uint from[]; };
layout(std430, binding = 1) buffer To { uint to[]; }; // cleared

#ifdef SOLID
#define JOIN(a, b) ((a) ^ (b))
layout(std430, binding = 4) readonly buffer Crossings { int crossings[]; };
layout(std430, binding = 5) buffer Report { uint crossed, odd, inside_out, overlapping; }; // columns
#else
#define JOIN(a, b) ((a) | (b))
#endif

// Up to 32 voxels along x from this one; `mask` has a bit for each. Rows are not padded, so they may lie in two words.
uint bits_at(ivec3 voxel, uint mask)
{
    uint place, word = grid_word(voxel, place), bits = from[word] >> place;
    if (place != 0u && mask >> (32u - place) != 0u)
        bits |= from[word + 1u] << (32u - place);
    return bits & mask;
}

void set_bits(ivec3 voxel, uint bits)
{
    uint place, word = grid_word(voxel, place);
    if (bits << place != 0u)
        atomicOr(to[word], bits << place);
    if (place != 0u && bits >> (32u - place) != 0u)
        atomicOr(to[word + 1u], bits >> (32u - place));
}

#ifdef SOLID
// What its crossings say about a column with this many set voxels.
void judge(ivec3 voxel, uint set)
{
    ivec3 turned = TURN(voxel, axis);
    int at = 2 * (turned.y * TURN(grid_size, axis).x + turned.x), count = crossings[at], wound = crossings[at + 1];
    if (count == 0)
        return;
    atomicAdd(crossed, 1u);
    if ((count & 1) != 0)
        atomicAdd(odd, 1u);
    else if (wound == -int(set) && set != 0u)
        atomicAdd(inside_out, 1u);
    else if (wound != int(set)) // a voxel is wound twice, or once forwards and another once backwards
        atomicAdd(overlapping, 1u);
}

//[counters
// 32 counters of 16 bits, one a column: bit k of all of them is one word, and 1 is added to those of `bits` at once.
uint planes[16];
#define ADD(k) { uint both = planes[k] & bits; planes[k] ^= bits; bits = both; }
void count_set(uint bits)
{
    ADD(0) ADD(1) ADD(2) ADD(3) ADD(4) ADD(5) ADD(6) ADD(7) ADD(8) ADD(9) ADD(10) ADD(11) ADD(12) ADD(13) ADD(14) ADD(15)
}
//]
#endif

//[along_x
// Bit 0 first: log2(32) steps join each bit with those before it in its word; one bit is handed on from word to word.
void scan_row(ivec3 voxel)
{
#ifdef SOLID // x fastest: the column is the row itself
    uint count = uint(crossings[2 * (voxel.z * grid_size.y + voxel.y)]);
    bool heard = (count & 1u) == 0u;
    uint set = 0u;
#endif
    uint carry = 0u;
    int chunks = (grid_size.x + 31) / 32;
    for (int i = 0; i < chunks; i++) {
        voxel.x = 32 * (backwards ? chunks - 1 - i : i);
        uint mask = 0xffffffffu >> max(voxel.x + 32 - grid_size.x, 0), bits = bits_at(voxel, mask);
        for (int step = 1; step < 32; step *= 2)
            bits = JOIN(bits, backwards ? bits >> step : bits << step);
        bits = JOIN(bits, carry) & mask;
        carry = ((backwards ? bits : bits >> 31) & 1u) != 0u ? 0xffffffffu : 0u;
#ifdef SOLID
        set += bitCount(bits);
        bits = heard ? bits : 0u;
#endif
        set_bits(voxel, bits);
    }
#ifdef SOLID
    voxel.x = 0;
    judge(voxel, set);
#endif
}
//]

//[along_yz
// 32 neighbours along x, each the head of a column along y or z.
void scan_columns(ivec3 voxel)
{
    uint mask = 0xffffffffu >> max(voxel.x + 32 - grid_size.x, 0), carry = 0u;
    int size = grid_size[axis];
#ifdef SOLID
    for (int k = 0; k < 16; k++)
        planes[k] = 0u;
    uint heard = 0u;
    for (int lane = 0; lane < 32; lane++)
        if ((mask >> lane & 1u) != 0u) {
            ivec3 turned = TURN(voxel + ivec3(lane, 0, 0), axis);
            if ((crossings[2 * (turned.y * TURN(grid_size, axis).x + turned.x)] & 1) == 0)
                heard |= 1u << lane;
        }
#endif
    for (int i = 0; i < size; i++) {
        voxel[axis] = backwards ? size - 1 - i : i;
        carry = JOIN(carry, bits_at(voxel, mask));
#ifdef SOLID
        count_set(carry);
        set_bits(voxel, carry & heard);
#else
        set_bits(voxel, carry);
#endif
    }
#ifdef SOLID
    voxel[axis] = 0;
    for (int lane = 0; lane < 32; lane++)
        if ((mask >> lane & 1u) != 0u) {
            uint set = 0u;
            for (int k = 0; k < 16; k++)
                set |= (planes[k] >> lane & 1u) << k;
            judge(voxel + ivec3(lane, 0, 0), set);
        }
#endif
}
//]

void main()
{
    int item = int((gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationID.x);
    if (axis == 0) {
        if (item < grid_size.y * grid_size.z)
            scan_row(ivec3(0, item % grid_size.y, item / grid_size.y));
        return;
    }
    int chunks = (grid_size.x + 31) / 32, other = item / chunks;
    ivec3 voxel = ivec3(32 * (item % chunks), axis == 1 ? 0 : other, axis == 1 ? other : 0);
    if (other < grid_size[3 - axis])
        scan_columns(voxel);
}
