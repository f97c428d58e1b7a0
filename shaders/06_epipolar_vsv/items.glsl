// items: the work of voxelization, cut into pieces of like size: one triangle in one slice, over a stretch of columns (voxels along α). A wall becomes thousands of
// items, a triangle of a model one or two; neighbours in the list are mostly of one triangle, so that invocations that run in step have alike to do.
layout(local_size_x = 64) in;
#ifndef FLAT
#define FLAT 0
#endif

struct Item {
    uint triangle;
    uint place; // slice in the low 16 bits, stretch in the others
#if FLAT
    uint part; // of the subdivided triangle
#endif
};
layout(std430, binding = 4) buffer Items { Item items[]; };
uniform uint item_count; // in the list, or (extent.comp) for which there is room

// Columns. An invocation's loops end silently after 65 535 iterations in all: up to 58 a column here, and 8192 slices of up to 7 stretches in the list's making.
const int STRETCH = 640;

Item item_make(uint triangle, uint part, uint place)
{
#if FLAT
    return Item(triangle, place, part);
#else
    return Item(triangle, place);
#endif
}

uint invocation()
{
    return (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationID.x;
}

int item_slice(Item item)
{
    return int(item.place & 0xffffu);
}
// First and last column of its stretch.
ivec2 item_columns(Item item)
{
    int first = int(item.place >> 16) * STRETCH;
    return ivec2(first, min(first + STRETCH, epipolar_count.x) - 1);
}

//[bits
// Voxels first to last of a view ray.
void voxels_set_row(int column, int slice, ivec2 bits)
{
    for (int word = bits.x >> 5; word <= bits.y >> 5; word++) {
        uint mask = word == bits.x >> 5 ? 0xffffffffu << (bits.x & 31) : 0xffffffffu;
        if (word == bits.y >> 5)
            mask &= 0xffffffffu >> (31 - (bits.y & 31));
        voxels_set(column, slice, word, mask);
    }
}
//]
