// rows: see rows.h.
#include "rows.h"

// clang-format off
#define SWEEP(method, resolution) {method, NULL, "method=" method " resolution=" #resolution, NULL},
#define SWEEPS(method)                                                                                       \
    SWEEP(method, 16) SWEEP(method, 32) SWEEP(method, 64) SWEEP(method, 128) SWEEP(method, 256) SWEEP(method, 512)
const RunRow voxel_sweep[] = {
    SWEEPS("raster") SWEEPS("threepass") SWEEPS("slicing") SWEEPS("peeling") SWEEPS("msaa")
    SWEEPS("expanded") SWEEPS("binary") SWEEPS("exact") SWEEPS("solid")
    {NULL, NULL, NULL, NULL},
};

// The cases that are hard for other methods than exact: 10⁶ triangles in a voxel, an edge along a grid line, a grid of 3 × 500 × 7, one of 1³.
#define HARD(method)                                                                                         \
    {method " crowd", "crowd", "method=" method " resolution=16", NULL},                                     \
    {method " edge", "edge", "method=" method " resolution=16", NULL},                                       \
    {method " beam", "beam", "method=" method " resolution=500", NULL},                                      \
    {method " one voxel", "cube", "method=" method " resolution=1", NULL},
const RunRow voxel_stability[] = {
    {"cube 16", "cube", "method=exact resolution=16", NULL},
    {"cube 32", "cube", "method=exact resolution=32", NULL},
    {"cube in faces", "cube", "method=exact resolution=64", NULL},
    {"faces", "faces", "method=exact resolution=16", NULL},
    {"oblique", "oblique", "method=exact resolution=16", NULL},
    {"oblique 256", "oblique", "method=exact resolution=256", NULL},
    {"far", "far", "method=exact resolution=16", NULL},
    {"small", "small", "method=exact resolution=16", NULL},
    {"floor", "floor", "method=exact resolution=64", NULL},
    {"one voxel", "cube", "method=exact resolution=1", NULL},
    {"empty", "empty", "method=exact resolution=16", NULL},
    {"vast", "vast", "method=exact resolution=32 region_lower=0.4999995,0.4999995,0.4999995 region_upper=0.5000005,0.5000005,0.5000005", NULL},
    {"slivers", "slivers", "method=exact resolution=64", NULL},
    {"huge", "huge", "method=exact resolution=64", NULL},
    {"tiny", "tiny", "method=exact resolution=64", NULL},
    {"degenerate", "degenerate", "method=exact resolution=64", NULL},
    {"planar", "planar", "method=exact resolution=64", NULL},
    {"one point", "point", "method=exact resolution=16", NULL},
    {"smaller than a voxel", "speck", "method=exact resolution=16", NULL},
    {"crowd", "crowd", "method=exact resolution=16", NULL},
    {"edge", "edge", "method=exact resolution=16", NULL},
    {"beam", "beam", "method=exact resolution=500", NULL},
    HARD("raster") HARD("threepass") HARD("slicing") HARD("peeling") HARD("msaa") HARD("expanded") HARD("binary")
    {"ball", "ball", "method=solid resolution=128", NULL},
    {"ball inside out", "ball_inside_out", "method=solid resolution=128", NULL},
    {"ball twice", "ball_twice", "method=solid resolution=128", NULL},
    {"ball with holes", "ball_holes", "method=solid resolution=128", NULL},
    {"balls that overlap", "balls", "method=solid resolution=128", NULL},
    {NULL, NULL, NULL, NULL},
};
// clang-format on
