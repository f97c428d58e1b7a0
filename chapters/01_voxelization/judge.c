// judge: see judge.h.
#include "judge.h"
#include "extra.h"
#include "attributes_truth.h"
#include "scenes.h"
#include "solid_scenes.h"
#include "solid_truth.h"
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

void judge_surface(Run *run, const Mesh *mesh, const Voxels *voxels, double fragments, double invocations)
{
    const VoxelGrid *grid = &voxels->grid;
    size_t words = grid_words(grid);
    uint32_t *got = voxels_read(voxels), *truth = truth_voxels(mesh, grid);
    double voxel_count = voxels_count(truth, NULL, words);
    double missing = voxels_count(truth, got, words), extra = voxels_count(got, truth, words);
    // Of the others only this is asked: that they set no voxel that the surface does not touch. What they miss is their sweep's matter.
    bool exact = run_chosen(run, "method", "exact") || run_chosen(run, "method", "binary");
    if (run_measuring_error(run)) {
        run_error(run, "truth", "missing", missing / fmax(voxel_count, 1.0));
        run_error(run, "truth", "extra", extra / fmax(voxel_count, 1.0));
        run_error(run, "truth", "wrong", (missing + extra) / fmax(voxel_count, 1.0));
        run_error(run, "truth", "extra_gap", extra_gap(mesh, grid, got, truth));
        run_error(run, "truth", "rounding_bound", truth_gap_bound(mesh, grid));
        run_error(run, "counted", "fragments", fragments);
        run_error(run, "counted", "invocations", invocations);
    } else {
        // Tolerance 0: a voxel is set or it is not, and both sides decide in double.
        double expected = scenes_voxels(run_case(run)); // closed form, or -1
        if (exact)
            run_check(run, "voxels", expected < 0 ? voxel_count : expected, voxels_count(got, NULL, words),
                      0.0, 0);
        if (exact)
            run_check(run, "missing", 0.0, missing, 0.0, 0);
        if (exact)
            run_check(run, "extra", 0.0, extra, 0.0, 0);
        else // the rasterizer snaps corners to 1/256 pixel; the voxel in which a moved point of a plane as steep as 1 lies is off by twice that
            run_check(run, "extra_gap", 0.0, extra_gap(mesh, grid, got, truth), 1.0 / 128.0, 0);
    }
    free(got);
    free(truth);
}

void judge_attributes(Run *run, const Attributes *stored, bool averaged, size_t bytes)
{
    AttributesError error = attributes_error(run_scene(run), stored, averaged);
    if (run_checking(run)) { // half a step of 1/1023, in those of a display
        run_check(run, "albedo_worst", 0.0, error.worst, 0.5 * 255.0 / 1023.0 + 1e-4, 0);
        return;
    }
    run_error(run, "truth", "albedo", error.mean);
    run_error(run, "truth", "albedo_worst", error.worst);
    run_error(run, "truth", "albedo_bias", error.bias);
    run_error(run, "counted", "stored_bytes", (double)bytes);
}

// Of a solid: how far its voxels' volume is from the mesh's own (divergence theorem), or from the closed form of a stability case.
void judge_solid(Run *run, const SolidMesh *solid, const SolidWork *work, double fragments,
                 double invocations)
{
    const Voxels *voxels = &work->result;
    uint32_t *got = voxels_read(voxels);
    double count = voxels_count(got, NULL, grid_words(&voxels->grid));
    if (run_measuring_error(run)) {
        if (solid->closed)
            run_error(run, "truth", "volume", solid_volume_error(solid, &voxels->grid, count));
        run_error(run, "counted", "fragments", fragments);
        run_error(run, "counted", "invocations", invocations);
    } else {
        // 1 %: half a layer of voxels' centres on a ball of 60 voxels' radius would be 2.5 %, and its errors inside and outside cancel
        double expected = solid_scene_volume(run_scene(run)->name),
               got_volume = count * pow(voxels->grid.voxel_size, 3);
        run_check(run, "volume", expected, got_volume, 0.01 * expected, 0);
        // The facets' own volume, where no part is counted twice. 0.2 %: centres of a ball come in shells of the same distance, of 0.15 % at most
        if (solid->closed && solid_columns(work, 2).overlapping == 0)
            run_check(run, "mesh volume", fabs(solid->volume), got_volume, 0.002 * expected, 0);
    }
    free(got);
}

