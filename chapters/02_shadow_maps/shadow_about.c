// shadow_about: see shadow_about.h.
#include "shadow_about.h"
#include "shadow_scenes.h"

static const char *const scenes[] = {
    "bunny", "cornell", "colonnade", "fence", "chapters/02_shadow_maps/lamps.gltf", NULL};

// clang-format off
static const RunParameter parameters[] = {
    {.name = "kind", .kind = RUN_CHOICE, .choices = "own spot directional point", .shows = "the scene's own lights, or one of this kind made for it"},
    {.name = "map", .kind = RUN_CHOICE, .choices = "cube paraboloid", .shows = "how a point light's map covers all directions"},
    {.name = "fit", .kind = RUN_CHOICE, .choices = "view scene", .shows = "what a directional light's map covers"},
    {.name = "resolution", .kind = RUN_INTEGER, .least = 1, .most = 8192, .initial = {1024}, .unit = "texels", .shows = "a map has resolution^2 texels in all its faces"},
    {.name = "bias", .kind = RUN_CHOICE, .choices = "slope none constant normal", .shows = "how far a surface is taken nearer to the light than it is"},
    {.name = "bias_constant", .kind = RUN_NUMBER, .least = 0, .most = 1e8, .initial = {0.02}, .unit = "m", .shows = "bias=constant: distance"},
    {.name = "bias_slope", .kind = RUN_NUMBER, .least = 0, .most = 64, .initial = {1}, .unit = "texels", .shows = "bias=slope: texels along the surface"},
    {.name = "bias_normal", .kind = RUN_NUMBER, .least = 0, .most = 64, .initial = {1}, .unit = "texels", .shows = "bias=normal: texels off the surface where the light grazes it"},
    {.name = "filter", .kind = RUN_CHOICE, .choices = "pcf nearest variance", .shows = "one texel, the share of lit texels, or a bound from their mean and variance"},
    {.name = "radius", .kind = RUN_NUMBER, .least = 0.5, .most = 16, .initial = {1}, .unit = "texels", .shows = "half the side of the filter's box"},
    {.name = "minimum_variance", .kind = RUN_NUMBER, .least = 0, .most = 1e12, .initial = {1e-4}, .unit = "m2", .shows = "filter=variance: least variance of distances"},
    {.name = "bleeding", .kind = RUN_NUMBER, .least = 0, .most = 0.99, .initial = {0.2}, .shows = "filter=variance: light below this share is taken for bleeding"},
    {.name = "tessellation", .kind = RUN_NUMBER, .least = 0, .most = 64, .initial = {0.5}, .unit = "texels", .shows = "map=paraboloid: how far a straight edge may leave its arc; 0: triangles stay whole"},
    {.name = "ambient", .kind = RUN_NUMBER, .least = 0, .most = 1, .shows = "radiance of an unlit surface, of its albedo; the truth has none"},
    {.name = "visibility_by", .kind = RUN_CHOICE, .choices = "map rays", .shows = "the map, or brute force: one of Embree's rays a pixel"},
    {.name = "reflective_resolution", .kind = RUN_INTEGER, .least = 1, .most = 1024, .initial = {128}, .unit = "texels", .shows = "a side of the reflective map, or of each of its six faces"},
    {.name = "gather", .kind = RUN_CHOICE, .choices = "importance all", .shows = "which texels of the reflective map a pixel reads"},
    {.name = "samples", .kind = RUN_INTEGER, .least = 1, .most = 65536, .initial = {400}, .unit = "texels", .shows = "gather=importance: texels a pixel"},
    {.name = "gather_radius", .kind = RUN_NUMBER, .least = 0.01, .most = 1, .initial = {1}, .shows = "gather=importance: how far samples reach, of the way to the farthest texel"},
    {.name = "pattern", .kind = RUN_CHOICE, .choices = "rotated same", .shows = "gather=importance: a pattern for each pixel (noise) or one for all (bands)"},
    {.name = "sampling", .kind = RUN_CHOICE, .choices = "near printed even", .shows = "gather=importance: texels near the pixel's own place, weighted for that; weighted as the paper prints it (spot, directional); texels drawn evenly"},
    {.name = "falloff", .kind = RUN_CHOICE, .choices = "disc clamp", .shows = "light of a texel near by: a disc of its area, or 1/r^2 held inside `clamp`"},
    {.name = "clamp", .kind = RUN_NUMBER, .least = 0, .most = 1e8, .initial = {0.1}, .unit = "m", .shows = "falloff=clamp: distance"},
    {.name = "trial", .kind = RUN_CHOICE, .choices = "shadow bounce", .shows = "what --sweep and --stability judge"},
    {.name = "show", .kind = RUN_CHOICE, .choices = "light visibility wrong", .shows = "the lit scene, the visibility of one light, or where it is wrong: red dark for lit, blue lit for dark, cyan the same on a triangle that faces away"},
    {.name = NULL},
};
// clang-format on

