// paint: visibility as grey, what asks nothing in dark blue, for looking at.
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, rgba32f) writeonly uniform image2D picture;
layout(binding = 1, r32f) readonly uniform image2D visibility;

const vec3 ASKS_NOTHING = vec3(0.01, 0.015, 0.05); // sky, surfaces that face away, what lies beside a spot's cone

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    float lit = imageLoad(visibility, pixel).x;
    imageStore(picture, pixel, vec4(lit < 0.0 ? ASKS_NOTHING : vec3(lit), 1.0));
}
