// triangles: see triangles.h.
#include "triangles.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    GROUP = 64, // invocations, as items.glsl has it
    ITEM_WORDS = 3,
    ROOM = 1 << 18 // words of items at first
};
// storage buffers' bindings, as the shaders have them
enum { VOXELS = 1, FIRST, ITEMS = 4, BOUNDARIES, POSITIONS, INDICES, SLICE_ANGLES, COUNTS };

Triangles triangles_open(const TrianglesSettings *settings)
{
    return (Triangles){
        .settings = *settings,
        .counts = gl_buffer(.label = "triangles' counts", .bytes = sizeof(TrianglesCounts)),
        .items = gl_buffer(.label = "triangles' items", .bytes = ROOM * sizeof(uint32_t)),
        .item_room = ROOM / ITEM_WORDS,
    };
}

static bool chosen(const Triangles *triangles, const char *method)
{
    return strcmp(triangles->settings.method, method) == 0;
}

static void compile(Triangles *triangles, const TrianglesGrid *grid)
{
    const bool infinite = grid->frame->at_infinity, flat = chosen(triangles, "flat");
    if (triangles->fill[infinite])
        return;
    char *definitions = text_format("EPIPOLE_AT_INFINITY %d\nWARP %d\nKEEP_BEYOND %s", infinite,
                                    grid->phi_squared, chosen(triangles, "solid") ? "true" : "false");
    triangles->extent[infinite] =
        flat ? shader_open("extents of parts", definitions, "06_epipolar_vsv/flat_extent.comp")
             : shader_open("extents of triangles", definitions, "06_epipolar_vsv/extent.comp");
    triangles->fill[infinite] =
        flat ? shader_open("flat voxels", definitions, "06_epipolar_vsv/flat.comp")
        : chosen(triangles, "solid")
            ? shader_open("solid voxels", definitions, "06_epipolar_vsv/solid.comp")
            : shader_open("conservative voxels", definitions, "06_epipolar_vsv/conservative.comp");
    free(definitions);
}

void triangles_close(Triangles *triangles)
{
    for (int i = 0; i < 2; i++) {
        shader_close(triangles->extent[i]);
        shader_close(triangles->fill[i]);
    }
    gl_buffer_delete(&triangles->boundaries);
    gl_buffer_delete(&triangles->slice_angles);
    gl_buffer_delete(&triangles->counts);
    gl_buffer_delete(&triangles->items);
}

// ---------------------------------------------------------------- the grid in double

// Frame and range come in single precision; where voxels' faces lie follows from them in double, so that neighbours share a face to the last bit. The axis is the
// line through eye and light themselves: an axis rounded to single precision passes a far light at 10^-7 of its distance.
typedef struct Axes {
    double eye[3], up[3], side[3], axis[3], distance;
} Axes;

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// Take off the part along the unit vector `axis`, and make it a unit vector.
static void straighten(double v[3], const double axis[3])
{
    const double along = dot(v, axis);
    for (int k = 0; k < 3; k++)
        v[k] -= along * axis[k];
    const double length = sqrt(dot(v, v));
    for (int k = 0; k < 3; k++)
        v[k] /= length;
}

static Axes axes_of(const TrianglesGrid *grid)
{
    const EpipolarFrame *frame = grid->frame;
    Axes axes;
    for (int k = 0; k < 3; k++) {
        axes.eye[k] = (double)frame->eye[k];
        axes.axis[k] = frame->at_infinity ? -(double)grid->light->direction[k]
                                          : (double)grid->light->position[k] - (double)frame->eye[k];
        axes.up[k] = (double)frame->up[k];
        axes.side[k] = (double)frame->side[k];
    }
    axes.distance = sqrt(dot(axes.axis, axes.axis));
    for (int k = 0; k < 3; k++)
        axes.axis[k] = axes.distance > 0.0 ? axes.axis[k] / axes.distance : (double)frame->axis[k];
    if (axes.distance == 0.0) {
        const double length = sqrt(dot(axes.axis, axes.axis));
        for (int k = 0; k < 3; k++)
            axes.axis[k] /= length;
    }
    if (frame->at_infinity)
        axes.distance = -1.0;
    straighten(axes.up, axes.axis);
    straighten(axes.side, axes.axis);
    straighten(axes.side, axes.up);
    return axes;
}

static void set_grid(const Shader *shader, const TrianglesGrid *grid)
{
    const Axes axes = axes_of(grid);
    epipolar_set(shader, grid->frame, grid->range);
    shader_set_dvec3(shader, "eye", axes.eye);
    shader_set_dvec3(shader, "across", axes.up);
    shader_set_dvec3(shader, "upwards", axes.side);
    shader_set_dvec3(shader, "axis", axes.axis);
    shader_set_double(shader, "light_distance", axes.distance);
}

static double border(const TrianglesGrid *grid, int slice)
{
    return grid->theta_borders ? (double)grid->theta_borders[slice] : (double)slice / grid->range->theta;
}

// A slice must be a wedge, narrower than half a turn, to have a middle that all of it is seen from.
static void check_slices(const Triangles *triangles, const TrianglesGrid *grid)
{
    double widest = 0.0;
    for (int i = 0; i < grid->range->theta; i++)
        widest = fmax(widest, (double)grid->range->theta_span * (border(grid, i + 1) - border(grid, i)));
    if (!chosen(triangles, "flat") && widest > 3.0)
        fail_request("--set theta=%d: a slice would be %.3g radians wide; method=%s needs less than 3",
                     grid->range->theta, widest, triangles->settings.method);
}

