// The truth's light at the number of samples that chapters use: unbiased, and its errors are what they say.
#include "raster.h"
#include "truth_scenes.h"

enum { SIZE = 16, VALUES = 3 * SIZE * SIZE };

static TruthPicture picture_of(const Truth *truth, const Scene *scene, TruthPathSettings settings)
{
    return truth_radiance(truth, scene, &scene->camera, SIZE, SIZE, &settings);
}

static void free_both(TruthPicture *a, TruthPicture *b)
{
    truth_picture_free(a);
    truth_picture_free(b);
}

// A reference that is exact enters with no error of its own.
static TruthPicture uniform_picture(vec3 radiance)
{
    TruthPicture picture = {image_make(SIZE, SIZE, 3), image_make(SIZE, SIZE, 3)};
    for (size_t i = 0; i < VALUES; i++)
        picture.mean.pixels[i] = radiance[i % 3];
    return picture;
}

Test(truth_slow, furnace_at_1024_and_4096_samples, .timeout = 300)
{
    const vec3 emission = vec3_make(1, 0.5f, 2), albedo = vec3_make(0.2f, 0.5f, 0.9f);
    Scene *scene = furnace(emission, albedo);
    Truth *truth = scene_ready(scene);
    const vec3 limit = emission / (vec3_make(1, 1, 1) - albedo + (vec3){0, 0, 0, 1});
    for (int samples = 1024; samples <= 4096; samples *= 4) {
        TruthPicture picture = picture_of(
            truth, scene, (TruthPathSettings){.samples = samples, .bounces = TRUTH_FULL, .seed = 11});
        TruthPicture reference = uniform_picture(limit);
        check_same_mean(&picture, &reference, "furnace");
        free_both(&picture, &reference);
    }
    scene_end(scene, truth);
}

// Against 16 times as many samples of another seed: the reference's own error, a quarter of the judged one's, widens the bound by 3 %.
Test(truth_slow, cornell_at_1024_and_4096_samples, .timeout = 300)
{
    Scene *scene = scene_open("cornell", 1);
    Truth *truth = truth_open(&scene->mesh);
    TruthPathSettings settings = {.samples = 65536, .bounces = TRUTH_FULL, .seed = 1};
    TruthPicture reference = picture_of(truth, scene, settings);
    for (settings.samples = 1024; settings.samples <= 4096; settings.samples *= 4) {
        settings.seed++;
        TruthPicture picture = picture_of(truth, scene, settings);
        check_same_mean(&picture, &reference, "cornell");
        truth_picture_free(&picture);
    }
    truth_picture_free(&reference);
    scene_end(scene, truth);
}

// An estimator that never looks for the lamp, only meets it, against one that finds it by area too.
Test(truth_slow, lamp_by_direction_and_by_both, .timeout = 300)
{
    Scene *scene = cornell_with_lamp();
    Truth *truth = scene_ready(scene);
    TruthPicture both =
        picture_of(truth, scene, (TruthPathSettings){.samples = 1024, .bounces = TRUTH_FULL, .seed = 21});
    TruthPicture direction = picture_of(
        truth, scene,
        (TruthPathSettings){
            .samples = 16384, .bounces = TRUTH_FULL, .emitters = TRUTH_EMITTERS_BY_DIRECTION, .seed = 22});
    check_same_mean(&both, &direction, "lamp");
    free_both(&both, &direction);
    scene_end(scene, truth);
}

// Both draw the same view of the same model and share no code but the camera's matrix: the same side, the same normals, the same units.
Test(truth_slow, direct_light_is_the_rasters, .timeout = 300)
{
    const char *names[] = {"bunny", "cornell", "colonnade", "huge", "tiny"};
    enum { WIDTH = 160, HEIGHT = 96 };
    gl_open(gl_headless_platform(), 0, 0, "slow_truth_path");
    Raster *raster = raster_open();
    for (int i = 0; i < 5; i++) {
        Scene *scene = scene_open(names[i], 1);
        Truth *truth = truth_open(&scene->mesh);
        const float aspect = (float)WIDTH / HEIGHT;
        RasterMesh mesh = raster_mesh(scene);
        GBuffer gbuffer = raster_gbuffer(WIDTH, HEIGHT);
        GLuint lit = gl_texture(.label = "lit", .format = GL_RGBA32F, .width = WIDTH, .height = HEIGHT);
        raster_gbuffer_draw(raster, &gbuffer, &scene->camera, &mesh);
        raster_light_begin(raster, &gbuffer, lit, 0.0f);
        for (size_t light = 0; light < scene->light_count; light++) {
            DepthMap map = raster_depth_map(scene, &scene->lights[light], 2048, &scene->camera, aspect);
            raster_depth_map_draw(raster, &map, &scene->lights[light], &mesh);
            raster_light_add(raster, &gbuffer, &scene->camera, &scene->lights[light], &map, lit);
            raster_depth_map_delete(&map);
        }
        static float drawn[4 * WIDTH * HEIGHT];
        gl_texture_read(lit, 0, GL_RGBA, GL_FLOAT, sizeof drawn, drawn);
        TruthPicture picture =
            truth_radiance(truth, scene, &scene->camera, WIDTH, HEIGHT, &(TruthPathSettings){.samples = 1});
        int near = 0, bright = 0;
        for (int p = 0; p < WIDTH * HEIGHT; p++) {
            const size_t column = (size_t)p % WIDTH,
                         row = HEIGHT - 1 - (size_t)p / WIDTH; // a texture's row 0 is the lowest
            double a = (double)drawn[4 * p + 1],
                   b = (double)channel_of(&picture.mean, row * WIDTH + column, 1);
            bright += b > 0.0;
            near +=
                fabs(a - b) <= 2e-3 * fmax(a, b) + 1e-4; // half floats hold normals and albedo, 5·10⁻⁴ each
        }
        // The rest: pixels on the shadow's border, where a map of 2048² errs by a texel, and where the surface turns from the light
        cr_expect(near >= 0.99 * WIDTH * HEIGHT, "%s: only %d of %d pixels agree", names[i], near,
                  WIDTH * HEIGHT);
        cr_expect(bright > WIDTH * HEIGHT / 50, "%s: only %d pixels are lit", names[i], bright);
        truth_picture_free(&picture);
        gl_texture_delete(&lit);
        raster_gbuffer_delete(&gbuffer);
        raster_mesh_delete(&mesh);
        scene_end(scene, truth);
    }
    raster_close(raster);
    gl_close();
}
