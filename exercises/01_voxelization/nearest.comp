// Exercise 01.4: of all fragments in a voxel, the nearest wins.
//
// Many fragments fall into one voxel at the same time, in no order. Each has a distance (0 or more: how far its surface passes from the voxel's
// centre), and the voxel is to keep the one with the smallest; of equal distances the fragment with the lowest number. The same
// winners must come out whatever the order. There is no atomicMin for floats; there is one for uint.
//
// The stages run one after the other, each over all its items, with a barrier between them:
//   CLEAR   once a voxel     prepare the voxel's two words
//   FIRST   once a fragment
//   SECOND  once a fragment
//   READ    once a voxel     winner[voxel] = the winning fragment's number, or -1 where no fragment fell
//
// Check it with: make check EX=01.4
layout(local_size_x = 64) in;
uniform int stage, item_count; // of this stage
const int CLEAR = 0, FIRST = 1, SECOND = 2, READ = 3;

struct Fragment {
    float voxel; // its number
    float distance;
};
layout(std430, binding = 0) readonly buffer Fragments { Fragment fragments[]; };
layout(std430, binding = 1) buffer Words { uint words[]; };     // yours: two a voxel
layout(std430, binding = 2) buffer Winners { float winner[]; }; // one a voxel

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= uint(item_count))
        return;
    // Yours: this says that no voxel has a fragment.
    if (stage == READ)
        winner[i] = -1.0;
}
