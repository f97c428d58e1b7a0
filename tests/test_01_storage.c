// 01 voxelization: what voxels store and which of them are inside, as a user runs it: passes left out and their witnesses, pictures beside their
// truth, what is said of a mesh that is no solid.
#include "image.h"

#include <criterion/criterion.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef struct Ran {
    char *said; // both outputs: the plan, and the notes
    Image picture, truth;
} Ran;

static Ran run_chapter(const char *arguments, bool truth)
{
    const char *build = getenv("BUILD");
    char *at = text_format("/tmp/storage-%d", (int)getpid()), *picture = text_format("%s.exr", at),
         *true_picture = text_format("%s-truth.exr", at);
    char *command = text_format("%s/01_voxelization --size 48x40 --plan --out %s %s%s %s >%s 2>&1",
                                build ? build : "build", picture, truth ? "--truth " : "",
                                truth ? true_picture : "", arguments, at);
    int status = system(command);
    Ran ran = {.said = file_read(at, NULL)};
    cr_assert_eq(status, 0, "%s: %s", command, ran.said);
    ran.picture = image_read(picture);
    if (truth)
        ran.truth = image_read(true_picture);
    char *const written[] = {at, picture, true_picture, command};
    for (int i = 0; i < 4; i++) {
        unlink(written[i]); // the command is no file
        free(written[i]);
    }
    return ran;
}

static void ran_free(Ran *ran)
{
    free(ran->said);
    image_free(&ran->picture);
    image_free(&ran->truth);
}

// What the plan says of a pass: its invocations or fragments, -1 where it was left out.
static double work_of(const Ran *ran, const char *pass)
{
    char *start = text_format("\n%s  ", pass), word[8] = "";
    const char *line = strstr(ran->said, start);
    cr_assert(line != NULL, "no pass '%s' in\n%s", pass, ran->said);
    double ms = 0;
    sscanf(line + strlen(start), "%7s %lf", word, &ms);
    const char *end = strchr(line + 1, '\n'), *count = strstr(line, "compute_invocations=");
    free(start);
    if (strcmp(word, "yes") != 0)
        return -1;
    cr_assert(ms > 0, "%s took no time", pass);
    return count && count < end ? atof(count + strlen("compute_invocations=")) : 0;
}

static bool same(const Image *a, const Image *b)
{
    size_t bytes = (size_t)a->width * (size_t)a->height * (size_t)a->channels * sizeof(float);
    return a->width == b->width && a->height == b->height && a->channels == b->channels &&
           memcmp(a->pixels, b->pixels, bytes) == 0;
}

// ---------------------------------------------------------------- left out

// A pass runs without being asked to, or only under --everything: then it does something, and the picture is bit for bit the same.
// Returns the usual one.
static Ran check_left_out(const char *arguments, const char *const *passes, bool needed)
{
    char *forced = text_format("%s --everything", arguments);
    Ran usual = run_chapter(arguments, false), everything = run_chapter(forced, false);
    for (int i = 0; passes[i]; i++) {
        double here = work_of(&usual, passes[i]), there = work_of(&everything, passes[i]);
        cr_assert(needed ? here > 0 : here < 0, "%s: %s: %g invocations", arguments, passes[i], here);
        cr_assert(there > 0, "%s: %s: %g invocations under --everything", arguments, passes[i], there);
    }
    cr_assert(same(&usual.picture, &everything.picture), "%s: --everything changes the picture", arguments);
    ran_free(&everything);
    free(forced);
    return usual;
}

Test(storage, nothing_is_stored_where_only_occupancy_is_shown)
{
    const char *const sums[] = {"storage: rank", "storage: sums", NULL};
    Ran stone = check_left_out("--scene cornell --set resolution=16", sums, false);
    // just beyond: the same picture by stored colours
    Ran coloured = check_left_out("--scene cornell --set resolution=16 --set show=albedo", sums, true);
    Ran listed =
        run_chapter("--scene cornell --set resolution=16 --set show=albedo --set storage=list", false);
    cr_assert(!same(&stone.picture, &coloured.picture), "without what is stored there is no colour");
    cr_assert(same(&listed.picture, &coloured.picture), "the list's sums are the sums");
    cr_assert(work_of(&listed, "storage: list's sums") > 0 && work_of(&listed, "storage: sums") < 0,
              "by way of the list");
    ran_free(&stone);
    ran_free(&coloured);
    ran_free(&listed);
}

