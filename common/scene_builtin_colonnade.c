// scene_builtin_colonnade: a courtyard between two storeys of arcades, open to the sky, as large as Sponza's atrium. Heights and widths
// in metres. Each of the four sides is built in a frame of its own: x runs along the wall, y up, z into the court.
#include "scene_builtin_colonnade.h"

static const float PI = 3.14159265f;
static const float GALLERY = 3.9f; // from the columns' line to the outer wall
static const float WALL = 0.4f;    // outer wall's thickness
static const float ROOF_SLOPE = 0.36f;
enum { BAYS_LONG = 8, BAYS_SHORT = 3 };

static void add_stuff(Scene *scene)
{
    static const struct {
        const char *name;
        float red, green, blue;
    } stuff[STUFF_COUNT] = {
        [STONE] = {"stone", 0.62f, 0.55f, 0.44f},
        [PALE_STONE] = {"pale stone", 0.74f, 0.69f, 0.59f},
        [DARK_STONE] = {"dark stone", 0.27f, 0.24f, 0.21f},
        [PLASTER] = {"plaster", 0.76f, 0.70f, 0.58f},
        [BRICK] = {"brick", 0.50f, 0.17f, 0.09f},
        [WOOD] = {"wood", 0.24f, 0.13f, 0.06f},
        [ROOF_RED] = {"roof tile, red", 0.52f, 0.20f, 0.11f},
        [ROOF_BROWN] = {"roof tile, brown", 0.43f, 0.19f, 0.11f},
        [OCHRE] = {"ochre panel", 0.68f, 0.45f, 0.13f},
        [POMPEIAN_RED] = {"red panel", 0.46f, 0.09f, 0.06f},
        [TEAL] = {"teal panel", 0.09f, 0.30f, 0.31f},
        [CLOTH_RED] = {"red cloth", 0.60f, 0.05f, 0.05f},
        [CLOTH_GREEN] = {"green cloth", 0.09f, 0.36f, 0.09f},
        [CLOTH_BLUE] = {"blue cloth", 0.06f, 0.13f, 0.48f},
        [TERRACOTTA] = {"terracotta", 0.58f, 0.27f, 0.15f},
        [LEAF] = {"leaves", 0.12f, 0.27f, 0.06f},
        [WATER] = {"water", 0.08f, 0.22f, 0.27f},
        [BRONZE] = {"bronze", 0.24f, 0.30f, 0.22f},
        [TILE_WARM] = {"warm floor tile", 0.52f, 0.38f, 0.27f},
        [TILE_GREY] = {"grey floor tile", 0.40f, 0.39f, 0.37f},
        [TILE_PALE] = {"pale floor tile", 0.64f, 0.59f, 0.51f},
    };
    for (int i = 0; i < STUFF_COUNT; i++)
        scene_add_material(scene, stuff[i].name, vec3_make(stuff[i].red, stuff[i].green, stuff[i].blue),
                           vec3_make(0, 0, 0));
}