void triangles_aim(Triangles *triangles, const TrianglesGrid *grid)
{
    const EpipolarRange *range = grid->range;
    check_slices(triangles, grid);
    const size_t count = (size_t)range->alpha + (size_t)range->theta + (size_t)range->phi + 3;
    double(*boundary)[2] = memory_new(count, sizeof *boundary, "the grid's boundaries"),
    (*next)[2] = boundary;
    float *angles = memory_new((size_t)range->theta + 1, sizeof *angles, "the slices' angles");
    for (int i = 0; i <= range->alpha; i++, next++) {
        const double span = (double)range->alpha_most - (double)range->alpha_least;
        const double angle = (double)range->alpha_least + span * i / range->alpha;
        (*next)[0] = cos(angle);
        (*next)[1] = sin(angle);
    }
    for (int i = 0; i <= range->theta; i++, next++) {
        const double angle = (double)range->theta_span * border(grid, i);
        angles[i] = (float)angle;
        (*next)[0] = cos((double)range->theta_least + angle);
        (*next)[1] = sin((double)range->theta_least + angle);
    }
    for (int i = 0; i <= range->phi; i++, next++) {
        const double u = (double)i / range->phi, span = (double)range->phi_most - (double)range->phi_least;
        const double phi = (double)range->phi_least + span * (grid->phi_squared ? u * u : u);
        // at infinity a distance takes its place: r - phi · 1 m
        (*next)[0] = grid->frame->at_infinity ? 1.0 : cos(phi);
        (*next)[1] = grid->frame->at_infinity ? phi : sin(phi);
    }
    gl_buffer_delete(&triangles->boundaries);
    gl_buffer_delete(&triangles->slice_angles);
    triangles->boundaries =
        gl_buffer(.label = "voxels' boundaries", .data = boundary, .bytes = count * sizeof *boundary);
    triangles->slice_angles = gl_buffer(.label = "slices' angles", .data = angles,
                                        .bytes = ((size_t)range->theta + 1) * sizeof *angles);
    free(boundary);
    free(angles);
}

// ---------------------------------------------------------------- work

// One invocation an item; GL promises 65535 groups a side.
static void dispatch(uint32_t items)
{
    const uint32_t groups = (items + GROUP - 1) / GROUP, rows = groups / 65535 + 1;
    gl.DispatchCompute((groups + rows - 1) / rows, rows, 1);
}

static void use(const Shader *shader, const Triangles *triangles, const RasterMesh *mesh,
                const TrianglesGrid *grid)
{
    shader_use(shader);
    set_grid(shader, grid);
    shader_set_double(shader, "first_angle", (double)grid->range->theta_least);
    shader_set_int(shader, "splits", (int)triangles->settings.splits);
    shader_set_int(shader, "parts_most", triangles->settings.parts);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, POSITIONS, mesh->positions);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, INDICES, mesh->indices);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, ITEMS, triangles->items);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, BOUNDARIES, triangles->boundaries);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, SLICE_ANGLES, triangles->slice_angles);
}

//[list
// Where the list has no room for all items, they are counted all the same, and the second time there is.
void triangles_list(Triangles *triangles, const RasterMesh *mesh, const TrianglesGrid *grid)
{
    const uint32_t count = (uint32_t)mesh->index_count / 3;
    const uint32_t rows = chosen(triangles, "flat") ? (uint32_t)triangles->settings.parts : 1;
    compile(triangles, grid);
    const Shader *shader = triangles->extent[grid->frame->at_infinity];
    triangles->counted = (TrianglesCounts){0};
    for (bool fits = count == 0; !fits;) {
        gl.ClearNamedBufferData(triangles->counts, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, NULL);
        use(shader, triangles, mesh, grid);
        gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, COUNTS, triangles->counts);
        shader_set_uint(shader, "triangle_count", count);
        shader_set_uint(shader, "item_count", triangles->item_room);
        dispatch(count * rows);
        gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
        gl_buffer_read(triangles->counts, 0, sizeof triangles->counted, &triangles->counted);
        fits = triangles->counted.items <= triangles->item_room;
        if (!fits) {
            triangles->item_room = triangles->counted.items;
            gl_buffer_delete(&triangles->items);
            triangles->items =
                gl_buffer(.label = "triangles' items",
                          .bytes = memory_bytes(triangles->item_room, ITEM_WORDS * sizeof(uint32_t),
                                                "triangles' items"));
        }
    }
}
//]

void triangles_fill(const Triangles *triangles, const RasterMesh *mesh, const TrianglesGrid *grid,
                    GLuint voxels, GLuint first)
{
    if (triangles->counted.items == 0)
        return;
    const Shader *shader = triangles->fill[grid->frame->at_infinity];
    use(shader, triangles, mesh, grid);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, VOXELS, voxels);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, FIRST, first);
    shader_set_uint(shader, "item_count", triangles->counted.items);
    dispatch(triangles->counted.items);
    gl.MemoryBarrier(GL_ALL_BARRIER_BITS);
}