Test(storage, a_surface_has_no_parity_passes)
{
    const char *const all[] = {"solid: along x", "solid: along y", "solid: along z", "solid: vote", NULL};
    const char *cut = "--scene ball --set resolution=16 --set region_upper=1,1,0.45";
    Ran hollow = check_left_out(cut, all, false);
    // just beyond: of the same ball cut open the inside is asked for
    char *filled = text_format("%s --set method=solid", cut);
    Ran solid = run_chapter(filled, false);
    cr_assert(work_of(&solid, "solid: along z") > 0, "one axis");
    cr_assert(!same(&hollow.picture, &solid.picture), "the inside is seen");
    ran_free(&hollow);
    ran_free(&solid);
    free(filled);
}

static bool says(const Ran *ran, const char *what)
{
    return strstr(ran->said, what) != NULL;
}

Test(storage, one_axis_decides_where_a_mesh_is_closed_and_three_where_it_is_not)
{
    const char *const others[] = {"solid: along x", "solid: along y", "solid: vote", NULL};
    Ran ball = check_left_out("--scene ball --set resolution=32 --set method=solid", others, false);
    cr_assert(!says(&ball, "as a solid"), "%s", ball.said);
    ran_free(&ball);
    // just beyond: one triangle of 96 is missing. test_01_solid.c asks what one axis alone would make of it
    Ran holes = check_left_out("--scene ball_holes --set resolution=32 --set method=solid", others, true);
    cr_assert(says(&holes,
                   "01_voxelization: note: ball_holes: as a solid: not closed: 1140 edges belong to an odd "
                   "number of triangles, so a voxel is inside where two of three axes say so; of the columns "
                   "along x, y and z, 18, 16 and 18 are crossed an odd number of times and say nothing\n"),
              "%s", holes.said);
    ran_free(&holes);
}

// ---------------------------------------------------------------- pictures and their truth

// Pixels whose ray passes an edge of a voxel within the rounding of single precision may differ: one in 200. All others show a sum
// within half a step of 1/1023 (1/511), in a light of at most 0.95 (in the derivative of ((1 + n)/2)², at most 1).
static double beyond(const Ran *ran, float step)
{
    size_t pixels = (size_t)ran->picture.width * (size_t)ran->picture.height, off = 0, k;
    for (size_t i = 0; i < pixels; i++) {
        const float *a = ran->picture.pixels + (size_t)ran->picture.channels * i,
                    *b = ran->truth.pixels + (size_t)ran->truth.channels * i;
        for (k = 0; k < 3 && fabsf(a[k] - b[k]) <= 0.5f * step + 1e-5f;)
            k++;
        off += k < 3;
    }
    return (double)off / (double)pixels;
}

Test(storage, stored_colours_and_normals_look_as_their_truth)
{
    const struct {
        const char *arguments;
        float step;
    } cases[] = {{"--scene colonnade --set resolution=40 --set show=albedo", 1.0f / 1023},
                 {"--scene colonnade --set resolution=40 --set show=mean_normals", 1.0f / 511},
                 {"--scene averages --set resolution=16 --set show=albedo", 1.0f / 1023}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        Ran ran = run_chapter(cases[i].arguments, true);
        cr_assert(beyond(&ran, cases[i].step) < 0.005, "%s: %g", cases[i].arguments,
                  beyond(&ran, cases[i].step));
        ran_free(&ran);
    }
    // the inside and its shadow, by rays from every centre; nothing is stored
    Ran shadow = run_chapter("--scene balls --set resolution=24 --set method=solid --set shadow=-y "
                             "--set region_upper=1,1,0.45",
                             true);
    cr_assert(beyond(&shadow, 0) < 0.005, "%g", beyond(&shadow, 0));
    ran_free(&shadow);
    // listing 4.9 on the wall of equal means: of 256 voxels those with few fragments, and with few beyond 256, are right, the others dark
    Ran average =
        run_chapter("--scene averages --set resolution=16 --set show=albedo --set storage=average", true);
    cr_assert(beyond(&average, 1.0f / 255) > 0.7, "%g", beyond(&average, 1.0f / 255));
    ran_free(&average);
}

// ---------------------------------------------------------------- messages

Test(storage, what_is_no_solid_is_said_in_one_line)
{
    const struct {
        const char *scene, *says;
    } cases[] = {
        {"ball_twice", "36480 triangles repeat another one, corners and winding: they do not count\n"},
        {"ball_inside_out", "wound inside out in 812 of 812 columns along z: filled all the same\n"},
        {"balls",
         "parts overlap, or disagree in winding, in 92 of 540 columns along z: what an even number of "
         "parts covers is outside\n"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char *arguments = text_format("--scene %s --set resolution=32 --set method=solid", cases[i].scene);
        char *line = text_format("01_voxelization: note: %s: as a solid: %s", cases[i].scene, cases[i].says);
        Ran ran = run_chapter(arguments, false);
        cr_assert(says(&ran, line), "%s: %s", arguments, ran.said);
        ran_free(&ran);
        free(arguments);
        free(line);
    }
}
