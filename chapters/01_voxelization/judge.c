// judge: see judge.h. Each tolerance stands beside its reason.
#include "judge.h"
#include "scenes.h"
#include "solid_scenes.h"
#include "truth.h"

#include <stdlib.h>

// The error rows of a sweep, or the checks of a stability case.
void judge_surface(Run *run, const Mesh *mesh, const Voxels *voxels, double fragments, double invocations)
{
    size_t words = grid_words(&voxels->grid);
    uint32_t *got = voxels_read(voxels), *truth = truth_voxels(mesh, &voxels->grid);
    double voxel_count = voxels_count(truth, NULL, words);
    double missing = voxels_count(truth, got, words), extra = voxels_count(got, truth, words);
    // Of the others only this is asked: that they set no voxel that the surface does not touch. What they miss is their sweep's matter.
    bool exact = run_chosen(run, "method", "exact") || run_chosen(run, "method", "binary");
    if (run_measuring_error(run)) {
        run_error(run, "truth", "missing", missing / fmax(voxel_count, 1.0));
        run_error(run, "truth", "extra", extra / fmax(voxel_count, 1.0));
        run_error(run, "truth", "wrong", (missing + extra) / fmax(voxel_count, 1.0));
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
        run_check(run, "extra", 0.0, extra, 0.0, 0);
    }
    free(got);
    free(truth);
}

// Of a solid: how far its voxels' volume is from the mesh's own (divergence theorem), or from the closed form of a stability case.
void judge_solid(Run *run, const SolidMesh *solid, const Voxels *voxels, double fragments, double invocations)
{
    uint32_t *got = voxels_read(voxels);
    double count = voxels_count(got, NULL, grid_words(&voxels->grid));
    if (run_measuring_error(run)) {
        if (solid->closed)
            run_error(run, "truth", "volume", solid_volume_error(solid, &voxels->grid, count));
        run_error(run, "counted", "fragments", fragments);
        run_error(run, "counted", "invocations", invocations);
    } else {
        // 1 %: half a layer of voxels' centres on a ball of 60 voxels' radius would be 2.5 %, and its errors inside and outside cancel
        double expected = solid_scene_volume(run_scene(run)->name);
        run_check(run, "volume", expected, count * pow(voxels->grid.voxel_size, 3), 0.01 * expected, 0);
    }
    free(got);
}
