// cube: GL's cube map faces, +X -X +Y -Y +Z -Z (OpenGL 4.5 core, table 8.19), for drawing into them and for finding a texel again.

// Where `direction` stands on `face`: xy / z in [-1, 1]² is the place, z the distance along the face's axis (negative: behind).
vec3 cube_on_face(int face, vec3 direction)
{
    bool negative = (face & 1) != 0;
    vec3 d = negative ? -direction : direction; // d.axis is the distance along the face's axis
    if (face < 2)
        return vec3(-d.z, -direction.y, d.x);
    if (face < 4)
        return vec3(direction.x, d.z, d.y);
    return vec3(d.x, -direction.y, d.z);
}

// The face that `direction` points to: its longest component.
int cube_face(vec3 direction)
{
    vec3 a = abs(direction);
    int axis = a.x >= a.y && a.x >= a.z ? 0 : (a.y >= a.z ? 1 : 2);
    return 2 * axis + int(direction[axis] < 0.0);
}

// A direction through this place of the face, 1 long along its axis: cube_on_face the other way round.
vec3 cube_direction(int face, vec2 place)
{
    vec3 d = face < 2 ? vec3(1.0, -place.y, -place.x) : face < 4 ? vec3(place.x, 1.0, place.y) : vec3(place.x, -place.y, 1.0);
    if ((face & 1) == 0)
        return d;
    return face < 2 ? vec3(-1.0, -place.y, place.x) : face < 4 ? vec3(place.x, -1.0, -place.y) : vec3(-place.x, -place.y, -1.0);
}