static const RunStep steps[] = {
    {"depth", "the light's distances to what it sees, near white, far black"},
    {"compare", "shadow where something is nearer to the light, by one texel and no bias"},
    {"bias", "the same with the chosen bias"},
    {"filter", "the same with the chosen filter"},
    {"sun", "the same under a directional light"},
    {"point", "the same under a point light"},
    {"reflective", "the reflective map: the light that each texel's surface passes on"},
    {"bounce", "direct light and one bounce, gathered from the reflective map"},
    {NULL, NULL},
};

// A map's texels are resolution² whatever its shape, so rows of one resolution cost one memory.
#define ROW(name, settings)                                                                                  \
    {                                                                                                        \
        name, NULL, settings, NULL                                                                           \
    }
// One straight border alone, where the order of convergence has a closed form.
#define EDGE(side)                                                                                           \
    {                                                                                                        \
        "spot, one straight border", "plate", "kind=spot filter=nearest resolution=" side, NULL              \
    }
#define SIZES(name, settings)                                                                                \
    ROW(name, settings " filter=nearest resolution=128"),                                                    \
        ROW(name, settings " filter=nearest resolution=256"),                                                \
        ROW(name, settings " filter=nearest resolution=512"),                                                \
        ROW(name, settings " filter=nearest resolution=1024"),                                               \
        ROW(name, settings " filter=nearest resolution=2048"),                                               \
        ROW(name, settings " filter=nearest resolution=4096")
#define BOUNCE(name, settings)                                                                               \
    {                                                                                                        \
        name, "cornell", "trial=bounce " settings, "96x69"                                                   \
    }
#define SAMPLES(name, settings)                                                                              \
    BOUNCE(name, settings " samples=64"), BOUNCE(name, settings " samples=256"),                             \
        BOUNCE(name, settings " samples=1024"), BOUNCE(name, settings " samples=4096")
#define RADII(name, settings)                                                                                \
    BOUNCE(name, settings " gather_radius=0.5"), BOUNCE(name, settings " gather_radius=0.25"),               \
        BOUNCE(name, settings " gather_radius=0.125")
// The same model as the truth's, which is smooth only where no texel shines without bound.
#define HELD(scene, samples)                                                                                 \
    {                                                                                                        \
        "bounce, held", scene, "trial=bounce falloff=clamp clamp=0.5 samples=" samples, "24x17"              \
    }
static const RunRow sweep[] = {
    SIZES("spot", "kind=spot"),
    SIZES("sun, fitted to the view", "kind=directional fit=view"),
    SIZES("sun, fitted to the scene", "kind=directional fit=scene"),
    SIZES("cube", "kind=point map=cube"),
    SIZES("paraboloid", "kind=point map=paraboloid"),
    EDGE("128"),
    EDGE("256"),
    EDGE("512"),
    EDGE("1024"),
    EDGE("2048"),
    ROW("bias none", "kind=spot filter=nearest bias=none"),
    ROW("bias constant", "kind=spot filter=nearest bias=constant bias_constant=0.002"),
    ROW("bias constant", "kind=spot filter=nearest bias=constant bias_constant=0.02"),
    ROW("bias constant", "kind=spot filter=nearest bias=constant bias_constant=0.2"),
    ROW("bias slope", "kind=spot filter=nearest bias=slope bias_slope=0.5"),
    ROW("bias slope", "kind=spot filter=nearest bias=slope bias_slope=1"),
    ROW("bias slope", "kind=spot filter=nearest bias=slope bias_slope=4"),
    ROW("bias normal", "kind=spot filter=nearest bias=normal bias_normal=0.5"),
    ROW("bias normal", "kind=spot filter=nearest bias=normal bias_normal=1"),
    ROW("bias normal", "kind=spot filter=nearest bias=normal bias_normal=4"),
    ROW("pcf", "kind=spot filter=pcf radius=0.5"),
    ROW("pcf", "kind=spot filter=pcf radius=1"),
    ROW("pcf", "kind=spot filter=pcf radius=2"),
    ROW("pcf", "kind=spot filter=pcf radius=4"),
    ROW("variance", "kind=spot filter=variance radius=1"),
    ROW("variance", "kind=spot filter=variance radius=2"),
    ROW("variance", "kind=spot filter=variance radius=4"),
    ROW("variance, bleeding kept", "kind=spot filter=variance radius=2 bleeding=0"),
    ROW("variance, no minimum", "kind=spot filter=variance radius=2 minimum_variance=0"),
    ROW("paraboloid, edges", "kind=point map=paraboloid filter=nearest tessellation=0"),
    ROW("paraboloid, edges", "kind=point map=paraboloid filter=nearest tessellation=4"),
    ROW("paraboloid, edges", "kind=point map=paraboloid filter=nearest tessellation=1"),
    ROW("paraboloid, edges", "kind=point map=paraboloid filter=nearest tessellation=0.25"),
    ROW("rays", "kind=spot visibility_by=rays"),
    ROW("rays", "kind=point visibility_by=rays"),
    BOUNCE("bounce, all texels", "gather=all reflective_resolution=16"),
    BOUNCE("bounce, all texels", "gather=all reflective_resolution=32"),
    BOUNCE("bounce, all texels", "gather=all reflective_resolution=64"),
    SAMPLES("bounce, near", "reflective_resolution=64"),
    SAMPLES("bounce, even", "reflective_resolution=64 sampling=even"),
    SAMPLES("bounce, spot, near", "kind=spot"),
    SAMPLES("bounce, spot, even", "kind=spot sampling=even"),
    SAMPLES("bounce, spot, as printed", "kind=spot sampling=printed"),
    RADII("bounce, radius", "reflective_resolution=32 samples=1024"),
    RADII("bounce, spot, radius", "kind=spot samples=1024"),
    {"bounce, near", "fence", "trial=bounce reflective_resolution=64 samples=256", "96x69"},
    HELD("cornell", "16"),
    HELD("cornell", "64"),
    HELD("cornell", "256"),
    HELD("cornell", "1024"),
    HELD("cornell", "4096"),
    HELD("fence", "16"),
    HELD("fence", "64"),
    HELD("fence", "256"),
    HELD("fence", "1024"),
    HELD("fence", "4096"),
    {NULL, NULL, NULL, NULL},
};

