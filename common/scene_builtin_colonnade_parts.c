// scene_builtin_colonnade_parts: columns, arches, curtains and what stands in the court. Profiles are {radius, height} in metres.
#include "scene_builtin_colonnade.h"

static const float PI = 3.14159265f;

void colonnade_block(Mesh *mesh, const Frame *side, vec3 lower, vec3 upper, Stuff stuff)
{
    frame_box(mesh, side, lower, upper, (uint32_t)stuff);
}

static void turned(Mesh *mesh, const Frame *side, vec3 foot, const vec2 *profile, int points, int segments,
                   Stuff stuff)
{
    Frame frame = *side;
    frame.origin = frame_point(side, foot[0], foot[1], foot[2]);
    frame_revolve(mesh, &frame, profile, points, segments, (uint32_t)stuff);
}
#define TURNED(mesh, side, foot, profile, segments, stuff)                                                   \
    turned(mesh, side, foot, profile, (int)(sizeof(profile) / sizeof *(profile)), segments, stuff)

void colonnade_lower_column(Mesh *mesh, const Frame *side, float along)
{
    static const vec2 base[] = {{0.37f, 0.16f}, {0.40f, 0.19f}, {0.41f, 0.23f}, {0.40f, 0.27f},
                                {0.37f, 0.29f}, {0.34f, 0.31f}, {0.33f, 0.34f}, {0.34f, 0.37f},
                                {0.35f, 0.40f}, {0.34f, 0.43f}, {0.31f, 0.44f}};
    static const vec2 shaft[] = {{0.305f, 0.44f}, {0.300f, 0.9f}, {0.292f, 1.4f},
                                 {0.280f, 1.9f},  {0.264f, 2.4f}, {0.250f, 2.70f}};
    static const vec2 capital[] = {{0.25f, 2.68f}, {0.29f, 2.70f}, {0.30f, 2.73f}, {0.29f, 2.76f},
                                   {0.26f, 2.78f}, {0.26f, 2.86f}, {0.28f, 2.94f}, {0.32f, 3.02f},
                                   {0.37f, 3.09f}, {0.39f, 3.13f}, {0.39f, 3.16f}};
    colonnade_block(mesh, side, vec3_make(along - 0.42f, 0, -0.42f), vec3_make(along + 0.42f, 0.17f, 0.42f),
                    DARK_STONE);
    TURNED(mesh, side, vec3_make(along, 0, 0), base, 28, PALE_STONE);
    TURNED(mesh, side, vec3_make(along, 0, 0), shaft, 28, STONE);
    TURNED(mesh, side, vec3_make(along, 0, 0), capital, 28, PALE_STONE);
    colonnade_block(mesh, side, vec3_make(along - 0.42f, 3.15f, -0.42f),
                    vec3_make(along + 0.42f, 3.3f, 0.42f), PALE_STONE);
}

void colonnade_upper_column(Mesh *mesh, const Frame *side, float along)
{
    static const vec2 column[] = {
        {0.24f, 6.20f}, {0.25f, 6.23f},  {0.24f, 6.27f}, {0.20f, 6.29f}, {0.19f, 6.33f}, {0.20f, 6.36f},
        {0.19f, 6.39f}, {0.165f, 6.40f}, {0.16f, 6.7f},  {0.152f, 7.0f}, {0.14f, 7.38f}, {0.17f, 7.39f},
        {0.17f, 7.43f}, {0.14f, 7.45f},  {0.15f, 7.53f}, {0.19f, 7.61f}, {0.24f, 7.67f}, {0.25f, 7.71f}};
    colonnade_block(mesh, side, vec3_make(along - 0.27f, FIRST_FLOOR, -0.27f),
                    vec3_make(along + 0.27f, 6.2f, 0.27f), STONE);
    TURNED(mesh, side, vec3_make(along, 0, 0), column, 22, PALE_STONE);
    colonnade_block(mesh, side, vec3_make(along - 0.29f, 7.7f, -0.29f),
                    vec3_make(along + 0.29f, 7.82f, 0.29f), PALE_STONE);
}

