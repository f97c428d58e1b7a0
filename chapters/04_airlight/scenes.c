// scenes: see scenes.h.
#include "scenes.h"

static Medium haze(float scattering, float absorption)
{
    return (Medium){vec3_make(scattering, scattering, scattering),
                    vec3_make(absorption, absorption, absorption), 0.0f};
}

static Camera look_ahead(void)
{
    return (Camera){vec3_make(0, 0, 0), vec3_make(0, 0, -1), vec3_make(0, 1, 0), 1.0f, 0, 0};
}

static void make_haze(Scene *scene, uint64_t seed)
{
    (void)seed;
    scene_add_light(
        scene,
        (Light){.kind = LIGHT_POINT, .position = vec3_make(0.3f, 0.2f, -3), .intensity = vec3_make(4, 3, 2)});
    scene->medium = haze(0.2f, 0.05f);
    scene->camera = look_ahead();
}

static void make_beam(Scene *scene, uint64_t seed)
{
    (void)seed;
    scene_add_light(scene, (Light){.kind = LIGHT_SPOT,
                                   .position = vec3_make(-2, 1.5f, -3),
                                   .direction = vec3_make(1, -0.6f, 0.1f),
                                   .intensity = vec3_make(4, 3, 2),
                                   .half_angle_rad = 0.2f});
    scene->medium = haze(0.2f, 0.05f);
    scene->camera = look_ahead();
}

static void make_sun(Scene *scene, uint64_t seed)
{
    (void)seed;
    scene_add_light(scene, (Light){.kind = LIGHT_DIRECTIONAL,
                                   .direction = vec3_make(0.3f, -1, -0.2f),
                                   .intensity = vec3_make(5, 4, 3)});
    scene->medium = haze(0.2f, 0.05f);
    scene->camera = look_ahead();
}

// A screen with a small square hole, a bright light behind it, a wall where the beam ends.
static void make_pinhole(Scene *scene, uint64_t seed)
{
    (void)seed;
    Mesh *mesh = &scene->mesh;
    const uint32_t grey = scene_add_material(scene, "grey", vec3_make(0.5f, 0.5f, 0.5f), vec3_make(0, 0, 0));
    const float hole = 0.02f, side = 1.5f;
    const vec3 x = vec3_make(1, 0, 0), y = vec3_make(0, 1, 0);
    // below, above, left, right of the hole, which is centred on the light's height
    mesh_add_quad(mesh, vec3_make(-side, -side, 0), 2 * side * x, (side - hole) * y, grey);
    mesh_add_quad(mesh, vec3_make(-side, hole, 0), 2 * side * x, (side - hole) * y, grey);
    mesh_add_quad(mesh, vec3_make(-side, -hole, 0), (side - hole) * x, 2 * hole * y, grey);
    mesh_add_quad(mesh, vec3_make(hole, -hole, 0), (side - hole) * x, 2 * hole * y, grey);
    mesh_add_quad(mesh, vec3_make(-side, -side, 3), 2 * side * x, 2 * side * y, grey);
    scene_add_light(scene, (Light){.kind = LIGHT_POINT,
                                   .position = vec3_make(0, 0, -0.5f),
                                   .intensity = vec3_make(400, 400, 400)});
    scene->medium = haze(0.2f, 0.05f);
    scene->camera =
        (Camera){vec3_make(-1.2f, 0.3f, 1.5f), vec3_make(0, 0, 1.2f), vec3_make(0, 1, 0), 1.0f, 0, 0};
}

// A block between eye and light, another beside them.
static void make_blocks(Scene *scene, uint64_t seed)
{
    (void)seed;
    Mesh *mesh = &scene->mesh;
    const uint32_t grey = scene_add_material(scene, "grey", vec3_make(0.5f, 0.5f, 0.5f), vec3_make(0, 0, 0));
    mesh_add_box(mesh, vec3_make(-0.4f, -0.5f, -0.3f), vec3_make(0.1f, 0.25f, 0.3f), grey);
    mesh_add_box(mesh, vec3_make(-0.7f, 0.4f, -0.9f), vec3_make(0.8f, 0.6f, -0.4f), grey);
    scene_add_light(scene, (Light){.kind = LIGHT_POINT,
                                   .position = vec3_make(1.1f, 0.15f, -0.2f),
                                   .intensity = vec3_make(4, 3, 2)});
    scene->medium = haze(0.4f, 0.1f);
    scene->camera = (Camera){vec3_make(-1, 0, 0.1f), vec3_make(1, 0, 0), vec3_make(0, 1, 0), 1.0f, 0, 0};
}

