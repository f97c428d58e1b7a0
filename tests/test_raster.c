// raster: depth maps, their lookup, the G-buffer and the full screen against closed forms.
#include "raster_room.h"

static void check_plane_map(LightKind kind, bool walls)
{
    Stage stage = stage_open(make, walls ? WALLS : 0);
    Light light = light_of(kind, 0);
    DepthMap map = raster_depth_map(stage.scene, &light, MAP, NULL, 1);
    raster_depth_map_draw(stage.raster, &map, &light, &stage.mesh);
    float *distance = texels(map.distance, GL_RED, 1, MAP * MAP);
    mat4 inverse = mat4_inverse(map.to_clip);
    int wrong = 0, hit = 0;
    for (int i = 0; i < MAP * MAP; i++) {
        int column = i % MAP, row = i / MAP;
        float u = 2 * ((float)column + 0.5f) / MAP - 1, v = 2 * ((float)row + 0.5f) / MAP - 1;
        vec3 from = mat4_transform_point(inverse, (vec4){u, v, -1, 1}), along = light.direction;
        double before = 0; // the near plane is where the orthographic map's distance is 0
        if (kind == LIGHT_SPOT) {
            along = from;
            from = vec3_make(0, 0, 0);
        }
        double expected = before + trace_from(walls, map.origin + from, along);
        hit += isfinite(expected);
        if (isfinite(expected) ? fabs(distance[i] - expected) > RELATIVE * expected : isfinite(distance[i]))
            wrong++;
    }
    cr_assert(hit > MAP * MAP / 8, "only %d texels show the scene", hit);
    cr_assert(wrong <= EDGE_TEXELS, "%d of %d texels are wrong", wrong, MAP * MAP);
    free(distance);
    raster_depth_map_delete(&map);
    stage_close(&stage);
}
Test(raster, spot_map_holds_the_distance_to_box_and_wall)
{
    check_plane_map(LIGHT_SPOT, true);
}
Test(raster, directional_map_holds_the_distance_from_its_plane)
{
    check_plane_map(LIGHT_DIRECTIONAL, false);
}

// The direction of a texel, from the table of the OpenGL specification: which component is sc, tc, ma, with which sign.
static vec3 cube_direction(int face, float sc, float tc)
{
    static const int axis[6][3] = {{2, 1, 0}, {2, 1, 0}, {0, 2, 1}, {0, 2, 1}, {0, 1, 2}, {0, 1, 2}};
    static const float sign[6][3] = {{-1, -1, 1}, {1, -1, -1}, {1, 1, 1},
                                     {1, -1, -1}, {1, -1, 1},  {-1, -1, -1}};
    vec3 direction = {0};
    direction[axis[face][0]] = sign[face][0] * sc;
    direction[axis[face][1]] = sign[face][1] * tc;
    direction[axis[face][2]] = sign[face][2];
    return direction;
}
static void check_point_map(vec3 position)
{
    Stage stage = stage_open(make, WALLS);
    Light light = light_of(LIGHT_POINT, 0);
    light.position = position;
    DepthMap map = raster_depth_map(stage.scene, &light, MAP, NULL, 1);
    raster_depth_map_draw(stage.raster, &map, &light, &stage.mesh);
    float *distance = texels(map.distance, GL_RED, 1, 6 * MAP * MAP);
    for (int face = 0; face < 6; face++) {
        int wrong = 0;
        for (int i = 0; i < MAP * MAP; i++) {
            int column = i % MAP, row = i / MAP;
            float s = 2 * ((float)column + 0.5f) / MAP - 1, t = 2 * ((float)row + 0.5f) / MAP - 1;
            double expected = trace_from(true, light.position, cube_direction(face, s, t));
            // 1e-6 m: a few roundings of the block's own size, where the light is a thousandth of that away
            wrong += fabs(distance[face * MAP * MAP + i] - expected) > RELATIVE * expected + 1e-6;
        }
        cr_assert(wrong <= EDGE_TEXELS, "face %d: %d texels are wrong", face, wrong);
    }
    free(distance);
    raster_depth_map_delete(&map);
    stage_close(&stage);
}
Test(raster, point_map_holds_the_distance_on_every_face)
{
    check_point_map(light_of(LIGHT_POINT, 0).position);
}
Test(raster, point_map_loses_nothing_that_is_near)
{
    check_point_map(vec3_make(0.5f, 2 + 0x1p-10f, 0.75f)); // 1 mm above the block, 7e-5 of the diagonal
}