// What WALK_ALBEDO and WALK_MEAN_NORMALS show of each voxel of `bits`, in their order; NULL for another show. Inside a solid no triangle
// touches: stone, no direction.
static vec3 *true_values(const Scene *scene, const VoxelGrid *grid, WalkShow show, const uint32_t *bits)
{
    if (show != WALK_ALBEDO && show != WALK_MEAN_NORMALS)
        return NULL;
    size_t count, mean = 0, value = 0;
    TrueMean *means = attributes_truth(scene, grid, &count);
    uint32_t *surface = truth_voxels(&scene->mesh, grid);
    vec3 *values =
        memory_new((size_t)voxels_count(bits, NULL, grid_words(grid)) + 1, sizeof *values, "true attributes");
    for (size_t i = 0; i < grid_voxels(grid); i++) {
        const bool touched = surface[i >> 5] >> (i & 31) & 1;
        if (bits[i >> 5] >> (i & 31) & 1) {
            vec3 here = show == WALK_ALBEDO ? vec3_make(0.95f, 0.90f, 0.82f) : vec3_make(0, 0, 0);
            for (int k = 0; k < 3 && touched; k++)
                here[k] = (float)(show == WALK_ALBEDO ? means[mean].albedo[k] : means[mean].normal[k]);
            values[value++] = here;
        }
        mean += touched;
    }
    free(surface);
    free(means);
    return values;
}

// The bits that the picture shows.
static uint32_t *true_voxels(const Scene *scene, const VoxelGrid *grid, TrueVoxels of)
{
    uint32_t *bits = of.solid ? solid_truth(&scene->mesh, grid) : truth_voxels(&scene->mesh, grid);
    if (strcmp(of.shadow, "none") == 0)
        return bits;
    uint32_t *shadow = shadow_truth(bits, grid, of.shadow);
    free(bits);
    return shadow;
}

// walk_truth's colours are part of the truth: compiled anew, it is computed anew.
static const char compiled[] = __DATE__ " " __TIME__;

Image judge_truth(const Scene *scene, const VoxelGrid *grid, TrueVoxels of, WalkShow show,
                  const Camera *camera, int width, int height)
{
    const float view[] = {camera->eye[0],    camera->eye[1],          camera->eye[2], camera->target[0],
                          camera->target[1], camera->target[2],       camera->up[0],  camera->up[1],
                          camera->up[2],     camera->vertical_fov_rad};
    const int numbers[] = {grid->size[0], grid->size[1], grid->size[2], (int)show, width, height, of.solid};
    uint64_t inputs = hash_bytes(truth_hash_scene(scene), compiled, sizeof compiled);
    inputs = hash_bytes(hash_bytes(inputs, view, sizeof view), numbers, sizeof numbers);
    inputs =
        hash_bytes(hash_bytes(inputs, grid->origin, sizeof grid->origin), &grid->voxel_size, sizeof(double));
    inputs = hash_bytes(inputs, of.shadow, strlen(of.shadow));
    char *path = truth_cache_path("01_voxelization", inputs, ".exr");
    Image truth;
    if (access(path, R_OK) == 0) {
        truth = image_read(path);
    } else {
        uint32_t *bits = true_voxels(scene, grid, of);
        vec3 *values = true_values(scene, grid, show, bits);
        truth = walk_truth(bits, grid, show, values, camera, width, height);
        image_write(path, &truth, 0.0f);
        free(values);
        free(bits);
    }
    free(path);
    return truth;
}