static void make_two_lights(Scene *scene, uint64_t seed)
{
    make_blocks(scene, seed);
    scene_add_light(scene, (Light){.kind = LIGHT_SPOT,
                                   .position = vec3_make(0.5f, 1.2f, 1),
                                   .direction = vec3_make(-0.5f, -1.2f, -1),
                                   .intensity = vec3_make(9, 9, 12),
                                   .half_angle_rad = 0.5f});
}

const SceneKind airlight_scenes[] = {
    {"haze", "a point light in nothing but mist", make_haze},
    {"beam", "a narrow spot in nothing but mist", make_beam},
    {"sun", "a directional light in endless mist", make_sun},
    {"pinhole", "a bright light behind a screen with a hole of 4 cm", make_pinhole},
    {"blocks", "a block between the eye and a point light, another beside", make_blocks},
    {"two_lights", "the blocks under a second light, a spot", make_two_lights},
    {NULL, NULL, NULL},
};

#define SIZE "33x33" // odd: one ray goes straight ahead
const RunRow airlight_cases[] = {
    // invariances, which need no truth
    {"no medium", "blocks", "method=segments scattering=0,0,0 absorption=0,0,0", SIZE},
    {"pure absorption", "blocks", "method=segments scattering=0,0,0 absorption=0.7,0.7,0.7", SIZE},
    {"linear", "two_lights", "method=segments", SIZE},
    {"additive", "two_lights", "method=segments", SIZE},
    {"larger", "two_lights", "method=segments", SIZE},
    {"smaller", "two_lights", "method=segments", SIZE},
    {"reciprocal", "blocks", "method=segments map=1024", SIZE},
    // against the truth
    {"closed form", "haze", "method=gauss", SIZE},
    {"segments in the open", "haze", "method=segments", SIZE},
    {"cone", "beam", "method=segments", SIZE},
    {"endless mist", "sun", "method=segments", SIZE},
    {"forward peak", "haze", "method=gauss phase=henyey_greenstein mean_cosine=0.999", SIZE},
    {"backward peak", "haze", "method=gauss phase=henyey_greenstein mean_cosine=-0.999", SIZE},
    {"light on the ray", "haze", "method=gauss light_position=0,0,-3", SIZE},
    {"light on the ray, equiangular", "haze", "method=equiangular steps=256 light_position=0,0,-3", SIZE},
    {"light at the eye", "haze", "method=gauss light_position=0,0,0", SIZE},
    {"light at the eye, equiangular", "haze", "method=equiangular steps=1024 light_position=0,0,0", SIZE},
    {"light behind", "haze", "method=gauss light_position=0,0,5", SIZE},
    {"light far off", "haze",
     "method=gauss light_position=3e6,1e6,-1e6 light_intensity=1e15,1e15,1e15 scattering=1e-7,1e-7,1e-7 "
     "absorption=0,0,0",
     SIZE},
    {"thick", "haze",
     "method=gauss light_position=0.001,0,-0.001 scattering=900,900,900 absorption=100,100,100", SIZE},
    {"thick, coloured", "haze",
     "method=gauss light_position=0.001,0,-0.001 scattering=900,90,9 absorption=100,1000,1", SIZE},
    {"pinhole", "pinhole", "method=segments map=2048", SIZE},
    {"pinhole, thick", "pinhole",
     "method=segments map=2048 scattering=20,20,20 light_intensity=1e12,1e12,1e12", SIZE},
#include "worst.inc"
    {NULL, NULL, NULL, NULL},
};
