// Solids of chapter 01 against closed forms, Embree's ray parity and the rule that solid.h states.
#include "solid_bench.h"
#include "threads_bench.h"

static uint32_t random_bits(uint32_t *state) // xorshift32 (Marsaglia 2003)
{
    *state ^= *state << 13;
    *state ^= *state >> 17;
    return *state ^= *state << 5;
}

static double uniform(uint32_t *state) // [0, 1)
{
    return random_bits(state) / 4294967296.0;
}

static void make_nothing(Scene *scene, uint64_t seed)
{
    (void)seed;
    scene_add_material(scene, "white", vec3_make(1, 1, 1), vec3_make(0, 0, 0));
}

static Scene *open_empty(void)
{
    gl_open(GL_PLATFORM_OSMESA, 16, 16, "test");
    return solid_bench_scene(make_nothing);
}

// ---------------------------------------------------------------- closed forms

Test(solid, a_ball_is_within_a_hundredth_of_its_volume)
{
    gl_open(GL_PLATFORM_OSMESA, 16, 16, "test");
    Scene *scene = solid_bench_scene(make_ball);
    VoxelGrid grid = scene_grid(scene, 128);
    Filled filled = solid_bench_fill(scene, &grid, false, 0);
    double volume = filled.count * pow(grid.voxel_size, 3), exact = solid_scene_volume("ball");
    // 1 % is what the course promises
    cr_assert(fabs(volume / exact - 1) < 0.01, "volume %g m3 of %g", volume, exact);
    // Of the mesh's own volume, which knows of the facets, only centres are left: by symmetry they lie on shells of up to 1600 centres of
    // the same distance, 1.5e-3 of all, and the count jumps by one at a radius of 63.99 and again at 64 voxels.
    cr_assert(solid_volume_error(&filled.mesh, &grid, filled.count) < 1.5e-3, "%g",
              solid_volume_error(&filled.mesh, &grid, filled.count));
    cr_assert(filled.mesh.closed && filled.mesh.odd_edges == 0 && filled.mesh.duplicates == 0,
              "a sound mesh");
    cr_assert(filled.message == NULL, "nothing to say: %s", filled.message);
    filled_free(&filled);
    scene_close(scene);
}

// Corners on centres, so that every centre on the surface is a tie: the half-open rule gives exactly (b−a) a side, also where two
// boxes share a face, and none to a box without thickness between centres. All numbers are exact in float32; no tolerance.
Test(solid, boxes_own_their_lower_faces)
{
    Scene *scene = open_empty();
    VoxelGrid grid = {{0, 0, 0}, 0.5, {40, 33, 37}};
    const float corner[][6] = {{2.25f, 2.25f, 2.25f, 5.25f, 6.25f, 7.25f}, // lower and upper corner, metres
                               {5.25f, 2.25f, 2.25f, 9.25f, 6.25f, 7.25f}, // shares a face with the first
                               {12.0f, 1.0f, 1.0f, 13.0f, 2.0f, 3.0f},     // faces on faces of voxels
                               {15.0f, 8.3f, 8.3f, 15.2f, 9.0f, 9.0f}};    // between two centres along x
    long expected = 0;
    for (int box = 0; box < 4; box++) {
        long voxels = 1;
        vec3 lower = {0}, upper = {0};
        for (int k = 0; k < 3; k++) {
            lower[k] = corner[box][k], upper[k] = corner[box][3 + k];
            voxels *= (long)ceil((double)upper[k] / 0.5 - 0.5) - (long)ceil((double)lower[k] / 0.5 - 0.5);
        }
        expected += voxels;
        mesh_add_box(&scene->mesh, lower, upper, 0);
    }
    for (int large = 0; large < 2; large++)
        for (int everything = 0; everything < 2; everything++) {
            Filled filled = solid_bench_fill(scene, &grid, everything != 0, large ? 0.01f : 0);
            cr_assert_eq((long)filled.count, expected, "%s: %ld voxels of %ld", large ? "drawn" : "small",
                         (long)filled.count, expected);
            cr_assert(filled.mesh.closed && filled.mesh.odd_edges == 0, "closed");
            cr_assert(strstr(filled.message, "2 pairs of triangles lie back to back") &&
                          !strchr(filled.message, ';'),
                      "the shared face is all there is to say: %s", filled.message);
            // lower corner in, upper corner out
            cr_assert(filled_at(&filled, 4, 4, 4) && !filled_at(&filled, 3, 4, 4),
                      "the lower face is inside");
            cr_assert(filled_at(&filled, 10, 4, 4) && filled_at(&filled, 17, 11, 13), "up to the next");
            cr_assert(!filled_at(&filled, 18, 11, 13) && !filled_at(&filled, 17, 12, 13),
                      "the upper face is out");
            filled_free(&filled);
        }
    scene_close(scene);
}

