// about: see about.h.
#include "about.h"
#include "judge.h"
#include "vsv_scenes.h"

static const char *const scenes[] = {"fence", "toroid", "colonnade", "forest",
                                     "bunny", "cell24", "crowd",     NULL};

// clang-format off
static const RunParameter parameters[] = {
    {.name = "method", .kind = RUN_CHOICE, .choices = "map conservative flat solid rays march equiangular factored bounds segments", .shows = "how voxels are found; or the same picture by shadow rays at the grid's angles, or by brute force on the map"},
    {.name = "alpha", .kind = RUN_INTEGER, .least = 1, .most = 4096, .initial = {512}, .unit = "voxels", .shows = "view rays in a slice"},
    {.name = "theta", .kind = RUN_INTEGER, .least = 1, .most = 8192, .initial = {1024}, .unit = "voxels", .shows = "slices about the line from eye to light"},
    {.name = "phi", .kind = RUN_CHOICE, .choices = "512 128 256 1024", .shows = "light rays in a slice"},
    {.name = "split", .kind = RUN_CHOICE, .choices = "all none wrap epipole", .shows = "flat: which triangles are split: across the ends of θ, around the line from eye to light"},
    {.name = "parts", .kind = RUN_INTEGER, .least = 1, .most = 16, .initial = {8}, .unit = "parts", .shows = "flat: how finely a triangle's edge is subdivided at most"},
    {.name = "warp", .kind = RUN_CHOICE, .choices = "even square borders", .shows = "how light rays are spread over a slice: evenly, densely at the eye, or where shadows have borders"},
    {.name = "slices", .kind = RUN_CHOICE, .choices = "uniform pixel", .shows = "slices at equal angles, or at most a pixel apart"},
    {.name = "range", .kind = RUN_CHOICE, .choices = "seen full", .shows = "what the grid covers: what the picture shows, or all angles"},
    {.name = "shape", .kind = RUN_CHOICE, .choices = "cube paraboloid", .shows = "map: of a point light, six squares or two paraboloids"},
    {.name = "scan", .kind = RUN_CHOICE, .choices = "columns logstep", .shows = "how the shadow behind a voxel is found"},
    {.name = "integral", .kind = RUN_CHOICE, .choices = "runs riemann factored prefix sparse", .shows = "airlight from bits: closed forms of lit runs, a sum over bits, or over slices of bits; or sums up to each word, made for all view rays of the grid; or runs of the grid's view rays alone, and pixels between them"},
    {.name = "slice", .kind = RUN_CHOICE, .choices = "8 4 16 32", .shows = "factored: bits that share one evaluation of what is smooth"},
    {.name = "filter", .kind = RUN_CHOICE, .choices = "none epipolar", .shows = "rows that a pixel asks: the nearest, or four over its own width (prefix: the four about it, weighted)"},
    {.name = "texture", .kind = RUN_CHOICE, .choices = "none window", .shows = "what the light shines through"},
    {.name = "steps", .kind = RUN_INTEGER, .least = 1, .most = 16384, .initial = {64}, .unit = "samples", .shows = "march, equiangular, factored, bounds: samples a ray"},
    {.name = "samples", .kind = RUN_INTEGER, .least = 0, .most = 16384, .initial = {0}, .unit = "rays", .shows = "rays: shadow rays a view ray; 0: as many as phi"},
    {.name = "phase", .kind = RUN_CHOICE, .choices = "uniform rayleigh henyey_greenstein hoffman_preetham hoffman_preetham_normalized", .shows = "how scattered light is shared out; mean_cosine is g"},
    {.name = "rayleigh_share", .kind = RUN_NUMBER, .least = 0, .most = 1, .initial = {0.3}, .shows = "Hoffman and Preetham: Rayleigh's share of the scattering"},
    {.name = "map", .kind = RUN_INTEGER, .least = 16, .most = 8192, .initial = {1024}, .unit = "texels", .shows = "a side of the depth maps"},
    {.name = "ambient", .kind = RUN_NUMBER, .least = 0, .most = 1e6, .initial = {0.05}, .unit = "W/(sr·m²)", .shows = "light on every surface, times its albedo"},
    {.name = NULL},
};
// clang-format on

static const RunStep steps[] = {
    {"map", "the scene in clear air, lit through the light's depth map"},
    {"voxels", "the grid laid flat, α to the right, θ upwards: where surfaces begin to cast shadow"},
    {"scanned", "and all that lies behind them on their light rays"},
    {"counts", "how much of each view ray is in shadow"},
    {"surfaces", "the scene in clear air, lit where its voxels are"},
    {"airlight", "the light that the medium scatters towards the eye"},
    {"picture", "and the surfaces behind it"},
    {NULL, NULL},
};

const RunAbout epipolar_about = {
    .chapter = "06_epipolar_vsv",
    .title = "Epipolar voxelized shadow volumes",
    .shows = "shadows in a medium from bits in a grid whose axes run along light rays and view rays",
    .source = "Wyman 2011",
    .uses = RUN_USES_CAMERA | RUN_USES_LIGHT | RUN_USES_MEDIUM | RUN_USES_DEFORM,
    .scenes = scenes,
    .own_scenes = vsv_scenes,
    .parameters = parameters,
    .steps = steps,
    .sweep = judge_sweep,
    .stability = judge_cases,
};
