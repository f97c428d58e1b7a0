// paraboloid: all directions on two squares (Heidrich and Seidel 1998; for shadows Brabec, Annen and Seidel 2002). Chapter 02 teaches it line by line.
//
// A mirror shaped like the paraboloid z = (1 - x² - y²)/2 sends every direction of the half space z >= 0 into parallel rays. Its normal at
// (x, y) is (x, y, 1), the sum of the direction and of the axis up to length: so (x, y) = d.xy / (1 + d.z). That is the stereographic projection:
// it keeps angles, and a half fills the unit disc. The square's corners reach to d.z = -1/3, behind the border to the other half.

//[paraboloid
const float PARABOLOID_LEAST_Z = -1.0 / 3.0; // of unit directions in the corners of the square

// Half 0 looks along +z, half 1 along -z. Directions and points relative to the light alike.
int paraboloid_half(vec3 direction)
{
    return int(direction.z < 0.0);
}
vec3 paraboloid_turn(int side, vec3 direction)
{
    return side == 0 ? direction : vec3(direction.x, direction.y, -direction.z);
}

// Place in [-1, 1]² of a direction of any length that does not point straight away from the half's axis.
vec2 paraboloid_place(int side, vec3 direction)
{
    vec3 d = paraboloid_turn(side, direction);
    return d.xy / (length(d) + d.z);
}

// The unit direction at a place; the other way round.
vec3 paraboloid_direction(int side, vec2 place)
{
    float square = dot(place, place);
    return paraboloid_turn(side, vec3(2.0 * place, 1.0 - square) / (1.0 + square));
}

// How many radians a unit of place covers, in any direction: 2 on the axis, 1 at the border.
float paraboloid_angle(vec2 place)
{
    return 2.0 / (1.0 + dot(place, place));
}
//]
