// 01 voxelization: which cells of a regular grid does a surface touch?
//
// You should see the mesh with the grid's lines on it; then the voxels that plain rasterization finds, its misses in red; then all voxels
// that the surface touches; then the grid as a ray sees it that walks from voxel to voxel.
// Why so: a technique that stores light or shadow in voxels leaks through every hole, and pays for every voxel too many.
// Source: Gomes, "Real-time indirect illumination and volumetric shadows" (2015), sections 2.1 and 4.2.1, whose conservative listings (4.2 to
// 4.5) miss voxels; so the exact method follows Schwarz and Seidel (2010) instead. The walk: Amanatides and Woo (1987).
#include "attributes.h"
#include "judge.h"
#include "methods.h"
#include "run.h"
#include "scenes.h"
#include "walk.h"
#include <stdlib.h>

static const char *const scenes[] = {"bunny", "cornell", "colonnade", NULL};

// clang-format off
static const RunParameter parameters[] = {
    {.name = "method", .kind = RUN_CHOICE, .choices = "exact raster threepass slicing peeling msaa expanded binary solid", .shows = "how voxels are found"},
    {.name = "resolution", .kind = RUN_INTEGER, .least = 1, .most = 65536, .initial = {64}, .unit = "voxels", .shows = "voxels along the longest side"},
    {.name = "show", .kind = RUN_CHOICE, .choices = "normals steps distance", .shows = "colour of a voxel: its face's normal, the planes that the ray crossed, the distance"},
    {.name = "storage", .kind = RUN_CHOICE, .choices = "occupancy attributes list average", .shows = "what the voxels of method exact hold besides their bit"},
    {.name = "region_lower", .kind = RUN_VECTOR, .most = 1, .initial = {0, 0, 0}, .shows = "corner of the grid in the scene's box"},
    {.name = "region_upper", .kind = RUN_VECTOR, .most = 1, .initial = {1, 1, 1}, .shows = "opposite corner of the grid in the scene's box"},
    {.name = NULL},
};
// clang-format on

static const RunStep steps[] = {
    {"mesh", "the mesh, lit, with the grid's lines"},
    {"holes", "what rasterizing pixel centres (or another chosen method) finds; red: what it misses"},
    {"exact", "every voxel that the surface touches"},
    {"walk", "the chosen method's voxels along each pixel's ray"},
    {NULL, NULL},
};

#define SWEEP(method, resolution) {method, NULL, "method=" method " resolution=" #resolution, NULL},
#define SWEEPS(method)                                                                                       \
    SWEEP(method, 16)                                                                                        \
    SWEEP(method, 32) SWEEP(method, 64) SWEEP(method, 128) SWEEP(method, 256) SWEEP(method, 512)
// The same sphere in 10³, 10⁴, 10⁵, 10⁶ triangles.
#define SPHERE(method, triangles) {method, "sphere_" #triangles, "method=" method " resolution=128", NULL},
#define SPHERES(method)           SPHERE(method, 1e3) SPHERE(method, 1e4) SPHERE(method, 1e5) SPHERE(method, 1e6)
#define EACH_METHOD(DO)                                                                                      \
    DO("raster")                                                                                             \
    DO("threepass")                                                                                          \
    DO("slicing")                                                                                            \
    DO("peeling") DO("msaa") DO("expanded") DO("binary") DO("exact") DO("soli"                               \
                                                                        "d")
// clang-format off
static const RunRow sweep[] = {
    EACH_METHOD(SWEEPS)
    EACH_METHOD(SPHERES)
    {NULL, NULL, NULL, NULL},
};

// The cases that are hard for other methods than exact: 10⁶ triangles in a voxel, an edge along a grid line, a grid of 3 × 500 × 7, one of 1³.
#define HARD(method)                                                                                         \
    {method " crowd", "crowd", "method=" method " resolution=16", NULL},                                     \
    {method " edge", "edge", "method=" method " resolution=16", NULL},                                       \
    {method " beam", "beam", "method=" method " resolution=500", NULL},                                      \
    {method " one voxel", "cube", "method=" method " resolution=1", NULL},