enum { RINGS = 32, SPOKES = 64 };
static void make_sphere(Scene *scene, uint64_t seed)
{
    (void)seed;
    scene_add_material(scene, "sphere", vec3_make(0.5f, 0.5f, 0.5f), vec3_make(0, 0, 0));
    for (int ring = 0; ring <= RINGS; ring++)
        for (int spoke = 0; spoke < SPOKES; spoke++) {
            double theta = M_PI * ring / RINGS, phi = 2 * M_PI * spoke / SPOKES;
            vec3 p =
                vec3_make((float)(sin(theta) * cos(phi)), (float)cos(theta), (float)(sin(theta) * sin(phi)));
            mesh_add_vertex(&scene->mesh, 2.0f * p, p);
        }
    for (uint32_t ring = 0; ring < RINGS; ring++)
        for (uint32_t spoke = 0; spoke < SPOKES; spoke++) {
            uint32_t a = ring * SPOKES + spoke, b = ring * SPOKES + (spoke + 1) % SPOKES;
            mesh_add_triangle(&scene->mesh, a, b, a + SPOKES, 0);
            mesh_add_triangle(&scene->mesh, b, b + SPOKES, a + SPOKES, 0);
        }
}
Test(raster, sphere_round_a_point_light_has_its_radius_everywhere)
{
    Stage stage = stage_open(make_sphere, 0);
    Light light = {.kind = LIGHT_POINT, .radius = 1e-3f};
    DepthMap map = raster_depth_map(stage.scene, &light, MAP, NULL, 1);
    raster_depth_map_draw(stage.raster, &map, &light, &stage.mesh);
    float *distance = texels(map.distance, GL_RED, 1, 6 * MAP * MAP);
    // The deepest point of a triangle is where its longest edge, at most the cell's diagonal, is nearest: cos of half that angle.
    double half = 0.5 * hypot(M_PI / RINGS, 2 * M_PI / SPOKES), least = 2 * cos(half);
    for (int i = 0; i < 6 * MAP * MAP; i++)
        cr_assert(distance[i] >= least * (1 - RELATIVE) && distance[i] <= 2 * (1 + RELATIVE),
                  "texel %d: %g is not between %g and 2", i, (double)distance[i], least);
    free(distance);
    raster_depth_map_delete(&map);
    stage_close(&stage);
}

