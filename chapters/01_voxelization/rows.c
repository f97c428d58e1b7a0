// rows: see rows.h.
#include "rows.h"

// clang-format off
// A resolution's rows stand together, and exact beside raster, so that what is compared was measured within the same minute.
#define SWEEP(method, resolution) {method, NULL, "method=" method " resolution=" #resolution, NULL},
#define SWEEP_ALL(resolution)                                                                                \
    SWEEP("raster", resolution) SWEEP("exact", resolution) SWEEP("threepass", resolution)                    \
    SWEEP("msaa", resolution) SWEEP("expanded", resolution) SWEEP("solid", resolution)                       \
    SWEEP("binary", resolution) SWEEP("slicing", resolution) SWEEP("peeling", resolution)
// How time and fragments grow with the triangles of one shape.
#define GROW(method, scene) {method, scene, "method=" method " resolution=128", NULL},
#define GROW_ALL(scene)                                                                                      \
    GROW("raster", scene) GROW("exact", scene) GROW("threepass", scene) GROW("msaa", scene)                  \
    GROW("expanded", scene) GROW("solid", scene) GROW("binary", scene) GROW("slicing", scene) GROW("peeling", scene)
#define STORES(storage, resolution)                                                                          \
    {"exact " storage, NULL, "method=exact storage=" storage " resolution=" #resolution, NULL},
const RunRow voxel_sweep[] = {
    SWEEP_ALL(16) SWEEP_ALL(32) SWEEP_ALL(64) SWEEP_ALL(128) SWEEP_ALL(256) SWEEP_ALL(512)
    GROW_ALL("sphere_1000") GROW_ALL("sphere_10000") GROW_ALL("sphere_100000") GROW_ALL("sphere_1000000")
    STORES("attributes", 64) STORES("list", 64) STORES("average", 64)
    STORES("attributes", 128) STORES("list", 128) STORES("average", 128)
    STORES("attributes", 256) STORES("list", 256) STORES("average", 256)
    {NULL, NULL, NULL, NULL},
};

// What may break any method: nothing at all, a point, less than a voxel, 10⁶ triangles in a voxel, an edge along a grid line, grids of 3 × 500 × 7
// and of 1³, scales of 10⁶ and 10⁻⁶ m.
#define HARD(method)                                                                                         \
    {method " empty", "empty", "method=" method " resolution=16", NULL},                                     \
    {method " one point", "point", "method=" method " resolution=16", NULL},                                 \
    {method " smaller than a voxel", "speck", "method=" method " resolution=16", NULL},                      \
    {method " crowd", "crowd", "method=" method " resolution=16", NULL},                                     \
    {method " edge", "edge", "method=" method " resolution=16", NULL},                                       \
    {method " beam", "beam", "method=" method " resolution=500", NULL},                                      \
    {method " one voxel", "cube", "method=" method " resolution=1", NULL},                                   \
    {method " huge", "huge", "method=" method " resolution=64", NULL},                                       \
    {method " tiny", "tiny", "method=" method " resolution=64", NULL},
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
    {"attributes crowd", "crowd", "method=exact storage=attributes resolution=16", NULL},
    {"list crowd", "crowd", "method=exact storage=list resolution=16", NULL},
    {"attributes averages", "averages", "method=exact storage=attributes resolution=16", NULL},
    {"ball", "ball", "method=solid resolution=128", NULL},
    {"ball inside out", "ball_inside_out", "method=solid resolution=128", NULL},
    {"ball twice", "ball_twice", "method=solid resolution=128", NULL},
    {"ball with holes", "ball_holes", "method=solid resolution=128", NULL},
    {"balls that overlap", "balls", "method=solid resolution=128", NULL},
    {NULL, NULL, NULL, NULL},
};
// clang-format on