void colonnade_arch(Mesh *mesh, const Frame *side, const Arch *arch)
{
    enum { SEGMENTS = 30, SEGMENTS_A_STONE = 2 };
    const float rise = arch->top - arch->springing, corner = atan2f(rise, BAY / 2);
    const float deep = arch->half_thickness + 0.05f, flat = arch->half_thickness,
                outer_radius = arch->radius + arch->band;
    vec3 inner[SEGMENTS + 1], outer[SEGMENTS + 1], edge[SEGMENTS + 1];
    for (int i = 0; i <= SEGMENTS; i++) {
        float turn = PI * (float)i / SEGMENTS;
        const vec3 radial = vec3_make(cosf(turn), sinf(turn), 0),
                   centre = vec3_make(arch->centre, arch->springing, 0);
        if (fabsf(turn - corner) <= PI / 2 / SEGMENTS)
            turn = corner; // so that the spandrels end in the wall's corners
        if (fabsf(turn - (PI - corner)) <= PI / 2 / SEGMENTS)
            turn = PI - corner;
        const float c = cosf(turn), s = fmaxf(sinf(turn), 1e-6f);
        inner[i] = centre + arch->radius * radial;
        outer[i] = centre + outer_radius * radial;
        edge[i] = centre + fminf(BAY / 2 / fmaxf(fabsf(c), 1e-6f), rise / s) * vec3_make(c, sinf(turn), 0);
    }
    for (int i = 0; i < SEGMENTS; i++) {
        const uint32_t stone = (uint32_t)arch->stones[i / SEGMENTS_A_STONE % 2], wall = (uint32_t)arch->wall;
        for (int front = 0; front < 2; front++) {
            const vec3 d = vec3_make(0, 0, front ? deep : -deep), f = vec3_make(0, 0, front ? flat : -flat);
            const int a = front ? i : i + 1, b = front ? i + 1 : i; // seen from behind, the other way round
            frame_quad(mesh, side, inner[a] + d, outer[a] + d, outer[b] + d, inner[b] + d, stone);
            frame_quad(mesh, side, outer[a] + d, outer[a] + f, outer[b] + f, outer[b] + d, stone);
            frame_quad(mesh, side, outer[a] + f, edge[a] + f, edge[b] + f, outer[b] + f, wall);
        }
        const vec3 d = vec3_make(0, 0, deep);
        frame_quad(mesh, side, inner[i] - d, inner[i] + d, inner[i + 1] + d, inner[i + 1] - d, stone);
    }
    const vec3 left = vec3_make(arch->centre - BAY / 2, arch->top, 0), along = vec3_make(BAY, 0, 0),
               f = vec3_make(0, 0, flat);
    frame_quad(mesh, side, left + f, left + along + f, left + along - f, left - f, (uint32_t)arch->wall);
    const float crown = arch->springing + arch->radius;
    colonnade_block(mesh, side, vec3_make(arch->centre - 0.11f, crown - 0.06f, -deep - 0.05f),
                    vec3_make(arch->centre + 0.11f, crown + arch->band + 0.1f, deep + 0.05f), PALE_STONE);
}

void colonnade_balustrade(Mesh *mesh, const Frame *side, float start)
{
    static const vec2 baluster[] = {{0.06f, 5.30f},  {0.06f, 5.36f}, {0.04f, 5.39f},  {0.065f, 5.47f},
                                    {0.075f, 5.55f}, {0.06f, 5.66f}, {0.035f, 5.80f}, {0.033f, 5.92f},
                                    {0.055f, 5.96f}, {0.055f, 6.05f}};
    enum { BALUSTERS = 7 };
    colonnade_block(mesh, side, vec3_make(start + 0.27f, FIRST_FLOOR, -0.13f),
                    vec3_make(start + BAY - 0.27f, 5.31f, 0.13f), STONE);
    colonnade_block(mesh, side, vec3_make(start + 0.27f, 6.04f, -0.15f),
                    vec3_make(start + BAY - 0.27f, 6.17f, 0.15f), PALE_STONE);
    for (int i = 0; i < BALUSTERS; i++)
        TURNED(mesh, side, vec3_make(start + 0.27f + (BAY - 0.54f) * ((float)i + 0.5f) / BALUSTERS, 0, 0),
               baluster, 10, PALE_STONE);
}

void colonnade_curtain(Mesh *mesh, const Frame *side, float centre, Stuff cloth, Random *random)
{
    enum { ACROSS = 56, DOWN = 14 };
    const float top = 3.22f, length = random_between(random, 2.0f, 2.5f),
                folds = random_between(random, 5, 7);
    const float phase = random_between(random, 0, 2 * PI), half_width = random_between(random, 0.95f, 1.2f);
    colonnade_block(mesh, side, vec3_make(centre - 1.35f, top - 0.02f, -0.58f),
                    vec3_make(centre + 1.35f, top + 0.03f, -0.53f), WOOD);
    uint32_t first = 0;
    for (int j = 0; j <= DOWN; j++)
        for (int i = 0; i <= ACROSS; i++) {
            const float u = (float)i / ACROSS, v = (float)j / DOWN, turn = 2 * PI * folds * u + phase;
            const float depth = 0.04f + 0.07f * v, pull = 1 - 0.18f * sinf(PI * v);
            const vec3 p = vec3_make(centre + half_width * (2 * u - 1) * pull,
                                     top - length * v - 0.05f * v * sinf(2 * turn),
                                     -0.62f + depth * sinf(turn + 0.6f * v));
            // of the folds alone; how the cloth hangs hardly turns it
            const float slope = depth * cosf(turn + 0.6f * v) * PI * folds / (half_width * pull);
            const uint32_t vertex =
                mesh_add_vertex(mesh, frame_point(side, p[0], p[1], p[2]), frame_vector(side, -slope, 0, 1));
            first = i + j == 0 ? vertex : first;
        }
    for (uint32_t j = 0; j < DOWN; j++)
        for (uint32_t i = 0; i < ACROSS; i++) {
            const uint32_t v = first + j * (ACROSS + 1) + i, below = v + ACROSS + 1;
            mesh_add_triangle(mesh, v, below, below + 1, (uint32_t)cloth);
            mesh_add_triangle(mesh, v, below + 1, v + 1, (uint32_t)cloth);
        }
}

