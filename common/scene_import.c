// scene_import: model files through Assimp 5.2's C API. Validation is scene_validate's: Assimp's FindDegenerates and FindInvalidData would
// drop or repair without a count. One thing it drops before anybody can count: a glTF's triangles whose index is past the end.
#include "scene_builtin.h"

#include <assimp/cimport.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

static vec3 vec3_from(struct aiVector3D v)
{
    return vec3_make(v.x, v.y, v.z);
}

static vec3 vector_by(const struct aiMatrix4x4 *m, struct aiVector3D v)
{
    return vec3_make(m->a1 * v.x + m->a2 * v.y + m->a3 * v.z, m->b1 * v.x + m->b2 * v.y + m->b3 * v.z,
                     m->c1 * v.x + m->c2 * v.y + m->c3 * v.z);
}

static vec3 point_by(const struct aiMatrix4x4 *m, struct aiVector3D p)
{
    return vector_by(m, p) + vec3_make(m->a4, m->b4, m->c4);
}

static void add_mesh(Scene *scene, const struct aiMesh *source, const struct aiMatrix4x4 *m)
{
    // Normals go by the cofactors: det · inverse transposed, right for any scale; a mirror (det < 0) turns them and the winding.
    const vec3 rows[3] = {vec3_make(m->a1, m->a2, m->a3), vec3_make(m->b1, m->b2, m->b3),
                          vec3_make(m->c1, m->c2, m->c3)};
    vec3 cofactors[3];
    for (int i = 0; i < 3; i++)
        cofactors[i] = vec3_cross(rows[(i + 1) % 3], rows[(i + 2) % 3]);
    const bool mirrored = vec3_dot(rows[0], cofactors[0]) < 0;
    const size_t first = scene->mesh.vertex_count;
    for (unsigned i = 0; i < source->mNumVertices; i++) {
        const vec3 given = source->mNormals ? vec3_from(source->mNormals[i]) : vec3_make(0, 0, 0);
        const vec3 normal = vec3_make(vec3_dot(cofactors[0], given), vec3_dot(cofactors[1], given),
                                      vec3_dot(cofactors[2], given));
        mesh_add_vertex(&scene->mesh, point_by(m, source->mVertices[i]), mirrored ? -normal : normal);
    }
    for (unsigned i = 0; i < source->mNumFaces; i++) {
        const struct aiFace *face = &source->mFaces[i];
        if (face->mNumIndices == 3) {
            const uint32_t *index = face->mIndices, base = (uint32_t)first;
            mesh_add_triangle(&scene->mesh, base + index[0], base + index[mirrored ? 2 : 1],
                              base + index[mirrored ? 1 : 2], source->mMaterialIndex);
        } else if (source->mPrimitiveTypes & (aiPrimitiveType_POINT | aiPrimitiveType_LINE)) {
            scene->report.other_primitives++;
        } else { // an OBJ's face line that ends early: a polygon by its kind, but of two corners
            fail_work("%s: broken: a face has %u corners; is the file cut short?", scene->name,
                      face->mNumIndices);
        }
    }
}

static void add_light(Scene *scene, const struct aiLight *source, const struct aiMatrix4x4 *m)
{
    const vec3 intensity =
        vec3_make(source->mColorDiffuse.r, source->mColorDiffuse.g, source->mColorDiffuse.b);
    Light light = {.position = point_by(m, source->mPosition),
                   .direction = vector_by(m, source->mDirection),
                   .intensity = intensity, // colour times candela (or lux), taken as W/sr (or W/m²)
                   .half_angle_rad = source->mAngleOuterCone};
    if (source->mType != aiLightSource_POINT && source->mType != aiLightSource_SPOT &&
        source->mType != aiLightSource_DIRECTIONAL) {
        note("%s: light '%s' is no point, spot or directional light and is left out", scene->name,
             source->mName.data);
        return;
    }
    light.kind = source->mType == aiLightSource_POINT  ? LIGHT_POINT
                 : source->mType == aiLightSource_SPOT ? LIGHT_SPOT
                                                       : LIGHT_DIRECTIONAL;
    if (!vec3_is_finite(light.position) || !vec3_is_finite(light.direction) || !vec3_is_finite(intensity))
        fail_work("%s: refused: light '%s' is NaN or infinite", scene->name, source->mName.data);
    scene_add_light(scene, light);
}

static void set_camera(Scene *scene, const struct aiCamera *source, const struct aiMatrix4x4 *m)
{
    // Assimp 5.2 hands a glTF's yfov on times the aspect ratio, where the file has one, as mHorizontalFOV, and repeats its node's
    // translation in mPosition: the node's origin is where the camera stands.
    const float aspect = source->mAspect > 0 ? source->mAspect : 1;
    const float fov = source->mHorizontalFOV / aspect;
    const vec3 eye = vec3_make(m->a4, m->b4, m->c4), ahead = vec3_normalize(vector_by(m, source->mLookAt));
    if (scene->camera.vertical_fov_rad > 0 || !(fov > 0 && fov < 3.14159f) || !vec3_is_finite(eye + ahead))
        return; // the first with a perspective counts
    scene->camera = (Camera){eye, eye + ahead, vec3_normalize(vector_by(m, source->mUp)), fov, 0, 0};
    scene->camera.near_distance = source->mClipPlaneNear;
}