// Outer wall with its painted panels, gallery floor with beams, cornice, roof.
static void gallery(Mesh *mesh, const Frame *side, int bays)
{
    const bool corners = bays == BAYS_LONG; // the long sides own the four corners
    const float length = BAY * (float)bays, reach = corners ? GALLERY + WALL : GALLERY,
                floor_reach = corners ? GALLERY : 0;
    colonnade_block(mesh, side, vec3_make(-reach, 0, -GALLERY - WALL),
                    vec3_make(length + reach, 10.85f, -GALLERY), PLASTER);
    colonnade_block(mesh, side, vec3_make(-floor_reach, 4.95f, -GALLERY),
                    vec3_make(length + floor_reach, FIRST_FLOOR, -0.02f), STONE);
    const float short_by = corners ? 0 : 0.6f;
    colonnade_block(mesh, side, vec3_make(short_by, 4.85f, 0.28f), vec3_make(length - short_by, 5.02f, 0.42f),
                    STONE);
    colonnade_block(mesh, side, vec3_make(short_by, 5.02f, 0.28f),
                    vec3_make(length - short_by, FIRST_FLOOR + 0.02f, 0.6f), PALE_STONE);
    colonnade_block(mesh, side, vec3_make(short_by, 9.2f, 0.2f), vec3_make(length - short_by, 9.42f, 0.5f),
                    PALE_STONE);
    colonnade_block(mesh, side, vec3_make(-GALLERY, 0, -GALLERY - 0.01f),
                    vec3_make(length + GALLERY, 0.8f, -GALLERY + 0.06f), DARK_STONE);
    for (int i = 0; i < bays; i++) {
        static const Stuff panel[3] = {OCHRE, POMPEIAN_RED, TEAL};
        const float centre = BAY * ((float)i + 0.5f), back = -GALLERY - 0.01f, start = centre - BAY / 2;
        colonnade_block(mesh, side, vec3_make(centre - 1.1f, 1.0f, back),
                        vec3_make(centre + 1.1f, 3.9f, -GALLERY + 0.04f), panel[i % 3]);
        colonnade_block(mesh, side, vec3_make(centre - 1.1f, 6.2f, back),
                        vec3_make(centre + 1.1f, 8.6f, -GALLERY + 0.04f), panel[(i + 1) % 3]);
        colonnade_block(mesh, side, vec3_make(start - 0.2f, 0, back),
                        vec3_make(start + 0.2f, 4.95f, -GALLERY + 0.14f), STONE);
        for (int beam = 0; beam < 3; beam++) {
            const float at = start + BAY * ((float)beam + 0.5f) / 3;
            colonnade_block(mesh, side, vec3_make(at - 0.08f, 4.72f, -GALLERY),
                            vec3_make(at + 0.08f, 4.96f, -0.28f), WOOD);
        }
    }
    // The roof falls towards the court; courses of tiles overlap like steps, mitred at the corners.
    enum { COURSES = 18 };
    const float eave = 0.65f, ridge = -GALLERY - WALL - 0.25f;
    for (int i = 0; i < COURSES; i++) {
        const float z0 = eave + (ridge - eave) * (float)i / COURSES,
                    z1 = eave + (ridge - eave) * (float)(i + 1) / COURSES;
        const float y0 = EAVES - ROOF_SLOPE * z0 + 0.16f, y1 = EAVES - ROOF_SLOPE * z1 + 0.1f,
                    lip = i > 0 ? 0.06f : 0.16f;
        const uint32_t tile = i % 2 ? ROOF_BROWN : ROOF_RED;
        frame_quad(mesh, side, vec3_make(z0, y0, z0), vec3_make(length - z0, y0, z0),
                   vec3_make(length - z1, y1, z1), vec3_make(z1, y1, z1), tile);
        frame_quad(mesh, side, vec3_make(z0, y0 - lip, z0), vec3_make(length - z0, y0 - lip, z0),
                   vec3_make(length - z0, y0, z0), vec3_make(z0, y0, z0), tile);
    }
    const float low = EAVES - ROOF_SLOPE * eave, high = EAVES - ROOF_SLOPE * ridge;
    frame_quad(mesh, side, vec3_make(eave, low, eave), vec3_make(ridge, high, ridge),
               vec3_make(length - ridge, high, ridge), vec3_make(length - eave, low, eave), WOOD);
}

