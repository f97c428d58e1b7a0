// G-buffer: what a pixel sees, for the passes that follow (raster.h says what is stored).
in vec3 from_eye;
in vec3 surface_normal;
layout(binding = 0, std430) readonly buffer TriangleMaterials { uint triangle_material[]; };
layout(binding = 1, std430) readonly buffer Materials { vec4 materials[]; }; // albedo, emission, albedo, ...
layout(location = 0) out float out_distance;
layout(location = 1) out vec4 out_normal;
layout(location = 2) out vec4 out_albedo;
layout(location = 3) out vec4 out_emission;
layout(location = 4) out uint out_triangle;

void main()
{
    uint material = triangle_material[gl_PrimitiveID];
    out_distance = length(from_eye);
    out_normal = vec4(normalize(gl_FrontFacing ? surface_normal : -surface_normal), 0.0);
    out_albedo = materials[2u * material];
    out_emission = materials[2u * material + 1u];
    out_triangle = uint(gl_PrimitiveID) + 1u;
}
