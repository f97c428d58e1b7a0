// show_flux: a reflective map's flux as light, for looking at: all faces side by side, a row of three. Each texel is shown as its flux over the mean
// of all that have any, so that the picture does not depend on how many there are.
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, rgba32f) writeonly uniform image2D picture;
#if LAYERED
layout(binding = 1, rgba32f) readonly uniform image2DArray flux;
#else
layout(binding = 1, rgba32f) readonly uniform image2D flux;
#endif
uniform float scale; // picture radiance a watt

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(picture);
    if (any(greaterThanEqual(pixel, size)))
        return;
    const ivec2 tiles = LAYERED == 1 ? ivec2(3, 2) : ivec2(1);
    int side = min(size.x / tiles.x, size.y / tiles.y);
    ivec2 from_corner = pixel - (size - side * tiles) / 2;
    vec3 shown = vec3(0.0);
    if (side > 0 && all(greaterThanEqual(from_corner, ivec2(0))) && all(lessThan(from_corner, side * tiles))) {
        ivec2 tile = from_corner / side;
        vec2 place = (vec2(from_corner - tile * side) + 0.5) / float(side);
#if LAYERED
        shown = scale * imageLoad(flux, ivec3(ivec2(place * vec2(imageSize(flux).xy)), tile.y * tiles.x + tile.x)).rgb;
#else
        shown = scale * imageLoad(flux, ivec2(place * vec2(imageSize(flux)))).rgb;
#endif
    }
    imageStore(picture, pixel, vec4(shown, 1.0));
}
