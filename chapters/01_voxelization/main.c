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
#include "rows.h"
#include "scenes.h"
#include "shadow_volume.h"
#include "walk.h"
#include <stdlib.h>
#include <string.h>

static const char *const scenes[] = {"bunny", "cornell", "colonnade", NULL};

// clang-format off
static const RunParameter parameters[] = {
    {.name = "method", .kind = RUN_CHOICE, .choices = "exact raster threepass slicing peeling msaa expanded binary solid", .shows = "how voxels are found"},
    {.name = "resolution", .kind = RUN_INTEGER, .least = 1, .most = 65536, .initial = {64}, .unit = "voxels", .shows = "voxels along the longest side"},
    {.name = "show", .kind = RUN_CHOICE, .choices = "shaded normals steps distance albedo mean_normals", .shows = "a voxel: its face in the light, the face's normal, planes that the ray crossed, distance; what it stores: albedo, mean normal"},
    {.name = "storage", .kind = RUN_CHOICE, .choices = "occupancy attributes list average", .shows = "what the voxels of method exact hold besides their bit; occupancy becomes attributes where those are shown"},
    {.name = "shadow", .kind = RUN_CHOICE, .choices = "none x y z -x -y -z", .shows = "step walk: instead of the voxels, those in their shadow when light shines along this axis"},
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
    .sweep = voxel_sweep,
    .stability = voxel_stability,
};

static const float AMBIENT = 0.3f;            // of the mesh's albedo, so that shadows are not black
static const int DEPTH_MAP_RESOLUTION = 1024; // texels a side
// why passes are left out
static const char *const SAME_VOXELS = "scene, grid and method are the last frame's";
static const char *const SAME_VIEW = "eye, light and grid are the last frame's";
static const char *const NOT_SHOWN = "its picture is not the one shown";
static const char *const NOT_USED = "the picture or row uses the other method";
static const char *const NO_INSIDE = "a surface has no inside";
static const char *const CLOSED = "the mesh is closed: one axis decides";
static const char *const OTHER_STORAGE = "occupancy alone is asked, or another storage";
static const char *const NO_SHADOW = "the voxels themselves are shown";
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

static WalkShow show_of(const Run *run)
{
    static const char *const names[] = {"shaded", "normals", "steps", "distance", "albedo", "mean_normals"};
    int show = 0;
    while (!run_chosen(run, "show", names[show])) // one of them is: run has checked
        show++;
    return (WalkShow)show;
}

enum { MESH, HOLES, WHOLE, WALK, PICTURES }; // pictures, in the order of `steps`
enum {
    FOUND,
    EXACT,
    EITHER,
    MISSED,
    SHADOWED,
    VOXEL_SETS
}; // bits of one grid; FOUND: by a method of methods.h