// Each case's scene is made in shadow_scenes.c, which also knows its closed forms. 96² pixels are enough to see a border move by one.
#define CASE(name, scene, settings)                                                                          \
    {                                                                                                        \
        name, scene, settings, "96x96"                                                                       \
    }
#define BOUNCED(name, scene, settings)                                                                       \
    {                                                                                                        \
        name, scene, "trial=bounce samples=400 " settings, "48x35"                                           \
    }
static const RunRow stability[] = {
    CASE("plate, spot", "plate", "resolution=2048 filter=nearest"),
    CASE("plate, sun", "plate", "kind=directional resolution=2048 filter=nearest"),
    CASE("plate, cube", "plate", "kind=point resolution=4096 filter=nearest"),
    CASE("plate, paraboloid", "plate", "kind=point map=paraboloid resolution=4096 filter=nearest"),
    CASE("plate, normal offset", "plate", "resolution=2048 filter=nearest bias=normal"),
    CASE("plate, variance", "plate", "resolution=2048 filter=variance"),
    CASE("off a wall, cube", "wall", "resolution=2048"),
    CASE("off a wall, paraboloid", "wall", "map=paraboloid resolution=2048"),
    CASE("off a wall, normal offset", "wall", "bias=normal filter=nearest resolution=2048"),
    CASE("grazing", "grazing", "filter=nearest"),
    CASE("decades", "decades", "resolution=2048 filter=nearest"),
    CASE("decades, cube", "decades", "kind=point resolution=4096 filter=nearest"),
    CASE("huge", "huge", "resolution=2048"),
    CASE("huge, cube", "huge", "kind=point resolution=2048"),
    CASE("tiny", "tiny", "resolution=2048"),
    CASE("inside", "inside", "resolution=1024"),
    CASE("inside, paraboloid", "inside", "map=paraboloid resolution=1024"),
    CASE("empty", "empty", ""),
    CASE("one texel", "plate", "resolution=1 filter=nearest bias=none"),
    CASE("behind the light", "behind", "resolution=1024"),
    CASE("slivers", "slivers", "kind=spot resolution=4096 filter=nearest"),
    CASE("ties", "ties", "resolution=1024"),
    CASE("ties, normal offset", "ties", "bias=normal resolution=1024"),
    CASE("cube edge", "edge", "resolution=512 filter=pcf radius=2"),
    CASE("cube corner", "corner", "resolution=512 filter=pcf radius=2"),
    CASE("cube corner, variance", "corner", "resolution=512 filter=variance radius=2"),
    CASE("paraboloid border", "edge", "map=paraboloid resolution=512 filter=pcf radius=2"),
    BOUNCED("bounce, room", "room", "reflective_resolution=64"),
    BOUNCED("bounce, tiny", "tiny_room", "reflective_resolution=64"),
    BOUNCED("bounce, giant", "giant_room", "reflective_resolution=64"),
    BOUNCED("bounce, one texel", "room", "reflective_resolution=1"),
    BOUNCED("bounce, empty", "empty", "reflective_resolution=16"),
    {NULL, NULL, NULL, NULL},
};

const RunAbout shadow_about = {
    .chapter = "02_shadow_maps",
    .title = "Shadow maps",
    .shows =
        "which surfaces a light reaches, answered from a map of distances, and where that answer is wrong",
    .source = "Williams 1978; Gomes 2015, section 2.2; Brabec, Annen and Seidel 2002; Donnelly and Lauritzen "
              "2006; Dachsbacher and "
              "Stamminger 2005",
    .uses = RUN_USES_CAMERA | RUN_USES_LIGHT | RUN_USES_DEFORM,
    .scenes = scenes,
    .own_scenes = shadow_scenes,
    .parameters = parameters,
    .steps = steps,
    .sweep = sweep,
    .stability = stability,
};