// A grid over a part of a box: what lies before the grid decides as well.
Test(solid, a_grid_inside_a_solid_is_full)
{
    Scene *scene = open_empty();
    mesh_add_box(&scene->mesh, vec3_make(-100, -100, -100), vec3_make(100, 100, 100), 0);
    VoxelGrid grid = {{-3, 2, 1}, 0.25, {33, 5, 70}};
    for (int large = 0; large < 2; large++) {
        Filled filled = solid_bench_fill(scene, &grid, true, large ? 0.01f : 1e6f);
        cr_assert_eq(filled.count, 33.0 * 5 * 70, "%g voxels of %g", filled.count, 33.0 * 5 * 70);
        filled_free(&filled);
    }
    VoxelGrid above = {{-3, 2, 99}, 0.25, {33, 5, 8}}; // half of it beyond the box
    Filled filled = solid_bench_fill(scene, &above, true, 0);
    cr_assert_eq(filled.count, 33.0 * 5 * 4, "%g voxels of %g", filled.count, 33.0 * 5 * 4);
    filled_free(&filled);
    scene_close(scene);
}

// Nothing, and one box in grids of one voxel and of 3 x 500 x 7.
Test(solid, odd_grids)
{
    Scene *scene = open_empty();
    VoxelGrid one = {{0, 0, 0}, 4.0, {1, 1, 1}}, long_one = {{0, 0, 0}, 1.0, {3, 500, 7}};
    Filled none = solid_bench_fill(scene, &one, false, 0);
    cr_assert_eq(none.count, 0.0, "an empty scene has no inside");
    filled_free(&none);
    mesh_add_box(&scene->mesh, vec3_make(1, 1, 1), vec3_make(2.75f, 400, 6), 0);
    for (int everything = 0; everything < 2; everything++) {
        Filled filled = solid_bench_fill(scene, &one, everything != 0, 0);
        cr_assert_eq(filled.count, 1.0, "the centre (2, 2, 2) is inside");
        filled_free(&filled);
        filled = solid_bench_fill(scene, &long_one, everything != 0, 0);
        cr_assert_eq(filled.count, 2.0 * 399 * 5, "%g voxels", filled.count);
        filled_free(&filled);
    }
    scene_close(scene);
}

// ---------------------------------------------------------------- the rule

// By the rule: volume as of the sound ball (within 1 %), and a message that names the flaw.
static Filled fill_ball(void (*make)(Scene *, uint64_t), const char *name, const char *says)
{
    Scene *scene = solid_bench_scene(make);
    VoxelGrid grid = scene_grid(scene, 64);
    Filled filled = solid_bench_fill(scene, &grid, false, 0);
    double volume = filled.count * pow(grid.voxel_size, 3), exact = solid_scene_volume(name);
    cr_assert(fabs(volume / exact - 1) < 0.01, "%s: volume %g m3 of %g", name, volume, exact);
    cr_assert(filled.message != NULL && strstr(filled.message, says) != NULL, "%s: %s", name, filled.message);
    cr_assert(strchr(filled.message, '\n') == NULL, "one line");
    scene_close(scene);
    return filled;
}

