// Light from every texel of some rows of a reflective shadow map: rsm.c asks for all rows, draw by draw. Taught in chapter 02.
#include "02_shadow_maps/rsm_texel.glsl"

uniform int face; // of a cube
uniform int first_row, last_row;

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    vec3 point, normal;
    if (!pixel_surface(pixel, point, normal))
        return;
    int width = imageSize(map_fluxes).x;
    vec3 irradiance = vec3(0.0);
    for (int y = first_row; y < last_row; y++)
        for (int x = 0; x < width; x++)
            irradiance += texel_irradiance(x, y, face, point, normal);
    add_to_picture(pixel, irradiance);
}
