// cases: what epipolar space does at its edges: eye, light and occluders where an angle, a distance or a picture degenerates.
#include "judge.h"

#include <stdlib.h>
#include <string.h>

static double sum_of(const Image *image)
{
    double sum = 0.0;
    for (int i = 0; i < image->width * image->height * 3; i++)
        sum += (double)image->pixels[i / 3 * 4 + i % 3];
    return sum;
}

// The metric rel_rmse of (got - truth), or of its change from `before` (NULL: of itself).
static double relative_rms(const Image *got, const Image *truth, const Image *got_before,
                           const Image *truth_before)
{
    const int values = got->width * got->height * 3;
    const double mean = sum_of(truth) / values;
    double sum = 0.0;
    for (int i = 0; i < values; i++) {
        const int at = i / 3 * 4 + i % 3;
        double error = (double)got->pixels[at] - (double)truth->pixels[at];
        if (got_before)
            error -= (double)got_before->pixels[at] - (double)truth_before->pixels[at];
        error /= (double)truth->pixels[at] + 0.1 * mean;
        sum += error * error;
    }
    return sqrt(sum / values);
}

static bool is(const Run *run, const char *name)
{
    return strcmp(run_case(run), name) == 0;
}

// A light shut in, or an eye: nothing of its airlight is seen. Beside the outline of the light's box a voxel whose middle lies inside the box may be asked for a
// ray that passes outside: a thousandth of the light at most, were nothing in its way.
static void check_dark(Run *run, const Raster *raster, const Camera *camera, const RenderSettings *settings,
                       const Image *got)
{
    AirlightSettings open = settings->airlight;
    open.method = "segments";
    open.shader = NULL;
    open.shadowed = false;
    Image unshadowed =
        airlight_picture(raster, run_scene(run), camera, got->width, got->height, settings->map, &open);
    run_check(run, "sum", 0.0, sum_of(got), 1e-3 * sum_of(&unshadowed), image_count_nonfinite(got));
    image_free(&unshadowed);
}

// Lengths times `scale`, σ over it, intensity times its square: the same radiance. Every length is rounded anew (2^-24), so a ray that passes a voxel's or a
// texel's border within that may fall on the other side: a voxel's share of some pixels' rays.
static void check_scaled(Run *run, const Raster *raster, const Camera *camera, const RenderSettings *settings,
                         const Image *got, float scale)
{
    Scene scene = *run_scene(run);
    Camera eye = *camera;
    const size_t floats = 3 * scene.mesh.vertex_count;
    const float *positions = scene.mesh.positions;
    Light light = scene.lights[0];
    scene.mesh.positions = memory_new(floats + 1, sizeof(float), "positions");
    for (size_t i = 0; i < floats; i++)
        scene.mesh.positions[i] = scale * positions[i];
    light.position *= scale;
    light.radius *= scale;
    light.intensity *= scale * scale;
    scene.lights = &light;
    scene.lower *= scale;
    scene.upper *= scale;
    scene.medium.scattering /= scale;
    scene.medium.absorption /= scale;
    eye.eye *= scale;
    eye.target *= scale;
    eye.near_distance *= scale;
    Image image = render_picture(raster, &scene, &eye, got->width, got->height, settings);
    const ImageError error = image_compare(&image, got);
    run_check(run, "nrmse", 0.0, error.nrmse, 2e-3, image_count_nonfinite(&image));
    run_check(run, "mean_ratio", 1.0, error.mean_ratio, 1e-3, image_count_nonfinite(got));
    image_free(&image);
    free(scene.mesh.positions);
}

// A camera that moves by about an eighth of a pixel a frame to the right and a sixteenth up. The grid is to the picture as the paper's is (2048 θ and 512 α for
// 1024²), so that neighbours share its rows and errors stay where they are: the picture changes as the exact one does, to within its own error. Under a grid much
// finer than the picture errors are independent from frame to frame, and flicker is √2 of them. Both are measured against the same map integrated exactly:
// outlines that the rasterizer snaps to 1/256 of a pixel flicker in all methods alike.
static void check_flicker(Run *run, const Raster *raster, const Camera *camera,
                          const RenderSettings *settings)
{
    enum { FRAMES = 4, SIDE = 64 };
    const float pixel =
        2.0f * tanf(0.5f * camera->vertical_fov_rad) / SIDE * vec3_length(camera->target - camera->eye);
    const mat4 turn = camera_view(*camera); // its rows are the axes
    vec3 shift = {0};
    for (int k = 0; k < 3; k++)
        shift[k] = pixel * (0.127f * turn.column[k][0] + 0.0613f * turn.column[k][1]);
    Image got[FRAMES], converged[FRAMES];
    AirlightSettings limit = settings->airlight;
    limit.method = "segments";
    limit.shader = NULL;
    limit.nodes = 24;
    double flicker = 0.0, error = 0.0;
    long nonfinite = 0;
    for (int i = 0; i < FRAMES; i++) {
        Camera moved = *camera;
        moved.eye += (float)i * shift;
        moved.target += (float)i * shift;
        got[i] = render_picture(raster, run_scene(run), &moved, SIDE, SIDE, settings);
        converged[i] = airlight_picture(raster, run_scene(run), &moved, SIDE, SIDE, settings->map, &limit);
        nonfinite += image_count_nonfinite(&got[i]);
        error += relative_rms(&got[i], &converged[i], NULL, NULL) / FRAMES;
        if (i > 0)
            flicker += relative_rms(&got[i], &converged[i], &got[i - 1], &converged[i - 1]) / (FRAMES - 1);
    }
    for (int i = 0; i < FRAMES; i++) {
        image_free(&got[i]);
        image_free(&converged[i]);
    }
    run_check(run, "flicker", 0.0, flicker, error, nonfinite);
}