Test(solid, unsound_meshes_are_filled_by_the_rule_and_said)
{
    gl_open(GL_PLATFORM_OSMESA, 16, 16, "test");
    Scene *sound = solid_bench_scene(make_ball);
    VoxelGrid grid = scene_grid(sound, 64);
    Filled ball = solid_bench_fill(sound, &grid, false, 0);
    size_t words = grid_words(&grid), triangles = sound->mesh.triangle_count;
    scene_close(sound);

    Filled twice = fill_ball(make_ball_twice, "ball", "36480 triangles repeat another one");
    cr_assert_eq(twice.mesh.duplicates, triangles, "%zu duplicates of %zu", twice.mesh.duplicates, triangles);
    cr_assert(twice.mesh.closed, "closed once they count once");
    cr_assert_eq(memcmp(twice.bits, ball.bits, 4 * words), 0, "bit for bit the sound ball");

    Filled turned =
        fill_ball(make_ball_inside_out, "ball", "wound inside out in 3228 of 3228 columns along z");
    cr_assert(turned.mesh.volume < 0 && turned.columns[2].inside_out == turned.columns[2].crossed,
              "each column");
    cr_assert_eq(turned.columns[2].overlapping, 0u, "and nothing else");
    cr_assert_eq(memcmp(turned.bits, ball.bits, 4 * words), 0, "bit for bit the sound ball");

    Filled holes = fill_ball(make_ball_holes, "ball", "not closed: 1140 edges");
    cr_assert(holes.mesh.odd_edges == 3 * (size_t)(triangles / 96), "three edges a hole: %zu",
              holes.mesh.odd_edges);
    for (int axis = 0; axis < 3; axis++)
        cr_assert(holes.columns[axis].odd > 0, "columns through a hole along axis %d", axis);
    // One axis alone would lose a column a hole, and each column has two ends: 2/96 = 0.021 of all. Two of three axes miss 3 · 0.021² = 0.0013
    // of the voxels where holes lie at random; here they lie in rows, which doubles it.
    double lost = voxels_count(ball.bits, holes.bits, words),
           made = voxels_count(holes.bits, ball.bits, words);
    cr_assert(lost < 0.004 * ball.count, "%g of %g voxels are lost", lost, ball.count);
    cr_assert(made < 0.0005 * ball.count, "%g of %g voxels are made up", made, ball.count);

    Filled both = fill_ball(make_balls, "balls", "parts overlap, or disagree in winding, in 364 of 2164");
    cr_assert(both.mesh.closed && both.columns[2].inside_out == 0, "closed, wound rightly");
    // the lens' radius is 4 m, its area 16 pi m²; its columns along z are those over an ellipse-like lens of half width 2, half height 4
    double lens = 2 * (25 * acos(0.6) - 3 * 4),
           columns = both.columns[2].overlapping * pow(both.grid.voxel_size, 2);
    cr_assert(fabs(columns / lens - 1) < 0.05, "columns over %g m2 of %g", columns, lens);

    Filled *all[] = {&ball, &twice, &turned, &holes, &both};
    for (size_t i = 0; i < 5; i++)
        filled_free(all[i]);
}

// A ball in a ball: hollow where the inner one is wound inwards, which is sound; else its inside is covered twice, which is said.
Test(solid, a_hollow_is_sound_if_its_inside_is_wound_inwards)
{
    for (int inwards = 0; inwards < 2; inwards++) {
        Scene *scene = open_empty();
        make_ball(scene, 1);
        size_t vertices = scene->mesh.vertex_count, triangles = scene->mesh.triangle_count;
        for (size_t i = 0; i < vertices; i++) {
            const float *p = scene->mesh.positions + 3 * i;
            mesh_add_vertex(&scene->mesh, 0.5f * vec3_make(p[0], p[1], p[2]) + vec3_make(4, 4, 4), (vec3){0});
        }
        for (size_t i = 0; i < triangles; i++) {
            const uint32_t n = (uint32_t)vertices, *t = scene->mesh.indices + 3 * i;
            uint32_t b = t[1 + inwards], c = t[2 - inwards];
            mesh_add_triangle(&scene->mesh, n + t[0], n + b, n + c, 0);
        }
        VoxelGrid grid = {{0, 0, 0}, 0.25, {64, 64, 64}};
        Filled filled = solid_bench_fill(scene, &grid, false, 0);
        double volume = filled.count * pow(grid.voxel_size, 3), exact = 0.875 * solid_scene_volume("ball");
        cr_assert(fabs(volume / exact - 1) < 0.01, "volume %g m3 of %g", volume, exact);
        cr_assert_eq(filled.message == NULL, inwards == 1, "wound %s: %s", inwards ? "inwards" : "outwards",
                     filled.message);
        filled_free(&filled);
        scene_close(scene);
        gl_close();
    }
}

