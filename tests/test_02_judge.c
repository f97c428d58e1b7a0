// 02 shadow maps: what visibilities are judged by, asked about pictures whose errors are known.
#include "shadow_bench.h"

// The judge itself: a picture of 8 × 1, true light in the right half; one pixel is wrong 3 pixels from the nearest of the other kind.
Test(shadow_judge, the_judge_measures_shares_and_distances)
{
    float truth[8] = {0, 0, 0, 0, 1, 1, 1, -1}, got[8] = {0, 1, 0, 0, 1, 0.25f, 0.75f, -1};
    const Judgement j = judge_of(&(Visibility){8, 1, got, truth, NULL}, 1);
    cr_assert(j.asked == 7 && fabs(j.wrong - 2.0 / 7) < 1e-12);
    cr_assert(fabs(j.leaked - 1.0 / 7) < 1e-12 && fabs(j.dark - 1.0 / 7) < 1e-12);
    cr_assert(fabs(j.difference - 2.0 / 7) < 1e-12, "%g", j.difference);
    cr_assert(j.distance_mean == 2.5 && j.distance_p99 == 3 && j.distance_most == 3, "%g %g %g",
              j.distance_mean, j.distance_p99, j.distance_most);
}

// A floor whose vertices claim another slope than its triangles have, and a sun 6° before or behind the triangles' plane: the first case is judged,
// and in the second the surface hides itself, which is counted apart.
static void make_false_normals(Scene *scene, uint64_t behind)
{
    const uint32_t material =
        scene_add_material(scene, "stone", vec3_make(0.5f, 0.5f, 0.5f), vec3_make(0, 0, 0));
    uint32_t v[4];
    for (int k = 0; k < 4; k++)
        v[k] = mesh_add_vertex(&scene->mesh, vec3_make(k & 1 ? 8 : -8, 0, k & 2 ? 8 : -8),
                               vec3_normalize(vec3_make(-1, 1, 0)));
    mesh_add_triangle(&scene->mesh, v[0], v[2], v[1], material);
    mesh_add_triangle(&scene->mesh, v[1], v[2], v[3], material);
    scene_add_light(scene, (Light){.kind = LIGHT_DIRECTIONAL,
                                   .direction = vec3_normalize(vec3_make(1, behind ? 0.1f : -0.1f, 0)),
                                   .intensity = vec3_make(1, 1, 1)});
    scene->camera = (Camera){vec3_make(0, 10, 0), vec3_make(0, 0, 0), vec3_make(0, 0, -1), 1, 0, 0};
}
Test(shadow_judge, triangles_that_face_away_are_not_judged_but_counted)
{
    for (int behind = 0; behind < 2; behind++) {
        ShadowBench bench = shadow_bench(make_false_normals, (uint64_t)behind);
        const MapLookup lookup = {.bias = BIAS_SLOPE, .bias_size = 8, .radius = 1};
        ShadowMap map = map_create(bench.scene, &bench.scene->lights[0], false, false, 64, NULL, 1);
        free(shadow_ask(&bench, &map, &lookup, 0));
        Truth *truth = truth_open(&bench.scene->mesh);
        const Judgement j =
            judge_all(&(Asked){bench.scene, bench.camera, &bench.gbuffer, &bench.visibility}, truth);
        cr_assert_eq(j.turned_away, behind, "case %d: %g are turned away", behind, j.turned_away);
        cr_assert_eq(j.asked, behind ? 0 : SIDE * SIDE, "case %d: %g are judged", behind, j.asked);
        cr_assert(behind || j.wrong == 0, "%g are wrong", j.wrong);
        truth_close(truth);
        map_delete(&map);
        gl_close();
    }
}