static void side_of_court(Mesh *mesh, const Frame *side, int bays, Random *random)
{
    gallery(mesh, side, bays);
    // a pier in the corner where this side begins
    colonnade_block(mesh, side, vec3_make(-0.45f, 0, -0.45f), vec3_make(0.45f, 3.15f, 0.45f), STONE);
    colonnade_block(mesh, side, vec3_make(-0.5f, 3.15f, -0.5f), vec3_make(0.5f, 3.3f, 0.5f), PALE_STONE);
    colonnade_block(mesh, side, vec3_make(-0.4f, 3.3f, -0.4f), vec3_make(0.4f, EAVES, 0.4f), STONE);
    for (int i = 0; i < bays; i++) {
        const float start = BAY * (float)i, centre = start + BAY / 2;
        if (i > 0) {
            colonnade_lower_column(mesh, side, start);
            colonnade_upper_column(mesh, side, start);
        }
        colonnade_arch(mesh, side,
                       &(Arch){centre, 3.3f, FIRST_FLOOR, 1.12f, 0.3f, 0.3f, STONE, {PALE_STONE, BRICK}});
        colonnade_arch(mesh, side,
                       &(Arch){centre, 7.82f, EAVES, 1.24f, 0.2f, 0.22f, PLASTER, {PALE_STONE, STONE}});
        colonnade_balustrade(mesh, side, start);
        static const Stuff cloth[3] = {CLOTH_RED, CLOTH_GREEN, CLOTH_BLUE};
        if (bays == BAYS_LONG && i % 2 == 1)
            colonnade_curtain(mesh, side, centre, cloth[i / 2 % 3], random);
    }
}

static void paved_floor(Mesh *mesh, float half_x, float half_z, Random *random)
{
    enum { TILES_X = 42, TILES_Z = 22 };
    const float court_x = half_x - GALLERY, court_z = half_z - GALLERY;
    const float wide = 2 * half_x / TILES_X, deep = 2 * half_z / TILES_Z;
    for (int j = 0; j < TILES_Z; j++)
        for (int i = 0; i < TILES_X; i++) {
            const vec3 corner = vec3_make(-half_x + wide * (float)i, 0, -half_z + deep * (float)j);
            const bool court = fabsf(corner[0] + wide / 2) < court_x && fabsf(corner[2] + deep / 2) < court_z;
            const Stuff mixed = (Stuff)((int)TILE_WARM + (int)random_between(random, 0, 3));
            const Stuff tile = court ? mixed : (i + j) % 2 ? TILE_PALE : TERRACOTTA;
            mesh_add_quad(mesh, corner, vec3_make(0, 0, deep), vec3_make(wide, 0, 0), (uint32_t)tile);
        }
}

void make_colonnade(Scene *scene, uint64_t seed)
{
    Random random = {seed};
    Mesh *mesh = &scene->mesh;
    const float half_x = BAY * BAYS_LONG / 2, half_z = BAY * BAYS_SHORT / 2;
    add_stuff(scene);
    paved_floor(mesh, half_x + GALLERY, half_z + GALLERY, &random);
    const Frame sides[4] = {
        frame_at(vec3_make(-half_x, 0, -half_z), 0), frame_at(vec3_make(half_x, 0, half_z), PI),
        frame_at(vec3_make(-half_x, 0, half_z), PI / 2), frame_at(vec3_make(half_x, 0, -half_z), -PI / 2)};
    for (int i = 0; i < 4; i++)
        side_of_court(mesh, &sides[i], i < 2 ? BAYS_LONG : BAYS_SHORT, &random);
    colonnade_fountain(mesh);
    static const float trees[][2] = {{-7.5f, -3.2f}, {-1.5f, -3.3f}, {7.5f, -3.2f},
                                     {-4.5f, 3.3f},  {1.5f, 3.3f},   {7.5f, 3.2f}};
    for (size_t i = 0; i < sizeof trees / sizeof *trees; i++)
        colonnade_pot_and_tree(mesh, vec3_make(trees[i][0], 0, trees[i][1]), &random);
    scene_add_light(scene, (Light){.kind = LIGHT_DIRECTIONAL,
                                   .direction = vec3_make(0.3f, -0.8f, -0.5f),
                                   .intensity = vec3_make(5.0f, 4.6f, 4.0f)});
    scene->medium = (Medium){vec3_make(0.018f, 0.018f, 0.018f), vec3_make(0.002f, 0.002f, 0.002f), 0.6f};
    scene->camera =
        (Camera){vec3_make(-10.8f, 2.3f, 3.1f), vec3_make(0, 3.5f, -1.6f), vec3_make(0, 1, 0), 1.05f, 0, 0};
}
