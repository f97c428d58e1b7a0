// raster: the passes that many chapters start from: depth maps of every kind of light, the G-buffer, the full screen.
#ifndef RASTER_H
#define RASTER_H

#include "gl.h"
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

// The depth of the first surface along each light ray. spot: 2D, perspective; directional: 2D, orthographic, fitted to the scene's box (and, where
// a camera is given, to what of it the camera can see); point: cube, six layers in one pass. Depth is stored as GL_R32F: distance
// from the light in metres (spot, point: Euclidean; directional: along its way from the map's plane), +Inf where nothing is hit.
// It is read by imageLoad (the fast way here) through shaders/common/shadow.glsl.
typedef struct DepthMap {
    LightKind kind;
    int resolution;             // texels a side
    GLuint distance, depth, framebuffer;
    mat4 world_to_clip[6];      // 1, or 6 for a point light in GL's cube face order
} DepthMap;
DepthMap raster_depth_map(const Scene *scene, const Light *light, int resolution, const Camera *fit_to, float aspect);
void raster_depth_map_delete(DepthMap *map);
// The passes' own shaders.
typedef struct Raster Raster;
Raster *raster_open(void);
void raster_close(Raster *raster);
void raster_depth_map_draw(const Raster *raster, const DepthMap *map, const Light *light, const RasterMesh *mesh);

// What the camera sees, a texel a pixel: distance along the ray in metres (R32F, +Inf for the sky), world normal (RGBA16F), albedo (RGBA8),
// emission (RGBA16F), triangle number + 1 (R32UI, 0 for the sky).
typedef struct GBuffer {
    int width, height;
    GLuint distance, normal, albedo, emission, triangle, depth, framebuffer;
} GBuffer;
GBuffer raster_gbuffer(int width, int height);
void raster_gbuffer_delete(GBuffer *gbuffer);
void raster_gbuffer_draw(const Raster *raster, const GBuffer *gbuffer, const Camera *camera, const RasterMesh *mesh);

// Direct light of one light through its depth map on the G-buffer, added to an RGBA32F picture: `raster_light_begin` clears it to emission + ambient·albedo.
void raster_light_begin(const Raster *raster, const GBuffer *gbuffer, GLuint picture, float ambient);
void raster_light_add(const Raster *raster, const GBuffer *gbuffer, const Camera *camera, const Light *light, const DepthMap *map, GLuint picture);

// Run the shader once a pixel of `framebuffer` (0: the window): its vertex stage is common/fullscreen.vert.
void raster_fullscreen(const Shader *shader, GLuint framebuffer, int width, int height);
// Set the uniforms eye, ray_lower_left, ray_right, ray_up that shaders/common/camera.glsl reads: the ray through picture
// position (u, v) in [0,1]², v up, is normalize(ray_lower_left + u·ray_right + v·ray_up).
void raster_set_camera(const Shader *shader, const Camera *camera, float aspect);

#endif