// Triangles back to back cancel. A wall between two tetrahedra that share it changes no voxel; a ball whose triangles are all
// doubled the other way round has no inside, which is said and not left to be wondered at.
Test(solid, triangles_back_to_back_bound_nothing)
{
    const uint32_t sides[6][3] = {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {1, 0, 4}, {2, 1, 4}, {0, 2, 4}};
    const VoxelGrid grid = {{0, 0, 0}, 0.25, {45, 45, 65}};
    uint32_t *open = NULL;
    for (int wall = 0; wall < 2; wall++) {
        Scene *scene = open_empty();
        const float corners[5][3] = {{2, 2, 8}, {10, 2, 8}, {2, 10, 8}, {2, 2, 15}, {2, 2, 1}};
        for (int i = 0; i < 5; i++)
            mesh_add_vertex(&scene->mesh, vec3_make(corners[i][0], corners[i][1], corners[i][2]), (vec3){0});
        for (int i = 0; i < 6; i++)
            mesh_add_triangle(&scene->mesh, sides[i][0], sides[i][1], sides[i][2], 0);
        if (wall) {
            mesh_add_triangle(&scene->mesh, 0, 2, 1, 0);
            mesh_add_triangle(&scene->mesh, 1, 2, 0, 0);
        }
        Filled filled = solid_bench_fill(scene, &grid, true, 0);
        cr_assert(filled.mesh.closed && filled.mesh.back_to_back == (size_t)wall, "%zu pairs",
                  filled.mesh.back_to_back);
        cr_assert_eq(filled.message != NULL, wall == 1, "%s", filled.message);
        cr_assert(filled.count > 9000, "%g voxels of 448/3 m3", filled.count);
        if (wall)
            cr_assert_eq(memcmp(open, filled.bits, 4 * grid_words(&grid)), 0, "the wall changes nothing");
        else
            open = memcpy(memory_new(grid_words(&grid), 4, "bits"), filled.bits, 4 * grid_words(&grid));
        filled_free(&filled);
        scene_close(scene);
    }
    free(open);
    Scene *paper = solid_bench_scene(make_ball);
    const size_t triangles = paper->mesh.triangle_count;
    for (size_t i = 0; i < triangles; i++) {
        const uint32_t t[3] = {paper->mesh.indices[3 * i], paper->mesh.indices[3 * i + 1],
                               paper->mesh.indices[3 * i + 2]};
        mesh_add_triangle(&paper->mesh, t[1], t[0], t[2], 0);
    }
    Filled nothing = solid_bench_fill(paper, &grid, true, 0);
    cr_assert_eq(nothing.count, 0.0, "%g voxels", nothing.count);
    cr_assert(nothing.message && strstr(nothing.message, "36480 pairs of triangles lie back to back"), "%s",
              nothing.message);
    filled_free(&nothing);
    scene_close(paper);
}

