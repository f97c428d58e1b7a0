// items: the work of voxelization, cut into pieces of like size: one triangle in one slice, over a stretch of columns (voxels along α). A wall becomes thousands of
// items, a triangle of a model one or two; neighbours in the list are mostly of one triangle, so that invocations that run in step have alike to do.
layout(local_size_x = 64) in;

struct Item {
    uint triangle;
    uint place; // slice in the low 16 bits, stretch in the others
};
layout(std430, binding = 4) buffer Items { Item items[]; };
uniform uint item_count; // in the list, or (extent.comp) for which there is room

const int STRETCH = 256; // columns: an invocation's loops end silently after 65 535 iterations in all, and each column costs up to 90

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
