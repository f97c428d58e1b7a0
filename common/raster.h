// raster: the passes that many chapters start from: depth maps of every kind of light, the G-buffer, the full screen.
#ifndef RASTER_H
#define RASTER_H

#include "gl.h"
#include "image.h"
#include "scene.h"
#include "shader.h"

// A scene's triangles on the GPU. Vertex attributes: location 0 position, 1 normal. The same data can be read as SSBOs:
// positions (3 floats a vertex), indices (3 uints a triangle), triangle materials (1 uint), materials (2 vec4: albedo, emission).
typedef struct RasterMesh {
    GLuint vertex_array;
    GLuint positions, normals, indices, triangle_materials, materials;
    GLsizei index_count; // 0 for the empty scene: draws do nothing
} RasterMesh;
RasterMesh raster_mesh(const Scene *scene);
void raster_mesh_delete(RasterMesh *mesh);
// Draw with the current program.
void raster_draw(const RasterMesh *mesh);

// The passes' own shaders and the empty vertex array of the full-screen triangle. Every pass sets the state that it needs and leaves
// depth test, blending and face culling off, clip control at its default.
typedef struct Raster Raster;
Raster *raster_open(void);
void raster_close(Raster *raster); // NULL is allowed

// The distance of the first surface along each light ray. spot: 2D, perspective, the cone's circle fills the square; directional: 2D, orthographic, fitted
// to the scene's box (and, where a camera is given, to what of the box it can see; what lies between there and the light still casts); point, and
// spots wider than 80° half angle: cube, six layers in one pass. Stored as GL_R32F in metres: from the light (point, spot: Euclidean) or along
// the light's way from the plane through `origin` (directional); +Inf where nothing is hit. Surfaces nearer to a point or spot
// light than 10⁻¹¹ of the scene's diagonal are lost; nothing else is. It is read by imageLoad (the fast way here) through shaders/common/shadow.glsl.
// Positions are always relative to `origin`, so that a scene far from the world's origin loses nothing.
typedef struct DepthMap {
    LightKind kind; // LIGHT_POINT: `distance` is a 2D array of 6 layers in GL's cube face order, else 2D
    int resolution; // texels a side
    GLuint distance, framebuffer;
    vec3 origin;         // the light (point, spot), or a point before the whole scene (directional)
    mat4 to_clip;        // spot, directional: clip = to_clip · (position − origin, 1)
    float near_distance; // metres along the axis (point, spot)
    float texel_size;    // metres a texel covers, 1 m along the axis (point, spot) or anywhere (directional)
} DepthMap;
DepthMap raster_depth_map(const Scene *scene, const Light *light, int resolution, const Camera *fit_to,
                          float aspect);
// The same map, which keeps its memory, for a light or camera that has moved.
void raster_depth_map_aim(DepthMap *map, const Scene *scene, const Light *light, const Camera *fit_to,
                          float aspect);
bool raster_depth_map_is_cube(const Light *light);
void raster_depth_map_delete(DepthMap *map);
void raster_depth_map_draw(const Raster *raster, const DepthMap *map, const Light *light,
                           const RasterMesh *mesh);

// The surfaces that a light reaches first, each texel a small light of its own (Dachsbacher and Stamminger, "Reflective shadow maps", 2005,
// section 3). Framed as raster_depth_map without a camera, since what the camera does not see lights what it sees; `depth` is that depth
// map, drawn in the same pass, so that raster_light_add and shaders/common/shadow.glsl take it. Texels without a surface are 0 (distance: +Inf).
// Summed over all texels, flux is what the surfaces reflect: 4π·I·ρ (point, all of whose rays hit), 2π(1 − cos)·I·ρ (spot, up to the texels
// that the cone's border crosses: a texel counts where its centre is inside), E·area·ρ (directional, area across the light).
typedef struct ReflectiveMap {
    DepthMap depth;
    GLuint
        position;  // RGBA32F: metres from depth.origin; w: m² of surface in the texel, 0 where there is none
    GLuint normal; // RGBA16F: unit, on the side that is lit
    // RGBA32F: reflected by the surface in W, a colour channel each: I · solid angle of the texel · albedo, inside the light's
    // radius r0 times (d/r0)²; directional: irradiance · area of the texel across the light · albedo
    GLuint flux;
    GLuint nearest, framebuffer; // the pass's own: a depth buffer
} ReflectiveMap;
ReflectiveMap raster_reflective_map(const Scene *scene, const Light *light, int resolution);
void raster_reflective_map_delete(ReflectiveMap *map);
void raster_reflective_map_draw(const Raster *raster, const ReflectiveMap *map, const Light *light,
                                const RasterMesh *mesh);