// Any closed mesh of any shape: each triangle of a soup of tetrahedra, slivers and lattice corners among them. However much
// rounding there is, no column may be crossed an odd number of times: that would fill a shaft to the grid's end.
Test(solid, every_column_of_a_closed_mesh_is_crossed_an_even_number_of_times)
{
    Scene *scene = open_empty();
    uint32_t state = 7;
    for (int solid = 0; solid < 1000; solid++) {
        uint32_t corner[4];
        for (int c = 0; c < 4; c++) {
            vec3 p = {0};
            for (int k = 0; k < 3; k++) {
                double x = 40 * uniform(&state) - 4;
                if (solid % 3 == 0) // on centres, faces and quarters
                    x = 0.25 * floor(4 * x);
                if (solid % 3 == 1 && k == solid % 2) // nearly flat
                    x = 16 + 1e-5 * x;
                p[k] = (float)(x * (solid % 50 == 0 ? 1e4 : 1));
            }
            corner[c] = mesh_add_vertex(&scene->mesh, p, (vec3){0});
        }
        mesh_add_triangle(&scene->mesh, corner[0], corner[1], corner[2], 0);
        mesh_add_triangle(&scene->mesh, corner[0], corner[3], corner[1], 0);
        mesh_add_triangle(&scene->mesh, corner[1], corner[3], corner[2], 0);
        mesh_add_triangle(&scene->mesh, corner[2], corner[3], corner[0], 0);
    }
    VoxelGrid grid = {{0, 0, 0}, 1.0, {32, 32, 32}};
    for (int way = 0; way < 3; way++) { // drawn, not drawn, or as it comes
        Filled filled = solid_bench_fill(scene, &grid, true, way == 0 ? 0.01f : way == 1 ? 64.0f : 8.0f);
        cr_assert(filled.mesh.closed, "closed");
        for (int axis = 0; axis < 3; axis++)
            cr_assert(filled.columns[axis].odd == 0 && filled.columns[axis].crossed > 900,
                      "way %d, axis %d: %u of %u columns odd", way, axis, filled.columns[axis].odd,
                      filled.columns[axis].crossed);
        filled_free(&filled);
    }
    scene_close(scene);
}

// ---------------------------------------------------------------- order

static void shuffle(Mesh *mesh, uint32_t *state)
{
    for (size_t i = mesh->triangle_count; i > 1; i--) {
        size_t j = random_bits(state) % i, turn = random_bits(state) % 3;
        uint32_t a[3], b[3];
        memcpy(a, mesh->indices + 3 * (i - 1), sizeof a);
        memcpy(b, mesh->indices + 3 * j, sizeof b);
        for (size_t k = 0; k < 3; k++) { // and begin it at another corner
            mesh->indices[3 * j + k] = a[(k + turn) % 3];
            mesh->indices[3 * (i - 1) + k] = b[k];
        }
    }
}

// Bit for bit: a flip is a flip, whoever comes first, drawn or not.
Test(solid, any_order_gives_the_same_voxels)
{
    gl_open(GL_PLATFORM_OSMESA, 16, 16, "test");
    Scene *scene = solid_bench_scene(make_ball_holes);
    VoxelGrid grid = scene_grid(scene, 48);
    uint32_t state = 3;
    Filled first = solid_bench_fill(scene, &grid, false, 0);
    const float sides[] = {0, 0.01f, 2.0f, 100.0f};
    for (int i = 0; i < 4; i++) {
        shuffle(&scene->mesh, &state);
        Filled other = solid_bench_fill(scene, &grid, false, sides[i]);
        cr_assert_eq(memcmp(first.bits, other.bits, 4 * grid_words(&grid)), 0, "shuffle %d", i);
        cr_assert_eq(memcmp(first.columns, other.columns, sizeof first.columns), 0, "columns, shuffle %d", i);
        filled_free(&other);
    }
    filled_free(&first);
    scene_close(scene);
}

// Bit for bit again, and whichever triangles are drawn.
static uint64_t hash_of_holes(const char *small_side)
{
    gl_open(GL_PLATFORM_OSMESA, 16, 16, "test");
    Scene *scene = solid_bench_scene(make_ball_holes);
    VoxelGrid grid = scene_grid(scene, 48);
    Filled filled = solid_bench_fill(scene, &grid, false, strtof(small_side, NULL));
    const uint64_t hash = hash_bytes(HASH_START, filled.bits, 4 * grid_words(&grid));
    return filled.count > 1000 ? hash_bytes(hash, filled.columns, sizeof filled.columns) : 0;
}
Test(solid, any_number_of_threads_gives_the_same_voxels)
{
    cr_assert_eq(hash_with_threads("0", hash_of_holes, "2"), hash_with_threads("4", hash_of_holes, "8"),
                 "one thread and four");
}
