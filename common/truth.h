// truth: what pictures and grids are judged by. It shares no code with any technique: Embree for rays and the light that they carry,
// separating axes in double for voxels.
#ifndef TRUTH_H
#define TRUTH_H

#include "image.h"
#include "linear.h"
#include "scene.h"

// Rays against triangles (Embree, robust mode). Vertices are the mesh's own float32 values.
typedef struct Truth Truth;
typedef struct TruthHit {
    float distance; // metres along the unit direction; +Inf: nothing was hit
    uint32_t triangle;
    vec3 normal; // geometric, unit, as the triangle winds
} TruthHit;
Truth *truth_open(const Mesh *mesh); // copies what it needs; the mesh may be empty
void truth_close(Truth *truth);      // NULL is allowed
// `direction` is unit. Nothing is left out near the origin: a ray that starts on a triangle may hit it.
TruthHit truth_ray(const Truth *truth, vec3 origin, vec3 direction);
// Whether a triangle crosses the open segment. So that its ends may be float32 points of surfaces, the larger of 2^-16 of its length
// and 2^-21 of the largest coordinate of either end (4 units in its last place) is left out at both ends.
bool truth_occluded(const Truth *truth, vec3 from, vec3 to);
// The same for `count` segments on all cores: segment i is bit i & 31 of word i >> 5, in new memory.
uint32_t *truth_occluded_many(const Truth *truth, const vec3 *from, const vec3 *to, size_t count);

// Light by path tracing (Kajiya 1986). The model, the same as that of the G-buffer and raster_light_add:
//   A surface reflects diffusely and emits on both sides. Its normal is the interpolated one of its vertices, turned to the side that is
//   seen; light counts where it comes from the seen side of the triangle itself and of that normal. Radiance = emission + albedo/π · E.
//   Point and spot lights give E = I cos / max(d, r0)², a spot inside its cone alone; a directional light gives its irradiance times
//   cos. All cast shadows, by truth_occluded's margins. Emissive triangles light what they see. There is no medium; outside is black.
// Random numbers are a hash of (seed, pixel or point, sample, number of the draw): the result does not depend on the number of threads.
enum { TRUTH_FULL = -1 }; // bounces: all of them, unbiased (Russian roulette; Arvo and Kirk 1990)

// How emissive triangles are found. All three have the same mean, so that one can be asked about another.
typedef enum TruthEmitters {
    TRUTH_EMITTERS_BOTH, // both below, weighted by the balance heuristic (Veach and Guibas 1995): the least noise
    TRUTH_EMITTERS_BY_AREA,      // points of the triangles alone, by area and emission
    TRUTH_EMITTERS_BY_DIRECTION, // directions from the seen surface alone, by the cosine
} TruthEmitters;

// Where the one bounce of bounces = 1 comes from. The second and third send rays from the point, spot and directional lights, uniform over
// the light's directions (a disc that covers the scene for a directional light). Where a ray meets the first surface y, its flux Φ
// is reflected on the side that it arrives on alone; it gives the seen point x the irradiance
//   albedo_y · Φ/π · max(0, cos_y) · max(0, cos_x) / max(|x − y|, least_distance)²,
// cosines with the interpolated normals. That is the reflective shadow map's own model (Dachsbacher and Stamminger 2005, section 3: every
// texel a small diffuse lamp) at endless resolution. Light of emissive triangles does not bounce in it. Flux knows the triangle's own
// slope only, so paths agree with TRUTH_BOUNCE_OF_FLUX where vertices carry the triangles' own normals and least_distance is 0.
typedef enum TruthBounce {
    TRUTH_BOUNCE_OF_PATHS,           // from the seen surface, any number of bounces
    TRUTH_BOUNCE_OF_FLUX,            // from the lights, with a shadow ray between y and x
    TRUTH_BOUNCE_OF_FLUX_UNOCCLUDED, // from the lights, nothing between y and x casts a shadow
} TruthBounce;

typedef struct TruthPathSettings {
    int samples; // a pixel or point; at least 1
    int bounces; // indirect ones: light is reflected at most bounces + 1 times; 0: direct light; TRUTH_FULL
    bool indirect_alone;  // leave out emission that is seen and direct light
    TruthBounce bounce;   // the two from lights ask for bounces = 1
    float least_distance; // metres, for those two; 0: none
    TruthEmitters emitters;
    uint64_t seed;
    int threads; // 0: all cores
} TruthPathSettings;

// Mean of the samples and its standard error (of one sample alone: 0), three channels. Of samples that seldom meet what is bright the
// error is itself an estimate.
typedef struct TruthPicture {
    Image mean, error;
} TruthPicture;
// Radiance through the middle of every pixel, W/(sr·m²); surfaces before the camera's near distance are not seen. `truth` is of
// scene->mesh. Settings that make no sense end the program (a wrong request).
TruthPicture truth_radiance(const Truth *truth, const Scene *scene, const Camera *camera, int width,
                            int height, const TruthPathSettings *settings);
void truth_picture_free(TruthPicture *picture);

