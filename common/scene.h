// scene: meshes, materials, lights, cameras, media; import and validation through Assimp's C API; the scenes that two chapters use.
//
// Units: metres; radiant intensity W/sr (point, spot), irradiance W/m² (directional); extinction 1/m. Linear colour. y is up.
#ifndef SCENE_H
#define SCENE_H

#include "base.h"
#include "linear.h"

// One triangle soup with shared vertices. Counter-clockwise triangles face outwards; normals are unit length.
typedef struct Mesh {
    size_t vertex_count, triangle_count;
    float *positions;            // 3 a vertex, metres
    float *normals;              // 3 a vertex
    uint32_t *indices;           // 3 a triangle
    uint32_t *triangle_material; // 1 a triangle, index into Scene.materials
    size_t vertex_capacity, triangle_capacity;
} Mesh;

typedef struct Material {
    char *name;
    vec3 albedo;   // diffuse reflectance, 0..1
    vec3 emission; // radiance, W/(sr·m²)
} Material;

typedef enum LightKind { LIGHT_POINT, LIGHT_SPOT, LIGHT_DIRECTIONAL } LightKind;

typedef struct Light {
    LightKind kind;
    vec3 position;        // point, spot
    vec3 direction;       // spot, directional: the way that light travels, unit
    vec3 intensity;       // point, spot: W/sr; directional: irradiance W/m² on a surface that faces it
    float half_angle_rad; // spot: axis to border; uniform inside
    float radius;         // r0: the inverse square is held inside it, I / max(d, r0)²
} Light;

// Homogeneous participating medium: coefficients in 1/m, Henyey-Greenstein mean cosine g.
typedef struct Medium {
    vec3 scattering, absorption;
    float mean_cosine;
} Medium;

// What validation found and did (scene_validate's rule).
typedef struct SceneReport {
    size_t nonfinite_vertices, bad_indices; // refused where above zero
    size_t zero_area_triangles;             // dropped
    size_t repaired_normals;                // missing, zero or not finite: replaced by the triangle's own
    size_t other_primitives;                // points and lines of a file: dropped
} SceneReport;

typedef struct Scene {
    char *name; // built-in name or file
    Mesh mesh;
    Material *materials;
    size_t material_count;
    Light *lights;
    size_t light_count;
    Camera camera;
    Medium medium;
    vec3 lower, upper; // bounding box of the triangles; both 0 for the empty scene
    SceneReport report;
} Scene;

// A built-in scene by name, or a model file (a path with a '.' or '/'); a glTF's own camera and punctual lights are honoured. `seed`
// draws what is random in procedural scenes. Wrong name: request error that lists the names. Missing, broken, refused file: work error.
Scene *scene_open(const char *name_or_file, uint64_t seed);
void scene_close(Scene *scene); // NULL is allowed

// The built-in scenes, in order; a NULL name ends the list. `make` adds triangles, lights and camera to an empty scene.
typedef struct SceneKind {
    const char *name, *shows;
    void (*make)(Scene *scene, uint64_t seed);
} SceneKind;
extern const SceneKind scene_kinds[];
// A scene that one chapter makes for itself goes through the same completion and validation.
Scene *scene_from(const SceneKind *kind, uint64_t seed);

// The rule: a vertex that is NaN or Inf, or an index past the last vertex, refuses the scene (the data is broken); zero-area triangles are
// dropped and counted; a file with no triangle left is refused, a built-in scene may be empty. Returns NULL, or (in new memory) one line
// that says why the scene is refused. Fills report, lower and upper.
char *scene_validate(Scene *scene, bool may_be_empty);
// One line for people: what validation dropped or repaired; NULL where nothing was.
char *scene_report_text(const Scene *scene);

// Building blocks of the generators. Normals of 0 length are filled in from the triangle by validation.
uint32_t scene_add_material(Scene *scene, const char *name, vec3 albedo, vec3 emission);
uint32_t mesh_add_vertex(Mesh *mesh, vec3 position, vec3 normal);
void mesh_add_triangle(Mesh *mesh, uint32_t a, uint32_t b, uint32_t c, uint32_t material);
void mesh_add_quad(Mesh *mesh, vec3 corner, vec3 edge_u, vec3 edge_v, uint32_t material); // faces u × v
void mesh_add_box(Mesh *mesh, vec3 lower, vec3 upper, uint32_t material);
// A number for each vertex, the same for the same place and in the places' own order: a mesh repeats a vertex for each normal that it has there. New memory.
uint32_t *mesh_places(const Mesh *mesh);
// Edges that do not belong to an even number of triangles, which are 3 of those numbers each: 0 for a closed mesh.
size_t mesh_odd_edges(const uint32_t *corners, size_t triangle_count);
void scene_add_light(Scene *scene, Light light);
// Look at the whole scene from `direction` (towards the eye) with this field of view.
void scene_aim_camera(Scene *scene, vec3 direction, float vertical_fov_rad);

// Where voxels lie: voxel (x, y, z) is the closed box from origin + (x, y, z)·voxel_size to origin + (x+1, y+1, z+1)·voxel_size. origin and
// voxel_size are float32 values held in double, so that every voxel face is exact in double.
typedef struct VoxelGrid {
    double origin[3];  // metres
    double voxel_size; // metres
    int size[3];       // voxels
} VoxelGrid;
// Cubic voxels, `resolution` of them along the longest side of the scene's box, as many as needed along the others (at least 1).
VoxelGrid scene_grid(const Scene *scene, int resolution);
size_t grid_voxels(const VoxelGrid *grid);
// One bit a voxel, x fastest, rows not padded: voxel (x, y, z) is bit i & 31 of word i >> 5, i = (z·size[1] + y)·size[0] + x.
size_t grid_words(const VoxelGrid *grid);

#endif