void colonnade_pot_and_tree(Mesh *mesh, vec3 foot, Random *random)
{
    static const vec2 pot[] = {{0.26f, 0},    {0.34f, 0.2f}, {0.40f, 0.45f}, {0.41f, 0.6f}, {0.46f, 0.61f},
                               {0.46f, 0.7f}, {0.40f, 0.7f}, {0.38f, 0.62f}, {0, 0.62f}};
    static const vec2 trunk[] = {{0.06f, 0.6f}, {0.05f, 1.0f}, {0.05f, 1.4f}};
    enum { AROUND = 26, RINGS = 16 };
    const Frame frame = frame_at(foot, random_between(random, 0, 6));
    TURNED(mesh, &frame, vec3_make(0, 0, 0), pot, 24, TERRACOTTA);
    TURNED(mesh, &frame, vec3_make(0, 0, 0), trunk, 8, WOOD);
    const float radius = random_between(random, 0.5f, 0.65f);
    vec3 grid[RINGS + 1][AROUND];
    for (int j = 0; j <= RINGS; j++)
        for (int i = 0; i < AROUND; i++) {
            const float theta = PI * (float)j / RINGS, phi = 2 * PI * (float)i / AROUND;
            const float ragged = j % RINGS ? random_between(random, 0.86f, 1.1f) : 1,
                        r = radius * ragged * sinf(theta);
            grid[j][i] =
                vec3_make(r * cosf(phi), 1.35f + radius * (1 - ragged * cosf(theta)), -r * sinf(phi));
        }
    for (int j = 0; j < RINGS; j++)
        for (int i = 0; i < AROUND; i++) {
            const int next = (i + 1) % AROUND;
            const vec3 a = foot + grid[j][i], b = foot + grid[j][next], c = foot + grid[j + 1][next],
                       d = foot + grid[j + 1][i];
            if (j > 0)
                mesh_add_flat_triangle(mesh, a, b, c, LEAF);
            if (j + 1 < RINGS)
                mesh_add_flat_triangle(mesh, a, c, d, LEAF);
        }
}

void colonnade_fountain(Mesh *mesh)
{
    static const vec2 step[] = {{2.2f, 0}, {2.2f, 0.15f}, {1.8f, 0.15f}};
    static const vec2 basin[] = {{1.7f, 0.15f},  {1.7f, 0.25f},  {1.6f, 0.28f},  {1.6f, 0.6f},
                                 {1.75f, 0.64f}, {1.75f, 0.74f}, {1.45f, 0.74f}, {1.45f, 0.3f}};
    static const vec2 water[] = {{1.45f, 0.6f}, {0, 0.6f}};
    static const vec2 urn[] = {{0.32f, 0.3f},  {0.32f, 0.7f},  {0.2f, 0.78f}, {0.13f, 0.95f}, {0.12f, 1.2f},
                               {0.16f, 1.35f}, {0.3f, 1.43f},  {0.55f, 1.5f}, {0.74f, 1.62f}, {0.8f, 1.76f},
                               {0.74f, 1.76f}, {0.6f, 1.66f},  {0.2f, 1.58f}, {0.1f, 1.62f},  {0.08f, 1.85f},
                               {0.13f, 1.95f}, {0.14f, 2.03f}, {0.1f, 2.12f}, {0, 2.16f}};
    const Frame centre = frame_at(vec3_make(0, 0, 0), PI / 8);
    TURNED(mesh, &centre, vec3_make(0, 0, 0), step, 8, DARK_STONE);
    TURNED(mesh, &centre, vec3_make(0, 0, 0), basin, 8, PALE_STONE);
    TURNED(mesh, &centre, vec3_make(0, 0, 0), water, 8, WATER);
    TURNED(mesh, &centre, vec3_make(0, 0, 0), urn, 32, BRONZE);
}