// Against the truth. In the open no border is met, and what is left is the closed forms' 1e-4 and the rounding of vectors. With shadows a border is met to
// within a voxel of each axis and a texel: a few hundredths of a ray that meets one or two.
static void check_truth(Run *run, const Camera *camera, const RenderSettings *settings, const Image *got)
{
    Scene scene = *run_scene(run);
    Light light = scene.light_count > 0 ? scene.lights[0] : (Light){0};
    scene.lights = &light;
    // Two limits: of a light that comes nearer to a wall from before it, and of a sheet that grows thinner than any ray is wide.
    if (is(run, "light on a wall"))
        light.position[2] += 1e-4f;
    if (is(run, "occluder edge-on to the epipole"))
        scene.mesh.triangle_count = 0;
    Image truth = judge_truth(&scene, camera, got->width, got->height, 1, &settings->airlight, -1.0f);
    const bool open = run_scene(run)->mesh.triangle_count == 0;
    const ImageError error = image_compare(got, &truth);
    run_check(run, "sum", sum_of(&truth), sum_of(got), (open ? 1e-3 : 2e-2) * sum_of(&truth),
              image_count_nonfinite(got));
    run_check(run, "rel_rmse", 0.0, error.rel_rmse, open ? 1e-3 : 6e-2, image_count_nonfinite(got));
    image_free(&truth);
}

void judge_case(Run *run, const Raster *raster, const Camera *camera, const RenderSettings *settings,
                const Image *got)
{
    if (is(run, "eye inside an occluder") || is(run, "occluder around the light"))
        check_dark(run, raster, camera, settings, got);
    else if (is(run, "larger"))
        check_scaled(run, raster, camera, settings, got, 1e6f);
    else if (is(run, "smaller"))
        check_scaled(run, raster, camera, settings, got, 1e-6f);
    else if (is(run, "subpixel path"))
        check_flicker(run, raster, camera, settings);
    else
        check_truth(run, camera, settings, got);
}

#define SIZE "33x33" // odd: one ray goes straight ahead
const RunRow judge_cases[] = {
    // where the light stands
    {"light in front", "stage", "method=map", SIZE},
    {"light beside", "stage", "method=map eye=0.3,1.2,-1.9 target=-3,1,-1.9 light_position=0.9,1.6,-1.9",
     SIZE},
    {"light behind", "stage", "method=map light_position=0.5,1.7,5.5", SIZE},
    {"light at the eye", "stage", "method=map light_position=0.3,1.2,3.5", SIZE},
    {"light at the eye, in the open", "mist", "method=map light_position=0,0,0", SIZE},
    {"light 1e-6 from the eye", "stage", "method=map light_position=0.3,1.200001,3.5", SIZE},
    {"light 1e-6 from the eye, in the open", "mist", "method=map light_position=0,1e-6,0", SIZE},
    {"light on a wall", "stage", "method=map light_position=0.9,1.6,-4", SIZE},
    {"light at the centre", "stage", "method=map target=0.8,1.6,-2.2", SIZE},
    {"light just off the centre", "stage", "method=map target=0.8,1.60001,-2.2", SIZE},
    {"light at the centre, in the open", "mist", "method=map light_position=0,0,-3", SIZE},
    {"light straight above", "stage", "method=map light_position=0.3,2.5,3.5", SIZE},
    {"directional", "stage_sun", "method=map", SIZE},
    {"directional, from straight ahead", "stage_sun", "method=map target=0.3,5,-2 light_direction=0,-3.8,5.5",
     SIZE},
    {"directional, from straight behind", "stage_sun", "method=map light_direction=-0.1,-0.2,-4.5", SIZE},
    {"light 1e6 away", "stage",
     "method=map light_position=4e5,6e5,3e5 light_intensity=4e12,4e12,4e12 scattering=1e-7,1e-7,1e-7 "
     "absorption=0,0,0",
     SIZE},
    // where occluders stand
    {"occluder around the light", "lamp_in_box", "method=map", SIZE},
    {"occluder over the epipole", "plate", "method=map", SIZE},
    {"occluder edge-on to the epipole", "edge_on", "method=map", SIZE},
    {"occluder around eye and light", "in_one_box", "method=map", SIZE},
    {"eye inside an occluder", "lamp_in_box", "method=map eye=0.1,0.6,2.9 target=0.2,1,-1", SIZE},
    // pictures
    {"sky", "pole", "method=map", SIZE},
    {"empty", "empty", "method=map", SIZE},
    {"one pixel", "stage", "method=map", "1x1"},
    {"larger", "stage", "method=map", SIZE},
    {"smaller", "stage", "method=map", SIZE},
    {"subpixel path", "stage", "method=map alpha=32 theta=128", SIZE},
    {NULL, NULL, NULL, NULL},
};