typedef struct TruthIrradiance {
    double mean[3], error[3]; // W/m²
} TruthIrradiance;
// Irradiance at a point on the side of its unit normal. Without `indirect_alone` it holds direct light.
TruthIrradiance truth_irradiance(const Truth *truth, const Scene *scene, vec3 point, vec3 normal,
                                 const TruthPathSettings *settings);

// The closed box of every voxel against every triangle that may touch it, by the 13 separating axes in double (Akenine-Möller 2001).
// Bits as grid_words says, in new memory. Triangles that touch in a point, an edge or a face count.
uint32_t *truth_voxels(const Mesh *mesh, const VoxelGrid *grid);
// The signed gap of one triangle and one voxel in voxels: the largest over the 13 axes (unit length) of the distance between the two
// projections; at most 0 exactly where truth_voxels sets the voxel. Its rounding error is below truth_gap_bound of a mesh with that
// triangle, in voxels; the proof is in truth_voxels.c. Infinite where a triangle's plane is lost to rounding.
double truth_voxel_gap(const float triangle[9], const VoxelGrid *grid, const int voxel[3]);
double truth_gap_bound(const Mesh *mesh, const VoxelGrid *grid);

// The boxes of set voxels as a mesh (outer faces only), for a picture of voxels by Embree that shares nothing with a grid walk.
// Normals point out of the voxel; a triangle's material is the number i of its voxel (see grid_words), so that a picture can colour by voxel.
// Four float32 vertices a face, equal where faces meet. Ends the program where voxels or vertices are more than 2^32 − 1.
Mesh truth_voxel_mesh(const uint32_t *voxels, const VoxelGrid *grid);

// Which stretches of a ray a light reaches, in double and exactly: every triangle that cuts the plane of ray and light throws its shadow on the
// ray, so no stretch is missed, however short. Spans are [t0, t1] in metres along the unit direction, in order, within [0, length] (which may be
// infinite) and a spot's cone; new memory. A light on the ray's line (nearer than 1e-12 of its distance) is shadowed by Embree's hits along it.
typedef struct TruthShadows TruthShadows;
typedef struct TruthSpan {
    double t0, t1;
} TruthSpan;
TruthShadows *truth_shadows_open(const Mesh *mesh,
                                 const Truth *truth); // keeps truth; copies what it needs of the mesh
void truth_shadows_close(TruthShadows *shadows);      // NULL is allowed
TruthSpan *truth_lit_spans(const TruthShadows *shadows, const Light *light, const double origin[3],
                           const double direction[3], double length, size_t *count);

// How a medium's particles share out what they scatter, by name: uniform, rayleigh, henyey_greenstein, hoffman_preetham (as printed),
// hoffman_preetham_normalized; 1/sr of cosθ.
typedef struct TruthPhase {
    const char *name;
    double mean_cosine, rayleigh_share;
} TruthPhase;
double truth_phase(const TruthPhase *phase, double cosine);

// Single scattering along [from, to] (which may be infinite) of a ray, lit throughout, for σs = 1 and intensity or irradiance 1, by GSL's adaptive
// quadrature in double, to 1e-9 of itself. `nearest`: the light's distance from the ray's line; `foot`: where along it; radius: r0.
double truth_airlight_point(double nearest, double foot, double radius, double from, double to, double sigma,
                            const TruthPhase *phase);
// The radiance that the scene's lights and medium scatter into the ray [0, length], W/(sr·m²).
void truth_airlight(const TruthShadows *shadows, const Scene *scene, const TruthPhase *phase,
                    const double origin[3], const double direction[3], double length, double radiance[3]);

// The scene's picture through its medium: that radiance, and with ambient >= 0 the surfaces behind it (their emission and ambient light, W/(sr·m²) times albedo,
// and the lights' direct light, dimmed on both legs). Kept under out/truth. Top row first, 4 channels. Of every n-th pixel along both sides alone, from the
// first, which have the same rays as in the whole picture (image_every takes the same pixels of another); 1: all.
Image truth_airlight_picture(const Scene *scene, const Camera *camera, int width, int height, int every,
                             const TruthPhase *phase, float ambient);
// truth_airlight_picture, drawn anew by so many threads (0: one a core).
Image truth_airlight_draw(const Scene *scene, const Camera *camera, int width, int height, int every,
                          const TruthPhase *phase, float ambient, int threads);
// Every which pixel tables of errors ask of a picture so high, so that the truth takes as long for a large one: all up to 511 rows, then some 256 rows.
int truth_every(int height);

// For every pixel's ray, the spans that truth_lit_spans gives up to a thousandth behind the first surface, in new memory, one ray after the other: of pixel
// x + width · y, y upwards, spans[first[i]] up to spans[first[i + 1]]. `first` has width · height + 1 items.
TruthSpan *truth_lit_picture(const Scene *scene, const Light *light, const Camera *camera, int width,
                             int height, uint32_t *first);

// Cache under out/truth: the path of the file for this key. The key also holds a hash of truth's own source, so that a changed truth
// is computed anew. `inputs` hashes everything that the picture depends on (hash_bytes).
char *truth_cache_path(const char *what, uint64_t inputs, const char *ending); // caller frees; folder is made
uint64_t truth_hash_scene(const Scene *scene);

#endif