static const RunRow stability[] = {
    {"cube 16", "cube", "method=exact resolution=16", NULL},
    {"cube 32", "cube", "method=exact resolution=32", NULL},
    {"cube in faces", "cube", "method=exact resolution=64", NULL},
    {"faces", "faces", "method=exact resolution=16", NULL},
    {"oblique", "oblique", "method=exact resolution=16", NULL},
    {"oblique 256", "oblique", "method=exact resolution=256", NULL},
    {"far", "far", "method=exact resolution=16", NULL},
    {"small", "small", "method=exact resolution=16", NULL},
    {"floor", "floor", "method=exact resolution=64", NULL},
    {"one voxel", "cube", "method=exact resolution=1", NULL},
    {"empty", "empty", "method=exact resolution=16", NULL},
    {"vast", "vast", "method=exact resolution=32 region_lower=0.4999995,0.4999995,0.4999995 region_upper=0.5000005,0.5000005,0.5000005", NULL},
    {"slivers", "slivers", "method=exact resolution=64", NULL},
    {"huge", "huge", "method=exact resolution=64", NULL},
    {"tiny", "tiny", "method=exact resolution=64", NULL},
    {"degenerate", "degenerate", "method=exact resolution=64", NULL},
    {"planar", "planar", "method=exact resolution=64", NULL},
    {"one point", "point", "method=exact resolution=16", NULL},
    {"smaller than a voxel", "speck", "method=exact resolution=16", NULL},
    {"crowd", "crowd", "method=exact resolution=16", NULL},
    {"edge", "edge", "method=exact resolution=16", NULL},
    {"beam", "beam", "method=exact resolution=500", NULL},
    HARD("raster") HARD("threepass") HARD("slicing") HARD("peeling") HARD("msaa") HARD("expanded") HARD("binary")
    {"ball", "ball", "method=solid resolution=128", NULL},
    {"ball inside out", "ball_inside_out", "method=solid resolution=128", NULL},
    {"ball twice", "ball_twice", "method=solid resolution=128", NULL},
    {"ball with holes", "ball_holes", "method=solid resolution=128", NULL},
    {"balls that overlap", "balls", "method=solid resolution=128", NULL},
    {NULL, NULL, NULL, NULL},
};
// clang-format on

static const RunAbout about = {
    .chapter = "01_voxelization",
    .title = "Voxelization",
    .shows = "every voxel that a surface touches and no other, against what plain rasterization finds",
    .source = "Gomes 2015, sections 2.1 and 4.2.1; Schwarz and Seidel 2010; Amanatides and Woo 1987",
    .uses = RUN_USES_CAMERA | RUN_USES_LIGHT,
    .scenes = scenes,
    .own_scenes = voxel_scenes,
    .parameters = parameters,
    .steps = steps,
    .sweep = sweep,
    .stability = stability,
};

static const float AMBIENT = 0.3f;            // of the mesh's albedo, so that shadows are not black
static const int DEPTH_MAP_RESOLUTION = 1024; // texels a side
// why passes are left out
static const char *const SAME_VOXELS = "scene, grid and method are the last frame's";
static const char *const SAME_VIEW = "eye, light and grid are the last frame's";
static const char *const OTHER_METHOD = "this row measures the other method";
static const char *const NO_INSIDE = "a surface has no inside";
static const char *const CLOSED = "the mesh is closed: one axis decides";
static const char *const OCCUPANCY = "occupancy alone is asked, or another storage";
static const char *const EMPTY_LIST = "the list is empty";

// What has not changed since the last frame is not built again.
static uint64_t hash_camera(Camera c)
{
    float values[] = {c.eye[0],    c.eye[1], c.eye[2], c.target[0], c.target[1],
                      c.target[2], c.up[0],  c.up[1],  c.up[2],     c.vertical_fov_rad};
    return hash_bytes(HASH_START, values, sizeof values);
}

static uint64_t hash_lights(const Scene *scene)
{
    uint64_t hash = HASH_START;
    for (size_t i = 0; i < scene->light_count; i++) {
        const Light *light = &scene->lights[i];
        hash = hash_bytes(hash_bytes(hash, &light->position, sizeof(vec3)), &light->direction, sizeof(vec3));
    }
    return hash;
}