// Points a little before and behind the first surface in many directions are lit and dark.
static void check_lookup(LightKind kind, const vec3 *from, const vec3 *along, int count, bool walls)
{
    Stage stage = stage_open(make, walls ? WALLS : 0);
    Light light = light_of(kind, 0);
    DepthMap map = raster_depth_map(stage.scene, &light, 512, NULL, 1);
    raster_depth_map_draw(stage.raster, &map, &light, &stage.mesh);
    vec3 *points = memory_new((size_t)count * 2, sizeof *points, "points");
    bool *beside = memory_new((size_t)count, sizeof *beside, "whether the light meets nothing");
    for (int i = 0; i < count; i++) {
        // 3 %: more than the largest slope (1/tan of 8°) times half a texel's diagonal (2·0.71/512 of the distance)
        float distance = (float)trace_from(walls, from[i], along[i]);
        beside[i] = isinf(distance);
        for (int k = 0; k < 2; k++)
            points[2 * i + k] = from[i] - map.origin +
                                (k ? 1.03f : 0.97f) * (beside[i] ? 9 : distance) * vec3_normalize(along[i]);
    }
    GLuint in = gl_buffer(.label = "points", .bytes = (size_t)count * 2 * sizeof *points, .data = points);
    GLuint out = gl_buffer(.label = "lit", .bytes = (size_t)count * 2 * sizeof(float));
    Shader *lookup = shader_open("lookup",
                                 kind == LIGHT_POINT  ? "MAP_KIND 0"
                                 : kind == LIGHT_SPOT ? "MAP_KIND 1"
                                                      : "MAP_KIND 2",
                                 "raster/lookup.comp");
    shader_use(lookup);
    shader_set_mat4(lookup, "to_clip", (const float *)&map.to_clip);
    shader_set_vec3(lookup, "direction", (const float *)&light.direction);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, in);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, out);
    gl.BindImageTexture(0, map.distance, 0, GL_TRUE, 0, GL_READ_ONLY, GL_R32F);
    gl.DispatchCompute((GLuint)(2 * count + 7) / 8, 1, 1);
    gl.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    float *lit = memory_new((size_t)count * 2, sizeof *lit, "lit");
    gl_buffer_read(out, 0, (size_t)count * 2 * sizeof *lit, lit);
    for (int i = 0; i < 2 * count; i++)
        cr_assert(lit[i] == (i % 2 && !beside[i / 2] ? 0.0f : 1.0f),
                  "point %d, %s the surface at (%g %g %g) from the origin: %g", i / 2,
                  i % 2 ? "behind" : "before", (double)points[i][0], (double)points[i][1],
                  (double)points[i][2], (double)lit[i]);
    free(points), free(beside), free(lit);
    shader_close(lookup);
    gl_buffer_delete(&in);
    gl_buffer_delete(&out);
    raster_depth_map_delete(&map);
    stage_close(&stage);
}
Test(raster, point_lookup_along_faces_edges_and_corners)
{
    vec3 from[26], along[26];
    int count = 0;
    for (int i = 0; i < 27; i++)
        if (i != 13) { // not (0, 0, 0)
            from[count] = light_of(LIGHT_POINT, 0).position;
            int x = i % 3 - 1, y = i / 3 % 3 - 1, z = i / 9 - 1;
            along[count++] = vec3_make((float)x, (float)y, (float)z);
        }
    check_lookup(LIGHT_POINT, from, along, count, true);
}
Test(raster, spot_and_directional_lookup_before_and_behind_the_surface)
{
    vec3 from[64], along[64];
    for (int i = 0; i < 64; i++) { // in the cone: its axis leans by 16°, its half angle is 34°
        int column = i % 8, row = i / 8;
        from[i] = light_of(LIGHT_SPOT, 0).position;
        along[i] = vec3_make(-0.53f + 0.08f * (float)column, -1, -0.375f + 0.08f * (float)row);
    }
    check_lookup(LIGHT_SPOT, from, along, 64, true);
    for (int i = 0; i < 64; i++) { // 9 m before the floor: the 3 % are of a length that no slope here uses up
        int column = i % 8, row = i / 8;
        along[i] = light_of(LIGHT_DIRECTIONAL, 0).direction;
        vec3 on_floor = vec3_make(-3.45f + 0.97f * (float)column, 0, -4.3f + 1.17f * (float)row);
        if (column == 7) // beside the floor, and beside the map
            on_floor[0] = 6 + (float)i;
        from[i] = on_floor + 9 / along[i][1] * along[i];
    }
    check_lookup(LIGHT_DIRECTIONAL, from, along, 64, false);
}

static void make_planes(Scene *scene, uint64_t seed)
{
    (void)seed;
    uint32_t near = scene_add_material(scene, "nearer", vec3_make(1, 1, 1), vec3_make(0, 0, 0));
    uint32_t far = scene_add_material(scene, "farther", vec3_make(0, 0, 0), vec3_make(0, 0, 0));
    vec3 across = vec3_make(2e4f, 0, 0), upwards = vec3_make(0, 2e4f, 0);
    mesh_add_quad(&scene->mesh, vec3_make(-1e4f, -1e4f, -1e4f - 0.01f), across, upwards, far);
    mesh_add_quad(&scene->mesh, vec3_make(-1e4f, -1e4f, -1e4f), across, upwards, near);
    scene->camera = (Camera){.target = vec3_make(0, 0, -1),
                             .up = vec3_make(0, 1, 0),
                             .vertical_fov_rad = 1,
                             .near_distance = 1e-3f,
                             .far_distance = 10};
}

