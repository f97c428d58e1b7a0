// model: a small glTF file with a camera and two lights, whose picture is known in closed form. For tests that give programs a file.
//
// A wall z = 0, |x|, |y| <= 0.25, and a panel that stands upright through it, turned by 45 degrees, |x| <= 0.1. The eye at (0, 0, 1) looks
// down -z; half of what it sees of the plane z = 0 is MODEL_HALF_VIEW high. Light 0 is a green point at the eye, so nothing that is
// seen lies in its shadow; light 1 is red and shines down -z.
#ifndef MODEL_H
#define MODEL_H

#include "base.h"

#include <math.h>
#include <stdlib.h>

static const double MODEL_HALF_VIEW = 0.3, MODEL_HALF_WALL = 0.25, MODEL_ALBEDO = 0.5;
static const double MODEL_POINT_GREEN = 3, MODEL_SUN_RED = 2; // W/sr, W/m²

// Write folder/name.gltf and folder/name.bin; `first` is the first coordinate of the first vertex, which should be -0.25.
static inline void model_write(const char *folder, const char *name, float first)
{
    const float positions[8][3] = {{first, -0.25f, 0}, {0.25f, -0.25f, 0},    {0.25f, 0.25f, 0},
                                   {-0.25f, 0.25f, 0}, {-0.1f, -0.2f, -0.1f}, {0.1f, -0.2f, 0.1f},
                                   {0.1f, 0.2f, 0.1f}, {-0.1f, 0.2f, -0.1f}};
    const uint16_t indices[12] = {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7};
    char *bin = text_format("%s/%s.bin", folder, name), *gltf = text_format("%s/%s.gltf", folder, name);
    FILE *file = fopen(bin, "wb");
    fwrite(positions, sizeof positions, 1, file);
    fwrite(indices, sizeof indices, 1, file);
    fclose(file);
    file = fopen(gltf, "w");
    fprintf(
        file,
        "{\"asset\": {\"version\": \"2.0\"}, \"extensionsUsed\": [\"KHR_lights_punctual\"],\n"
        "\"buffers\": [{\"uri\": \"%s.bin\", \"byteLength\": 120}],\n"
        "\"bufferViews\": [{\"buffer\": 0, \"byteLength\": 96}, {\"buffer\": 0, \"byteOffset\": 96, "
        "\"byteLength\": 24}],\n"
        "\"accessors\": [{\"bufferView\": 0, \"componentType\": 5126, \"count\": 8, \"type\": \"VEC3\", "
        "\"min\": [-0.25, -0.25, -0.1], \"max\": [0.25, 0.25, 0.1]},\n"
        " {\"bufferView\": 1, \"componentType\": 5123, \"count\": 12, \"type\": \"SCALAR\"}],\n"
        "\"materials\": [{\"pbrMetallicRoughness\": {\"baseColorFactor\": [%g, %g, %g, 1]}}],\n"
        "\"meshes\": [{\"primitives\": [{\"attributes\": {\"POSITION\": 0}, \"indices\": 1, "
        "\"material\": 0}]}],\n"
        "\"cameras\": [{\"type\": \"perspective\", \"perspective\": {\"yfov\": %.9g, \"znear\": 0.01}}],\n"
        "\"extensions\": {\"KHR_lights_punctual\": {\"lights\": [\n"
        " {\"type\": \"point\", \"color\": [0, 1, 0], \"intensity\": %g},\n"
        " {\"type\": \"directional\", \"color\": [1, 0, 0], \"intensity\": %g}]}},\n"
        "\"nodes\": [{\"name\": \"wall\", \"mesh\": 0}, {\"name\": \"eye\", \"camera\": 0, "
        "\"translation\": [0, 0, 1]},\n"
        " {\"name\": \"point\", \"translation\": [0, 0, 1], \"extensions\": {\"KHR_lights_punctual\": "
        "{\"light\": 0}}},\n"
        " {\"name\": \"sun\", \"extensions\": {\"KHR_lights_punctual\": {\"light\": 1}}}],\n"
        "\"scenes\": [{\"nodes\": [0, 1, 2, 3]}], \"scene\": 0}\n",
        name, MODEL_ALBEDO, MODEL_ALBEDO, MODEL_ALBEDO, 2 * atan(MODEL_HALF_VIEW), MODEL_POINT_GREEN,
        MODEL_SUN_RED);
    fclose(file);
    free(bin);
    free(gltf);
}

#endif
