// present: a linear picture as the window shows it, exactly as image_write encodes a PNG: value × 2^exposure, clipped, sRGB; NaN and Inf magenta.
layout(binding = 0) uniform sampler2D picture;
uniform float exposure_stops;
in vec2 picture_uv; // [0, 1]², v up
out vec4 color;

// IEC 61966-2-1
vec3 srgb_encode(vec3 linear)
{
    return mix(1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055, 12.92 * linear, lessThanEqual(linear, vec3(0.0031308)));
}

void main()
{
    ivec2 texel = min(ivec2(picture_uv * vec2(textureSize(picture, 0))), textureSize(picture, 0) - 1);
    vec3 value = texelFetch(picture, texel, 0).rgb;
    bool finite = !any(isnan(value)) && !any(isinf(value));
    color = vec4(finite ? srgb_encode(clamp(value * exp2(exposure_stops), 0.0, 1.0)) : vec3(1.0, 0.0, 1.0), 1.0);
}