Test(raster, gbuffer_holds_distance_normal_and_material)
{
    Stage stage = stage_open(make, WALLS);
    const Camera *camera = &stage.scene->camera;
    raster_gbuffer_draw(stage.raster, &stage.gbuffer, camera, &stage.mesh);
    float *distance = texels(stage.gbuffer.distance, GL_RED, 1, SIZE * SIZE);
    float *normal = texels(stage.gbuffer.normal, GL_RGBA, 4, SIZE * SIZE);
    float *albedo = texels(stage.gbuffer.albedo, GL_RGBA, 4, SIZE * SIZE);
    float *emission = texels(stage.gbuffer.emission, GL_RGBA, 4, SIZE * SIZE);
    GLuint *triangle = memory_new(SIZE * SIZE, sizeof *triangle, "triangle numbers");
    gl.GetTextureImage(stage.gbuffer.triangle, 0, GL_RED_INTEGER, GL_UNSIGNED_INT, SIZE * SIZE * 4, triangle);
    int wrong = 0, block_seen = 0;
    for (int i = 0; i < SIZE * SIZE; i++) {
        vec3 ray = pixel_ray(camera, i % SIZE, i / SIZE);
        double n[3], expected = trace(true, (double[]){camera->eye[0], camera->eye[1], camera->eye[2]},
                                      (double[]){ray[0], ray[1], ray[2]}, n);
        bool right = fabs(distance[i] - expected) <= RELATIVE * expected;
        for (int c = 0; c < 3; c++)
            right =
                right && normal[4 * i + c] == (float)n[c]; // walls are seen from behind: turned to the eye
        // 12 triangles of the block come first
        bool block = triangle[i] <= 12;
        const Material *material = &stage.scene->materials[block ? 0 : 1];
        for (int c = 0; c < 3; c++)
            right = right && albedo[4 * i + c] == material->albedo[c] &&
                    emission[4 * i + c] == material->emission[c];
        double p[3] = {camera->eye[0] + expected * ray[0], camera->eye[1] + expected * ray[1],
                       camera->eye[2] + expected * ray[2]};
        bool on_block = true;
        for (int c = 0; c < 3; c++)
            on_block = on_block && p[c] > BLOCK.lower[c] - 1e-4 && p[c] < BLOCK.upper[c] + 1e-4;
        right = right && block == on_block && triangle[i] >= 1 && triangle[i] <= 24;
        wrong += !right;
        block_seen += block;
    }
    cr_assert(block_seen > SIZE, "the block is in view");
    cr_assert(wrong <= EDGE_TEXELS, "%d pixels are wrong", wrong);
    free(distance), free(normal), free(albedo), free(emission), free(triangle);
    stage_close(&stage);
}

Test(raster, gbuffer_tells_apart_what_is_near_in_depth_and_far_away)
{
    // Two parallel planes 10 km away, a millionth of that apart, seen with a near plane of 1 mm: the nearer,
    // drawn last, must win everywhere. Where depth is mapped from [-1, 1] both share one value.
    Stage stage = stage_open(make_planes, 0);
    raster_gbuffer_draw(stage.raster, &stage.gbuffer, &stage.scene->camera, &stage.mesh);
    float *albedo = texels(stage.gbuffer.albedo, GL_RGBA, 4, SIZE * SIZE);
    for (int i = 0; i < SIZE * SIZE; i++)
        cr_assert(albedo[4 * i] == 1.0f, "pixel %d shows the farther plane", i);
    free(albedo);
    stage_close(&stage);
}

Test(raster, fullscreen_runs_once_a_pixel_with_the_cameras_rays)
{
    Stage stage = stage_open(make, 0);
    Camera camera = stage.scene->camera;
    camera.up = vec3_normalize(vec3_make(0.3f, 1, 0.1f)); // a tilted head too
    Shader *shader = shader_open("rays", NULL, "common/fullscreen.vert", "raster/rays.frag");
    GLuint framebuffer = gl_framebuffer(.label = "rays", .color = {stage.picture});
    raster_set_camera(shader, &camera, 1);
    raster_fullscreen(stage.raster, shader, framebuffer, SIZE, SIZE);
    float *rays = texels(stage.picture, GL_RGBA, 4, SIZE * SIZE);
    for (int i = 0; i < SIZE * SIZE; i++) {
        vec3 expected = pixel_ray(&camera, i % SIZE, i / SIZE);
        vec3 got = vec3_make(rays[4 * i], rays[4 * i + 1], rays[4 * i + 2]);
        // a few float roundings of the matrix inverse
        cr_assert(vec3_length(got - expected) < 1e-5f && rays[4 * i + 3] == 1.0f, "pixel %d, %d", i % SIZE,
                  i / SIZE);
    }
    free(rays);
    gl_framebuffer_delete(&framebuffer);
    shader_close(shader);
    stage_close(&stage);
}