static void add_node(Scene *scene, const struct aiScene *file, const struct aiNode *node,
                     const struct aiMatrix4x4 *parent)
{
    struct aiMatrix4x4 m = *parent;
    aiMultiplyMatrix4(&m, &node->mTransformation);
    for (unsigned i = 0; i < node->mNumMeshes; i++)
        add_mesh(scene, file->mMeshes[node->mMeshes[i]], &m);
    for (unsigned i = 0; i < file->mNumLights; i++) // lights and cameras find their node by its name
        if (strcmp(file->mLights[i]->mName.data, node->mName.data) == 0)
            add_light(scene, file->mLights[i], &m);
    for (unsigned i = 0; i < file->mNumCameras; i++)
        if (strcmp(file->mCameras[i]->mName.data, node->mName.data) == 0)
            set_camera(scene, file->mCameras[i], &m);
    for (unsigned i = 0; i < node->mNumChildren; i++)
        add_node(scene, file, node->mChildren[i], &m);
}

static void add_materials(Scene *scene, const struct aiScene *file)
{
    unsigned textured = 0;
    for (unsigned i = 0; i < file->mNumMaterials; i++) {
        const struct aiMaterial *source = file->mMaterials[i];
        struct aiColor4D albedo = {0.6f, 0.6f, 0.6f, 1}, emission = {0, 0, 0, 0};
        struct aiString name = {0};
        aiGetMaterialString(source, AI_MATKEY_NAME, &name);
        if (aiGetMaterialColor(source, AI_MATKEY_BASE_COLOR, &albedo) != aiReturn_SUCCESS)
            aiGetMaterialColor(source, AI_MATKEY_COLOR_DIFFUSE, &albedo);
        aiGetMaterialColor(source, AI_MATKEY_COLOR_EMISSIVE, &emission);
        const vec3 reflected = vec3_make(albedo.r, albedo.g, albedo.b);
        scene_add_material(scene, name.data,
                           vec3_min(vec3_max(reflected, vec3_make(0, 0, 0)), vec3_make(1, 1, 1)),
                           vec3_max(vec3_make(emission.r, emission.g, emission.b), vec3_make(0, 0, 0)));
        textured += aiGetMaterialTextureCount(source, aiTextureType_DIFFUSE) > 0;
    }
    if (textured > 0)
        note("%s: textures are not read; the base colour's factor alone counts (materials: %u)", scene->name,
             textured);
}

void scene_import(Scene *scene, const char *path, float crease_degrees)
{
    struct stat status;
    const char *name = strrchr(path, '/') ? strrchr(path, '/') : path, *ending = strrchr(name, '.');
    if (stat(path, &status) != 0)
        fail_work("%s: no such file", path);
    if (S_ISDIR(status.st_mode))
        fail_work("%s: a directory, not a model file", path);
    const bool oogl = ending && strcasecmp(ending, ".oogl") == 0;
    if (!ending || !(oogl || aiIsExtensionSupported(ending)))
        fail_work("%s: a file of this ending cannot be read; .obj, .gltf, .glb, .ply, .off can", path);
    if (status.st_size == 0)
        fail_work("%s: broken: the file is empty", path);

    // OBJ lists normals a corner, so creases can be kept; a glTF without normals is flat (its specification, 3.7.2.1), which validation does.
    const bool smooth = strcasecmp(ending, ".obj") == 0;
    struct aiPropertyStore *properties = aiCreatePropertyStore();
    aiSetImportPropertyFloat(properties, AI_CONFIG_PP_GSN_MAX_SMOOTHING_ANGLE, crease_degrees);
    const unsigned steps = aiProcess_Triangulate | aiProcess_JoinIdenticalVertices | aiProcess_SortByPType |
                           (smooth ? aiProcess_GenSmoothNormals : 0);
    const struct aiScene *file = NULL;
    if (oogl) { // Geomview's name for what Assimp knows as OFF
        size_t bytes = 0;
        char *text = file_read(path, &bytes);
        if (text)
            file = aiImportFileFromMemoryWithProperties(text, (unsigned)bytes, steps, "off", properties);
        free(text);
    } else {
        file = aiImportFileExWithProperties(path, steps, NULL, properties);
    }
    aiReleasePropertyStore(properties);
    if (!file)
        fail_work("%s: broken: Assimp says: %s", path, aiGetErrorString());
    add_materials(scene, file);
    if (file->mRootNode)
        add_node(scene, file, file->mRootNode, &(struct aiMatrix4x4){.a1 = 1, .b2 = 1, .c3 = 1, .d4 = 1});
    aiReleaseImport(file);
    vec3 lower, upper;
    scene_bounds(&scene->mesh, &lower, &upper);
    const vec3 ahead =
        scene->camera.target - scene->camera.eye; // what it orbits lies as deep as the model's middle
    scene->camera.target += fmaxf(vec3_dot(0.5f * (lower + upper) - scene->camera.eye, ahead) - 1, 0) * ahead;
}