enum { MESH, HOLES, WHOLE, WALK, PICTURES }; // pictures, in the order of `steps`
enum {
    FOUND,
    EXACT,
    EITHER,
    MISSED,
    VOXEL_SETS
}; // bits of one grid; FOUND: by the chosen method, or by raster

// The two passes of a picture of voxels.
static void show_voxels(Run *run, const Walker *walker, const Raster *raster, const WalkPicture *picture,
                        bool new_voxels, bool new_eye, const char *blocks_pass, const char *walk_pass)
{
    if (run_pass(run, blocks_pass, new_voxels, SAME_VOXELS)) {
        blocks_find(walker, picture->voxels, picture->blocks);
        run_skipped(run, (double)blocks_empty(&picture->voxels->grid, picture->blocks),
                    (double)blocks_count(&picture->voxels->grid));
    }
    if (run_pass(run, walk_pass, new_voxels || new_eye, SAME_VIEW))
        run_count(run, "fetches", walk_draw(walker, raster, picture));
}

int main(int argc, char **argv)
{
    Run *run = run_open(&about, argc, argv);
    Raster *raster = raster_open();
    Voxelizer voxelizer = voxelizer_open();
    Surfaces surfaces = surfaces_open();
    Solids solids = solids_open();
    Attributer attributer = attributer_open();
    Walker walker = walker_open();
    while (run_setting(run)) {
        const Scene *scene = run_scene(run);
        const int width = run_width(run), height = run_height(run);
        const bool exact = run_chosen(run, "method", "exact"), pictures = run_picture_needed(run);
        const bool filled = run_chosen(run, "method", "solid"), fill = filled || run_everything(run);
        const char *const method = exact || filled ? "raster" : run_choice(run, "method");
        const WalkShow show = run_chosen(run, "show", "normals") ? WALK_NORMALS
                              : run_chosen(run, "show", "steps") ? WALK_STEPS
                                                                 : WALK_DISTANCE;
        VoxelGrid grid = voxelize_grid(scene, run_vector(run, "region_lower"),
                                       run_vector(run, "region_upper"), run_integer(run, "resolution"));
        Voxels voxels[VOXEL_SETS];
        GLuint blocks[PICTURES] = {0}, texture[PICTURES], framebuffer[PICTURES];
        for (int i = 0; i < VOXEL_SETS; i++)
            voxels[i] = voxels_create(&grid, "voxels");
        for (int i = 0; i < PICTURES; i++) {
            blocks[i] = blocks_create(&grid);
            texture[i] =
                gl_texture(.label = steps[i].name, .format = GL_RGBA32F, .width = width, .height = height);
            framebuffer[i] = gl_framebuffer(.label = steps[i].name, .color = {texture[i]});
        }
        RasterMesh mesh = raster_mesh(scene);
        TriangleLists lists = triangle_lists_create(&mesh);
        SolidMesh solid = {0};
        SolidWork inside = {0};
        if (fill) {
            solid = solid_mesh_create(scene, &mesh);
            inside = solid_work_create(&grid, &solid, run_everything(run));
        }
        const Voxels *const chosen = exact ? &voxels[EXACT] : filled ? &inside.result : &voxels[FOUND];
        GBuffer gbuffer = raster_gbuffer(width, height);
        DepthMap *maps = memory_new(scene->light_count, sizeof *maps, "the depth maps");
        for (size_t i = 0; i < scene->light_count; i++)
            maps[i] = raster_depth_map(scene, &scene->lights[i], DEPTH_MAP_RESOLUTION, NULL, run_aspect(run));
        uint64_t last_eye = 0, last_lights = 0;

        while (run_frame(run)) {
            Camera camera = run_camera(run);
            // Voxels depend on nothing that a frame can change. While measuring, frame 0 comes again and again.
            const bool new_voxels = run_frame_number(run) == 0;
            const bool new_eye = new_voxels || hash_camera(camera) != last_eye;
            const bool new_lights = new_voxels || hash_lights(scene) != last_lights;
            const bool lit = scene->light_count > 0;
            last_eye = hash_camera(camera);
            last_lights = hash_lights(scene);

            //[mesh
            if (run_pass_common(run, "depth maps", pictures && new_lights && lit,
                                lit ? SAME_VIEW : "the scene has no light"))
                for (size_t i = 0; i < scene->light_count; i++)
                    raster_depth_map_draw(raster, &maps[i], &scene->lights[i], &mesh);
            if (run_pass_common(run, "G-buffer", pictures && new_eye, SAME_VIEW))
                raster_gbuffer_draw(raster, &gbuffer, &camera, &mesh);
            if (run_pass_common(run, "light and lines", pictures && (new_eye || new_lights), SAME_VIEW)) {
                raster_light_begin(raster, &gbuffer, texture[MESH], AMBIENT);
                for (size_t i = 0; i < scene->light_count; i++)
                    raster_light_add(raster, &gbuffer, &camera, &scene->lights[i], &maps[i], texture[MESH]);
                grid_lines_draw(&walker, &gbuffer, &camera, &grid, texture[MESH]);
            }
            run_step(run, "mesh", texture[MESH]);
            //]

            //[voxelize
            if (run_pass(run, method, new_voxels && (pictures || (!exact && !filled)),
                         new_voxels ? OTHER_METHOD : SAME_VOXELS)) {
                MethodWork work =
                    method_find(method, &voxelizer, &surfaces, &mesh, run_everything(run), &voxels[FOUND]);
                if (work.of > 0)
                    run_skipped(run, work.skipped, work.of);
            }
            const bool find = new_voxels && (pictures || exact);
            const char *why_not = new_voxels ? OTHER_METHOD : SAME_VOXELS;
            if (run_pass(run, "exact: sort", find, why_not)) {
                voxels_clear(&voxels[EXACT]);
                voxelize_sort(&voxelizer, &mesh, &grid, &lists);
                run_skipped(run, lists.outside, lists.triangle_count);
            }
            static const char *const passes[] = {"exact: along x", "exact: along y", "exact: along z",
                                                 "exact: small"};
            for (int list = 0; list < LIST_COUNT; list++)
                if (run_pass(run, passes[list], find && lists.count[list] > 0, find ? EMPTY_LIST : why_not))
                    voxelize_list(&voxelizer, &mesh, &lists, list, &voxels[EXACT]);
            //]

            //[storage
            const bool store = find && !run_chosen(run, "storage", "occupancy");
            const Fragments from = {&voxelizer, &mesh, &lists};
            Attributes stored = {0};
            if (run_pass(run, "storage: rank", store, find ? OCCUPANCY : why_not))
                stored = attributes_rank(&attributer, &voxels[EXACT]);
            if (run_pass(run, "storage: sums", store && run_chosen(run, "storage", "attributes"),
                         find ? OCCUPANCY : why_not))
                attributes_sum(&attributer, &from, &stored);
            if (run_pass(run, "storage: list", store && run_chosen(run, "storage", "list"),
                         find ? OCCUPANCY : why_not)) {
                run_count(run, "listed", (double)fragment_list_count(&attributer, &from, &stored));
                fragment_list_fill(&attributer, &from, &stored);
                run_count(run, "bytes", (double)attributes_bytes(&stored));
            }
            if (run_pass(run, "storage: average", store && run_chosen(run, "storage", "average"),
                         find ? OCCUPANCY : why_not))
                attributes_average(&attributer, &from, &stored);
            attributes_delete(&stored);
            //]

            //[solid
            static const char *const parities[] = {"solid: along x", "solid: along y", "solid: along z"};
            for (int axis = 2; axis >= 0; axis--)
                if (run_pass(run, parities[axis], filled && new_voxels && (axis == 2 || !solid.closed),
                             !filled      ? NO_INSIDE
                             : new_voxels ? CLOSED
                                          : SAME_VOXELS)) {
                    solid_flip(&solids, &solid, &inside, axis);
                    solid_scan(&solids, &inside, axis);
                }
            if (run_pass(run, "solid: vote", filled && new_voxels && !solid.closed,
                         !filled      ? NO_INSIDE
                         : new_voxels ? CLOSED
                                      : SAME_VOXELS))
                solid_vote(&solids, &solid, &inside);
            //]

            WalkPicture picture = {.show = show, .camera = &camera, .width = width, .height = height};
            if (pictures) {
                if (run_pass(run, "holes: compare", new_voxels, SAME_VOXELS))
                    voxels_compare(&voxelizer, &voxels[FOUND], &voxels[EXACT], &voxels[EITHER],
                                   &voxels[MISSED]);
                picture.voxels = &voxels[EITHER];
                picture.marked = &voxels[MISSED];
                picture.lines = true;
                picture.blocks = blocks[HOLES];
                picture.framebuffer = framebuffer[HOLES];
                show_voxels(run, &walker, raster, &picture, new_voxels, new_eye, "holes: blocks",
                            "holes: walk");
            }
            run_step(run, "holes", texture[HOLES]);

            if (pictures) {
                picture.voxels = &voxels[EXACT];
                picture.marked = NULL;
                picture.blocks = blocks[WHOLE];
                picture.framebuffer = framebuffer[WHOLE];
                show_voxels(run, &walker, raster, &picture, new_voxels, new_eye, "exact: blocks",
                            "exact: walk");
            }
            run_step(run, "exact", texture[WHOLE]);

            //[walk
            if (pictures) {
                picture.voxels = chosen;
                picture.lines = false;
                picture.blocks = blocks[WALK];
                picture.framebuffer = framebuffer[WALK];
                show_voxels(run, &walker, raster, &picture, new_voxels, new_eye, "walk: blocks", "walk");
                run_count(run, "grid_bytes", (double)voxels[EXACT].bytes);
                run_count(run, "peak_bytes", (double)measure_peak_bytes());
            }
            run_step(run, "walk", texture[WALK]);
            //]

            if (run_truth_wanted(run) && filled)
                fail_request(
                    "--truth: of the methods, solid has no picture of its truth; ask for a surface's");
            if (run_truth_wanted(run)) {
                uint32_t *bits = truth_voxels(&scene->mesh, &grid);
                Image truth = walk_truth(bits, &grid, show, &camera, width, height);
                run_truth(run, &truth);
                image_free(&truth);
                free(bits);
            }
        }
        double fragments = 0, invocations = 0;
        if (run_measuring_error(run)) { // once more, counted
            MethodCounter counter = method_count_begin();
            if (exact)
                voxelize_exact(&voxelizer, &mesh, &lists, &voxels[EXACT]);
            else if (filled)
                solid_voxelize(&solids, &solid, &inside);
            else
                method_find(method, &voxelizer, &surfaces, &mesh, run_everything(run), &voxels[FOUND]);
            method_count_end(&counter, &fragments, &invocations);
        }
        if ((run_measuring_error(run) || run_checking(run)) && filled)
            judge_solid(run, &solid, chosen, fragments, invocations);
        else if (run_measuring_error(run) || run_checking(run))
            judge_surface(run, &scene->mesh, chosen, fragments, invocations);
        if (fill) {
            char *message = filled ? solid_message(scene->name, &solid, &inside) : NULL;
            if (message)
                note("%s", message);
            free(message);
            solid_work_delete(&inside);
            solid_mesh_delete(&solid);
        }

        for (size_t i = 0; i < scene->light_count; i++)
            raster_depth_map_delete(&maps[i]);
        free(maps);
        raster_gbuffer_delete(&gbuffer);
        triangle_lists_delete(&lists);
        raster_mesh_delete(&mesh);
        for (int i = 0; i < PICTURES; i++) {
            gl_framebuffer_delete(&framebuffer[i]);
            gl_texture_delete(&texture[i]);
            gl_buffer_delete(&blocks[i]);
        }
        for (int i = 0; i < VOXEL_SETS; i++)
            voxels_delete(&voxels[i]);
    }
    walker_close(&walker);
    attributer_close(&attributer);
    solids_close(&solids);
    surfaces_close(&surfaces);
    voxelizer_close(&voxelizer);
    raster_close(raster);
    return run_close(run);
}
