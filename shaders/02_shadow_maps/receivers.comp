// receivers: which part of the map will be asked? For each layer: how many pixels lie in it, the rectangle that they need, the farthest of
// them. A caster outside these, and a layer with no pixel, can change no pixel.
#include "02_shadow_maps/bounds.glsl"
#include "02_shadow_maps/receiver.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(std430, binding = 0) coherent buffer AskedBounds { Bounds bounds[]; };
uniform float margin; // texels: how far from a pixel's own place the lookup may read

void include(int layer, vec2 lower, vec2 upper)
{
    uvec2 from = uvec2(clamp(floor((0.5 * lower + 0.5) * float(TILES)), 0.0, float(TILES - 1)));
    uvec2 to = uvec2(clamp(floor((0.5 * upper + 0.5) * float(TILES)), 0.0, float(TILES - 1))) + 1u;
    atomicMax(bounds[layer].from_end_x, uint(TILES) - from.x);
    atomicMax(bounds[layer].from_end_y, uint(TILES) - from.y);
    atomicMax(bounds[layer].end_x, to.x);
    atomicMax(bounds[layer].end_y, to.y);
}

//[receivers
void main()
{
    Receiver receiver;
    if (!receiver_find(ivec2(gl_GlobalInvocationID.xy), receiver))
        return;
    Place place = map_place(receiver.point);
    vec2 reach = vec2(2.0 * margin) / float(map_size);
    include(place.layer, place.at - reach, place.at + reach);
    atomicAdd(bounds[place.layer].pixels, 1u);
    // Positive floats are ordered as their bits. Rounded up to the next quarter of an octave, so that a camera that moves a little asks for the
    // same map; a hundredth more, since the lookup computes the distance anew.
    float distance_bound = exp2(ceil(4.0 * log2(max(1.01 * map_distance(receiver.point), LEAST_DISTANCE))) / 4.0);
    atomicMax(bounds[place.layer].farthest, floatBitsToUint(distance_bound));
#if SHAPE == CUBE
    // A lookup beyond a face's border reads its neighbours; where, is not worth knowing: all of them.
    for (int corner = 0; corner < 4; corner++) {
        vec2 at = place.at + reach * vec2(corner & 1, corner >> 1) * 2.0 - reach;
        int face = cube_face(cube_direction(place.layer, at));
        if (face != place.layer) {
            include(face, vec2(-1.0), vec2(1.0));
            atomicMax(bounds[face].farthest, floatBitsToUint(distance_bound));
        }
    }
#endif
}
//]
