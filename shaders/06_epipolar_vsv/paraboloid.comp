// A point light's map on two paraboloids, as Wyman 2011 has it (Brabec, Annen and Seidel 2002), from its cube: what each texel's own direction meets there. To draw
// it from triangles is chapter 02's; here it is a map that is sampled evenly in another way.
layout(local_size_x = 8, local_size_y = 8) in;
#include "common/shadow.glsl"
#include "common/paraboloid.glsl"
layout(binding = 1, r32f) writeonly uniform image2DArray halves; // layer 0 looks along +z
layout(binding = 2, r32f) readonly uniform image2DArray depth_map;

void main()
{
    ivec3 at = ivec3(gl_GlobalInvocationID);
    ivec2 size = imageSize(halves).xy;
    if (any(greaterThanEqual(at.xy, size)))
        return;
    vec3 direction = paraboloid_direction(at.z, 2.0 * (vec2(at.xy) + 0.5) / vec2(size) - 1.0);
    int face = cube_face(direction);
    vec3 on_face = cube_on_face(face, direction);
    float stored = imageLoad(depth_map, ivec3(shadow_texel(on_face.xy / on_face.z, imageSize(depth_map).xy), face)).x;
    imageStore(halves, at, vec4(stored));
}