// What the camera sees, a texel a pixel: distance along the ray in metres (R32F, +Inf for the sky), world normal on the side that is seen
// (RGBA16F, unit length), albedo (RGBA16F: 8 bits would be 4 % wrong at 0.05), emission (RGBA16F), triangle number + 1 (R32UI); 0 for the sky. Nothing
// nearer than the camera's near distance is drawn; its far distance cuts nothing off.
typedef struct GBuffer {
    int width, height;
    GLuint distance, normal, albedo, emission, triangle, depth, framebuffer;
} GBuffer;
GBuffer raster_gbuffer(int width, int height);
void raster_gbuffer_delete(GBuffer *gbuffer);
void raster_gbuffer_draw(const Raster *raster, const GBuffer *gbuffer, const Camera *camera,
                         const RasterMesh *mesh);

// Direct light of one light through its depth map on the G-buffer, added to an RGBA32F picture of its size: albedo/π · irradiance, point and spot
// I·cosθ/max(d, r0)². `raster_light_begin` sets it to emission + ambient·albedo, alpha 1 (sky: black).
void raster_light_begin(const Raster *raster, const GBuffer *gbuffer, GLuint picture, float ambient);
void raster_light_add(const Raster *raster, const GBuffer *gbuffer, const Camera *camera, const Light *light,
                      const DepthMap *map, GLuint picture);

// Run the shader once a pixel of `framebuffer` (0: the window): its vertex stage is common/fullscreen.vert.
void raster_fullscreen(const Raster *raster, const Shader *shader, GLuint framebuffer, int width, int height);
// Set the uniforms eye, ray_lower_left, ray_right, ray_up that shaders/common/camera.glsl reads: the ray through picture
// position (u, v) in [0,1]², v up, is normalize(ray_lower_left + u·ray_right + v·ray_up).
void raster_set_camera(const Shader *shader, const Camera *camera, float aspect);
// Set light_direction, light_intensity, light_radius, and light_cone as shadow_in_cone of shaders/common/shadow.glsl takes it.
void raster_set_light(const Shader *shader, const Light *light);

// An RGBA32F picture that can be drawn into and cleared (to 0).
typedef struct RasterTarget {
    GLuint texture, framebuffer;
} RasterTarget;
RasterTarget raster_target_open(const char *label, int width, int height);
void raster_target_close(RasterTarget *target);
void raster_target_clear(const RasterTarget *target);
// Top row first, 4 channels; the caller frees it.
Image raster_target_read(const RasterTarget *target, int width, int height);

// What techniques start from: the scene's triangles, what the camera sees, and a depth map of the whole scene for each light. Keeps raster and scene.
typedef struct RasterView {
    const Raster *raster;
    const Scene *scene;
    RasterMesh mesh;
    GBuffer gbuffer;
    DepthMap *maps; // one a light
} RasterView;
RasterView raster_view_open(const Raster *raster, const Scene *scene, int width, int height,
                            int map_resolution);
void raster_view_close(RasterView *view);
void raster_view_draw_maps(const RasterView *view); // of the lights where they are now
// That without drawing: techniques ask a map where its light is, even where nothing can cast a shadow and the map is left out.
void raster_view_aim(const RasterView *view);

// Whether anything can cast a shadow into what the camera sees, its air included: false where the shadow of the scene's box is certain to miss the view.
bool raster_can_shadow(const Scene *scene, const Light *light, const Camera *camera, float aspect);

#endif
