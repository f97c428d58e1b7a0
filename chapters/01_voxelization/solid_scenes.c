// solid_scenes: see solid_scenes.h.
#include "solid_scenes.h"
#include <string.h>

// Facets take 0.045 % off the volume.
enum { MERIDIANS = 192, PARALLELS = 96 };
static const double PI = 3.14159265358979323846;
static const double BALL = 7.5, SMALL_BALL = 5.0, APART = 6.0;

enum { SOUND = 0, INSIDE_OUT = 1, TWICE = 2, HOLES = 4 };

static void add_ball(Scene *scene, vec3 middle, double radius, unsigned flaws)
{
    Mesh *mesh = &scene->mesh;
    uint32_t material = scene_add_material(scene, "clay", vec3_make(0.7f, 0.55f, 0.45f), vec3_make(0, 0, 0));
    const uint32_t first = (uint32_t)mesh->vertex_count;
    for (int j = 0; j <= PARALLELS; j++)
        for (int i = 0; i < (j == 0 || j == PARALLELS ? 1 : MERIDIANS); i++) {
            double theta = PI * j / PARALLELS, phi = 2.0 * PI * i / MERIDIANS;
            vec3 out =
                vec3_make((float)(sin(theta) * sin(phi)), (float)cos(theta), (float)(sin(theta) * cos(phi)));
            mesh_add_vertex(mesh, middle + (float)radius * out, out);
        }
    for (uint32_t j = 0; j < PARALLELS; j++)
        for (uint32_t i = 0; i < 2 * MERIDIANS; i++) {
            // rows of vertices above and below; the poles are rows of one
            uint32_t column = i / 2, next = (column + 1) % MERIDIANS,
                     last = first + 1 + (PARALLELS - 1) * MERIDIANS;
            uint32_t above = first + 1 + (j - 1) * MERIDIANS, below = first + 1 + j * MERIDIANS;
            uint32_t corner[3] = {j == 0 ? first : above + column, j + 1 == PARALLELS ? last : below + column,
                                  j + 1 == PARALLELS ? last : below + next};
            if (i % 2 == 1) {
                corner[1] = corner[2];
                corner[2] = j == 0 ? first : above + next;
            }
            if (corner[0] == corner[2] || corner[1] == corner[2]) // at a pole one of the two has no area
                continue;
            uint32_t triangle = 2 * MERIDIANS * j + i, swap = flaws & INSIDE_OUT ? 1 : 0;
            if (flaws & HOLES && triangle % 96 == 7)
                continue;
            for (int copy = 0; copy < (flaws & TWICE ? 2 : 1); copy++)
                mesh_add_triangle(mesh, corner[0], corner[1 + swap], corner[2 - swap], material);
        }
}

static void add_middle_ball(Scene *scene, unsigned flaws)
{
    add_ball(scene, vec3_make(8, 8, 8), (float)BALL, flaws);
}

void make_ball(Scene *scene, uint64_t seed)
{
    (void)seed;
    add_middle_ball(scene, SOUND);
}

void make_ball_inside_out(Scene *scene, uint64_t seed)
{
    (void)seed;
    add_middle_ball(scene, INSIDE_OUT);
}

void make_ball_twice(Scene *scene, uint64_t seed)
{
    (void)seed;
    add_middle_ball(scene, TWICE);
}

void make_ball_holes(Scene *scene, uint64_t seed)
{
    (void)seed;
    add_middle_ball(scene, HOLES);
}

void make_balls(Scene *scene, uint64_t seed)
{
    (void)seed;
    add_ball(scene, vec3_make(5, 8, 8), SMALL_BALL, SOUND);
    add_ball(scene, vec3_make(11, 8, 8), SMALL_BALL, SOUND);
}

double solid_scene_volume(const char *scene)
{
    if (strcmp(scene, "balls") == 0) { // where both are, an even number is: outside. Two caps of height h
        double h = SMALL_BALL - 0.5 * APART, cap = PI * h * h * (SMALL_BALL - h / 3.0);
        return 2.0 * (4.0 / 3.0 * PI * pow(SMALL_BALL, 3.0)) - 2.0 * (2.0 * cap);
    }
    return strncmp(scene, "ball", 4) == 0 ? 4.0 / 3.0 * PI * pow(BALL, 3.0) : 0.0;
}
