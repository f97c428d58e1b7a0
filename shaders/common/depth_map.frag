// Depth map, last stage: metres from the light, or along its way from the map's plane. Blending keeps the smallest value, so there is
// no depth buffer, and no loss of precision to a near plane that is very near.
in vec3 from_origin;
layout(location = 0) out float light_distance;
#if MAP_KIND == 2 // directional
uniform vec3 direction; // unit
#endif

void main()
{
#if MAP_KIND == 2 // directional
    light_distance = dot(from_origin, direction);
#else
    light_distance = length(from_origin);
#endif
}