// The two passes of a picture of voxels.
static void show_voxels(Run *run, const Walker *walker, const Raster *raster, const WalkPicture *picture,
                        bool shown, bool new_voxels, bool new_eye, const char *blocks_pass,
                        const char *walk_pass)
{
    if (run_pass(run, blocks_pass, shown && new_voxels, shown ? SAME_VOXELS : NOT_SHOWN)) {
        blocks_find(walker, picture->voxels, picture->blocks);
        run_skipped(run, (double)blocks_empty(&picture->voxels->grid, picture->blocks),
                    (double)blocks_count(&picture->voxels->grid));
    }
    if (run_pass(run, walk_pass, shown && (new_voxels || new_eye), shown ? SAME_VIEW : NOT_SHOWN))
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
    ShadowScan shadow_scan = shadow_scan_open();
    Walker walker = walker_open();
    while (run_setting(run)) {
        const Scene *scene = run_scene(run);
        const int width = run_width(run), height = run_height(run);
        const bool exact = run_chosen(run, "method", "exact"), pictures = run_picture_needed(run);
        const bool filled = run_chosen(run, "method", "solid"), fill = filled || run_everything(run);
        const char *const method = exact || filled ? "raster" : run_choice(run, "method");
        const bool shadowed = !run_chosen(run, "shadow", "none");
        const char *const storage = run_choice(run, "storage");
        const WalkShow show = show_of(run);
        const bool coloured = show == WALK_ALBEDO || show == WALK_MEAN_NORMALS;
        const bool listed = strcmp(storage, "list") == 0, averages = strcmp(storage, "average") == 0;
        const bool show_averages = averages && show == WALK_ALBEDO; // they hold no normals
        Attributes stored = {0};
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

            // One picture is shown: what only another one needs is left out.
            const bool show_mesh = pictures && run_step_shown(run, "mesh");
            const bool show_holes = pictures && run_step_shown(run, "holes");
            const bool show_exact = pictures && run_step_shown(run, "exact");
            const bool show_walk = pictures && run_step_shown(run, "walk"),
                       find_chosen = show_walk || !pictures;

            //[mesh
            const char *no_mesh = !show_mesh ? NOT_SHOWN : SAME_VIEW;
            if (run_pass_common(run, "depth maps", show_mesh && new_lights && lit,
                                lit ? no_mesh : "the scene has no light"))
                for (size_t i = 0; i < scene->light_count; i++) {
                    raster_depth_map_aim(&maps[i], scene, &scene->lights[i], NULL, run_aspect(run));
                    raster_depth_map_draw(raster, &maps[i], &scene->lights[i], &mesh);
                }
            if (run_pass_common(run, "G-buffer", show_mesh && new_eye, no_mesh))
                raster_gbuffer_draw(raster, &gbuffer, &camera, &mesh);
            if (run_pass_common(run, "light and lines", show_mesh && (new_eye || new_lights), no_mesh)) {
                raster_light_begin(raster, &gbuffer, texture[MESH], AMBIENT);
                for (size_t i = 0; i < scene->light_count; i++)
                    raster_light_add(raster, &gbuffer, &camera, &scene->lights[i], &maps[i], texture[MESH]);
                grid_lines_draw(&walker, &gbuffer, &camera, &grid, texture[MESH]);
            }
            run_step(run, "mesh", texture[MESH]);
            //]

            //[voxelize
            const char *why_not = new_voxels ? NOT_USED : SAME_VOXELS;
            const bool other = show_holes || (find_chosen && !exact && !filled);
            if (run_pass(run, method, new_voxels && other, why_not)) {
                MethodWork work =
                    method_find(method, &voxelizer, &surfaces, &mesh, run_everything(run), &voxels[FOUND]);
                if (work.of > 0)
                    run_skipped(run, work.skipped, work.of);
            }
            const bool colours = coloured && (show_holes || show_exact || show_walk);
            const bool find = new_voxels && (show_holes || show_exact || colours || (find_chosen && exact));
            if (run_pass(run, "exact: sort", find, why_not)) {
                voxels_clear(&voxels[EXACT]);
                voxelize_sort(&voxelizer, &mesh, &grid, &lists);
                run_skipped(run, lists.outside, lists.triangle_count);
            }
            static const char *const passes[] = {"exact: along x", "exact: along y", "exact: along z",
                                                 "exact: small"};
            for (int list = 0; list < LIST_COUNT; list++)
                if (run_pass(run, passes[list], find && lists.count[list] > 0, find ? EMPTY_LIST : why_not))
                    run_count(run, "in_double",
                              voxelize_list(&voxelizer, &mesh, &lists, list, &voxels[EXACT]));
            //]

            //[storage
            const bool store =
                new_voxels && (colours || (find_chosen && exact && strcmp(storage, "occupancy") != 0));
            const char *no_store = new_voxels ? OTHER_STORAGE : SAME_VOXELS;
            const Fragments from = {&voxelizer, &mesh, &lists};
            if (run_pass(run, "storage: rank", store, no_store)) {
                attributes_delete(&stored);
                stored = attributes_rank(&attributer, &voxels[EXACT]);
            }
            if (run_pass(run, "storage: sums", store && !listed && !show_averages && (colours || !averages),
                         no_store)) {
                attributes_sum(&attributer, &from, &stored);
                run_count(run, "bytes", (double)attributes_bytes(&stored));
            }
            if (run_pass(run, "storage: list", store && listed, no_store)) {
                run_count(run, "listed", (double)fragment_list_count(&attributer, &from, &stored));
                fragment_list_fill(&attributer, &from, &stored);
                run_count(run, "bytes", (double)attributes_bytes(&stored));
            }
            if (run_pass(run, "storage: list's sums", store && listed && colours, no_store))
                fragment_list_sum(&attributer, &from, &stored);
            if (run_pass(run, "storage: average", store && averages, no_store)) {
                attributes_average(&attributer, &from, &stored);
                run_count(run, "bytes", (double)attributes_bytes(&stored));
            }
            //]

            //[solid
            static const char *const parities[] = {"solid: along x", "solid: along y", "solid: along z"};
            const bool fill_now = filled && find_chosen && new_voxels;
            const char *no_fill = !filled      ? NO_INSIDE
                                  : fill_now   ? CLOSED
                                  : new_voxels ? NOT_SHOWN
                                               : SAME_VOXELS;
            for (int axis = 2; axis >= 0; axis--)
                if (run_pass(run, parities[axis], fill_now && (axis == 2 || !solid.closed), no_fill)) {
                    solid_flip(&solids, &solid, &inside, axis);
                    solid_scan(&solids, &inside, axis);
                }
            if (run_pass(run, "solid: vote", fill_now && !solid.closed, no_fill))
                solid_vote(&solids, &solid, &inside);
            //]

            WalkPicture picture = {.show = show, .camera = &camera, .width = width, .height = height};
            picture.stored = &stored;
            picture.averaged = show_averages;
            if (run_pass(run, "holes: compare", show_holes && new_voxels,
                         show_holes ? SAME_VOXELS : NOT_SHOWN))
                voxels_compare(&voxelizer, &voxels[FOUND], &voxels[EXACT], &voxels[EITHER], &voxels[MISSED]);
            picture.voxels = &voxels[EITHER];
            picture.marked = &voxels[MISSED];
            picture.lines = true;
            picture.blocks = blocks[HOLES];
            picture.framebuffer = framebuffer[HOLES];
            show_voxels(run, &walker, raster, &picture, show_holes, new_voxels, new_eye, "holes: blocks",
                        "holes: walk");
            run_step(run, "holes", texture[HOLES]);

            picture.voxels = &voxels[EXACT];
            picture.marked = NULL;
            picture.blocks = blocks[WHOLE];
            picture.framebuffer = framebuffer[WHOLE];
            show_voxels(run, &walker, raster, &picture, show_exact, new_voxels, new_eye, "exact: blocks",
                        "exact: walk");
            run_step(run, "exact", texture[WHOLE]);

            //[walk
            if (run_pass(run, "walk: shadow", shadowed && show_walk && new_voxels,
                         !shadowed   ? NO_SHADOW
                         : show_walk ? SAME_VOXELS
                                     : NOT_SHOWN)) {
                const char *axis = shadowed ? run_choice(run, "shadow") : "x";
                const bool against = axis[0] == '-';
                shadow_volume_find(&shadow_scan, chosen, axis[against] - 'x', against, &voxels[SHADOWED]);
            }
            picture.voxels = shadowed ? &voxels[SHADOWED] : chosen;
            picture.lines = false;
            picture.blocks = blocks[WALK];
            picture.framebuffer = framebuffer[WALK];
            show_voxels(run, &walker, raster, &picture, show_walk, new_voxels, new_eye, "walk: blocks",
                        "walk");
            if (show_walk) {
                run_count(run, "grid_bytes", (double)voxels[EXACT].bytes);
                run_count(run, "peak_bytes", (double)measure_peak_bytes());
            }
            run_step(run, "walk", texture[WALK]);
            //]

            if (run_truth_wanted(run)) {
                TrueVoxels of = {filled, run_choice(run, "shadow")};
                Image truth = judge_truth(scene, &grid, of, show, &camera, width, height);
                run_truth(run, &truth);
                image_free(&truth);
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
            judge_solid(run, &solid, &inside, fragments, invocations);
        else if (run_measuring_error(run) || run_checking(run))
            judge_surface(run, &scene->mesh, chosen, fragments, invocations);
        if ((run_measuring_error(run) || run_checking(run)) && exact && strcmp(storage, "occupancy") != 0) {
            const size_t bytes = attributes_bytes(&stored);
            if (listed) {
                const Fragments from = {&voxelizer, &mesh, &lists};
                fragment_list_sum(&attributer, &from, &stored);
            }
            judge_attributes(run, &stored, averages, bytes);
        }
        attributes_delete(&stored);
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
    shadow_scan_close(&shadow_scan);
    attributer_close(&attributer);
    solids_close(&solids);
    surfaces_close(&surfaces);
    voxelizer_close(&voxelizer);
    raster_close(raster);
    return run_close(run);
}