// The map is the smallest square-on rectangle round what the view and the scene's box share: found anew from a lattice of points of the box.
static void check_fit_is_tight(const Stage *stage, const Light *light, const Camera *camera)
{
    enum { LATTICE = 96 };
    DepthMap map = raster_depth_map(stage->scene, light, MAP, camera, 1);
    vec3 extent = stage->scene->upper - stage->scene->lower, least = vec3_make(2, 2, 2), most = -least;
    vec3 forward = vec3_normalize(camera->target - camera->eye);
    vec3 right = vec3_normalize(vec3_cross(forward, camera->up)), up = vec3_cross(right, forward);
    float slope = tanf(0.5f * camera->vertical_fov_rad);
    for (int i = 0; i <= LATTICE; i++)
        for (int j = 0; j <= LATTICE; j++)
            for (int k = 0; k <= LATTICE; k++) {
                vec3 p = stage->scene->lower + vec3_make((float)i, (float)j, (float)k) / LATTICE * extent;
                vec3 d = p - camera->eye;
                float z = slope * vec3_dot(d, forward);
                if (fabsf(vec3_dot(d, right)) > z || fabsf(vec3_dot(d, up)) > z)
                    continue;
                vec3 clip = mat4_transform_point(map.to_clip, p - map.origin);
                least = vec3_min(least, clip);
                most = vec3_max(most, clip);
            }
    for (int i = 0; i < 2; i++) { // the lattice and the map's margin leave a few percent
        cr_assert(least[i] >= -1 && most[i] <= 1, "axis %d: the view reaches %g to %g", i, (double)least[i],
                  (double)most[i]);
        cr_assert(least[i] < -0.9f && most[i] > 0.9f, "axis %d: the view fills only %g to %g", i,
                  (double)least[i], (double)most[i]);
    }
    raster_depth_map_delete(&map);
}
Test(raster, directional_map_fits_tightly_round_the_view)
{
    Stage stage = stage_open(make, WALLS);
    Light light = light_of(LIGHT_DIRECTIONAL, 0);
    Camera camera = stage.scene->camera;
    check_fit_is_tight(&stage, &light, &camera);
    const vec3 targets[] = {vec3_make(9, 3, 0), vec3_make(-9, 1, 2), vec3_make(1, 3, 9), vec3_make(0, 8, -9)};
    for (size_t i = 0; i < sizeof targets / sizeof *targets;
         i++) { // the eye inside the box, at an end of what it sees
        camera.eye = vec3_make(0, 3, 0), camera.target = targets[i], camera.vertical_fov_rad = 0.9f;
        check_fit_is_tight(&stage, &light, &camera);
    }
    stage_close(&stage);
}

// Fitted to the camera, the map is finer, holds every visible point, and what hangs above the view still casts.
Test(raster, directional_map_fits_what_the_camera_sees)
{
    Stage stage = stage_open(make, HANGING);
    Camera camera = stage.scene->camera;
    camera.eye = vec3_make(0.5f, 2.5f, 4), camera.target = vec3_make(0, 0.5f, 0),
    camera.vertical_fov_rad = 0.5f;
    Light light = light_of(LIGHT_DIRECTIONAL, 0);
    light.direction = vec3_normalize(vec3_make(0.02f, -1, -0.03f));
    DepthMap whole = raster_depth_map(stage.scene, &light, MAP, NULL, 1);
    DepthMap fitted = raster_depth_map(stage.scene, &light, MAP, &camera, 1);
    cr_assert(fitted.texel_size < 0.7f * whole.texel_size, "%g m against %g m a texel",
              (double)fitted.texel_size, (double)whole.texel_size);
    raster_depth_map_draw(stage.raster, &fitted, &light, &stage.mesh);
    raster_gbuffer_draw(stage.raster, &stage.gbuffer, &camera, &stage.mesh);
    float *seen = texels(stage.gbuffer.distance, GL_RED, 1, SIZE * SIZE);
    float *stored = texels(fitted.distance, GL_RED, 1, MAP * MAP);
    int under = 0;
    for (int i = 0; i < SIZE * SIZE; i++) {
        if (isinf(seen[i]))
            continue;
        vec3 point = camera.eye + seen[i] * pixel_ray(&camera, i % SIZE, i / SIZE) - fitted.origin;
        vec3 clip = mat4_transform_point(fitted.to_clip, point);
        cr_assert(fabsf(clip[0]) <= 1 && fabsf(clip[1]) <= 1 && fabsf(clip[2]) <= 1,
                  "pixel %d is outside the map", i);
        int x = (int)((0.5f * clip[0] + 0.5f) * MAP), y = (int)((0.5f * clip[1] + 0.5f) * MAP);
        under += stored[y * MAP + x] < vec3_dot(point, light.direction) - 15;
    }
    cr_assert(under > SIZE * SIZE / 8, "only %d pixels lie under the slab 20 m above them", under);
    free(seen), free(stored);
    // the eye looks away: nothing to fit to, the whole scene then
    camera.target = vec3_make(0.5f, 2.5f, 40);
    camera.eye = vec3_make(0.5f, 2.5f, 30);
    DepthMap away = raster_depth_map(stage.scene, &light, MAP, &camera, 1);
    cr_assert_eq(away.texel_size, whole.texel_size, "a view of nothing takes the whole scene");
    raster_depth_map_delete(&away);
    raster_depth_map_delete(&whole);
    raster_depth_map_delete(&fitted);
    stage_close(&stage);
}
