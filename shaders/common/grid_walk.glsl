// grid_walk: the first set voxel along a ray. Taught line by line in chapter 01.
// Amanatides and Woo, "A fast voxel traversal algorithm for ray tracing" (1987): from voxel to voxel across the nearest of the
// three next planes. Two departures. They add a plane's distance to the last one's, which drifts; here it comes from
// the plane's own number. And blocks of 8³ voxels with no bit set are crossed in one stride, which finds the very voxel
// behind the block that single steps would find, ties included.
#ifndef GRID_WALK_GLSL
#define GRID_WALK_GLSL
#include "common/grid.glsl"

layout(std430, binding = 0) readonly buffer WalkedWords { uint walked_words[]; };
layout(std430, binding = 1) readonly buffer WalkedBlocks { uint walked_blocks[]; }; // 1: a bit of the block is set; x fastest

const int BLOCK_SHIFT = 3; // 8³ voxels a block: of 4, 8, 16 the fastest on the bunny at 64³ to 256³

struct GridHit {
    bool found;
    ivec3 voxel;
    bvec3 face;     // the axis of the face that the ray enters the voxel by; none: it begins inside
    float distance; // in the unit of the direction
    int crossed;    // planes between the first voxel of the grid and this one
    int fetches;    // of words and blocks
};

bool grid_voxel_set(ivec3 voxel)
{
    uint place, word = grid_word(voxel, place);
    return (walked_words[word] >> place & 1u) != 0u;
}

bool grid_block_set(ivec3 voxel)
{
    ivec3 blocks = (grid_size - 1 >> BLOCK_SHIFT) + 1, block = voxel >> BLOCK_SHIFT;
    return walked_blocks[(block.z * blocks.y + block.y) * blocks.x + block.x] != 0u;
}

// Of the axis that is met first; of equal distances the first.
bvec3 nearest_axis(vec3 t)
{
    bool x = t.x <= t.y && t.x <= t.z, y = !x && t.y <= t.z;
    return bvec3(x, y, !x && !y);
}

//[walk
// `origin` and `direction` in voxels from the grid's corner.
GridHit grid_walk(vec3 origin, vec3 direction)
{
    // no division by 0; the planes of such an axis are then farther than any grid is long
    direction = mix(direction, vec3(1e-20), lessThan(abs(direction), vec3(1e-20)));
    vec3 inverse = 1.0 / direction;
    ivec3 forward = ivec3(greaterThan(direction, vec3(0.0))), step = 2 * forward - 1;
    vec3 enter = (vec3(grid_size * (1 - forward)) - origin) * inverse;
    vec3 leave = (vec3(grid_size * forward) - origin) * inverse;
    GridHit hit = GridHit(false, ivec3(0), bvec3(false), max(0.0, max(enter.x, max(enter.y, enter.z))), 0, 0);
    if (hit.distance > min(leave.x, min(leave.y, leave.z)))
        return hit;
    ivec3 voxel = clamp(ivec3(floor(origin + direction * hit.distance)), ivec3(0), grid_size - 1);
    if (hit.distance > 0.0) {
        hit.face = nearest_axis(-enter);
        voxel = mix(voxel, (grid_size - 1) * (1 - forward), hit.face);
    }
    ivec3 first = voxel;
    ivec3 block = ivec3(-1); // the last one that was asked for
    while (grid_inside(voxel)) {
#if !EVERYTHING
        if ((voxel >> BLOCK_SHIFT) != block) {
            block = voxel >> BLOCK_SHIFT;
            hit.fetches++;
            if (!grid_block_set(voxel)) {
                ivec3 plane = min(block + forward << BLOCK_SHIFT, grid_size);
                vec3 t = (vec3(plane) - origin) * inverse;
                hit.face = nearest_axis(t);
                hit.distance = min(t.x, min(t.y, t.z));
                // Begin too far back; of the planes on the way, cross those that single steps cross before the block's.
                ivec3 back = ivec3(floor(origin + direction * hit.distance)) - step;
                voxel = mix(min(back, voxel), max(back, voxel), equal(forward, ivec3(1)));
                voxel = mix(voxel, plane - forward, hit.face);
                bvec3 tie_first = bvec3(!hit.face.x, hit.face.z, false);
                for (bvec3 crossed = bvec3(true); any(crossed);) {
                    t = (vec3(voxel + forward) - origin) * inverse;
                    crossed = mix(lessThan(t, vec3(hit.distance)), lessThanEqual(t, vec3(hit.distance)), tie_first);
                    crossed = mix(crossed, bvec3(false), hit.face);
                    voxel += step * ivec3(crossed);
                }
                voxel += step * ivec3(hit.face);
                continue;
            }
        }
#endif
        hit.fetches++;
        if (grid_voxel_set(voxel)) {
            hit.found = true;
            break;
        }
        vec3 t = (vec3(voxel + forward) - origin) * inverse;
        hit.face = nearest_axis(t);
        hit.distance = min(t.x, min(t.y, t.z));
        voxel += step * ivec3(hit.face);
    }
    hit.voxel = voxel;
    ivec3 way = abs(voxel - first);
    hit.crossed = way.x + way.y + way.z;
    return hit;
}
//]

#endif
