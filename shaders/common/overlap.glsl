// overlap: does a triangle touch the closed box of a voxel? Taught line by line in chapter 01.
// Schwarz and Seidel, "Fast parallel surface and solid voxelization on GPUs" (2010), section 4.1: the box reaches the triangle's
// plane from both sides, the two bounding boxes meet, and in each of the three projections the square reaches the inner
// side of each edge. Together these are the 13 separating axes of a box and a triangle.
//
// Each test has the form: value ≥ 0 where they touch. Touching in a point counts.
#ifndef OVERLAP_GLSL
#define OVERLAP_GLSL

//[exact
// The three corners and the box [low, low + size]³ in the same unit. In double, since a sign decides.
// Component k of a vec3 below belongs to the projection along axis k, onto the axes (k+1, k+2): .yzx and .zxy.
double overlap_edge(dvec3 from, dvec3 to, dvec3 inner, dvec3 low, double size)
{
    dvec3 a = -inner * (to - from).zxy, b = inner * (to - from).yzx; // the edge's normal, towards the triangle
    dvec3 value = a * (low - from).yzx + b * (low - from).zxy + size * (max(a, 0.0) + max(b, 0.0));
    return min(value.x, min(value.y, value.z));
}

// A triangle seen edge on has no inner side: either sign then tests both sides, as its edges run to and fro.
dvec3 overlap_inner(dvec3 normal)
{
    return mix(dvec3(1.0), dvec3(-1.0), lessThan(normal, dvec3(0.0)));
}

bool overlap_exact(dvec3 p0, dvec3 p1, dvec3 p2, dvec3 low, double size)
{
    dvec3 lower = min(p0, min(p1, p2)), upper = max(p0, max(p1, p2));
    if (any(greaterThan(lower, low + size)) || any(lessThan(upper, low)))
        return false;
    dvec3 normal = cross(p1 - p0, p2 - p0);
    double plane = dot(normal, low - p0);
    if (plane + size * dot(min(normal, 0.0), dvec3(1.0)) > 0.0 || plane + size * dot(max(normal, 0.0), dvec3(1.0)) < 0.0)
        return false;
    dvec3 inner = overlap_inner(normal);
    return min(overlap_edge(p0, p1, inner, low, size),
               min(overlap_edge(p1, p2, inner, low, size), overlap_edge(p2, p0, inner, low, size))) >= 0.0;
}
//]

//[filter
// The same in single precision, for corners in voxels from a nearby voxel: +1 they touch, -1 they do not, 0 too close to tell.
// With M ≥ 1 above every coordinate's magnitude and u = 2^-24, the corners are off by uM each, so an edge by 3uM, a product
// of an edge and a distance by 8uM², an edge's value by 40uM², the normal by 16uM² and the plane's value by 160uM³ at most.
const float EDGE_ERROR = exp2(-18.0);  // 64u
const float PLANE_ERROR = exp2(-16.0); // 256u
const float BOX_ERROR = exp2(-21.0);   // 8u

float overlap_edge_fast(vec3 from, vec3 to, vec3 inner, vec3 low)
{
    vec3 a = -inner * (to - from).zxy, b = inner * (to - from).yzx;
    vec3 value = a * (low - from).yzx + b * (low - from).zxy + (max(a, 0.0) + max(b, 0.0));
    return min(value.x, min(value.y, value.z));
}

// `inner` must be the normal's signs as overlap_inner finds them in double: a wrong sign is not a small error.
int overlap_fast(vec3 p0, vec3 p1, vec3 p2, vec3 inner, vec3 low, float extent)
{
    vec3 box = min(low + 1.0 - min(p0, min(p1, p2)), max(p0, max(p1, p2)) - low);
    vec3 normal = cross(p1 - p0, p2 - p0);
    float distance = dot(normal, low - p0);
    float plane = min(dot(max(normal, 0.0), vec3(1.0)) + distance, -dot(min(normal, 0.0), vec3(1.0)) - distance);
    float edge = min(overlap_edge_fast(p0, p1, inner, low),
                     min(overlap_edge_fast(p1, p2, inner, low), overlap_edge_fast(p2, p0, inner, low)));
    // each value over its own error bound: beyond ±1 its sign is right
    float least = min(min(box.x, min(box.y, box.z)) / (BOX_ERROR * extent),
                      min(plane / (PLANE_ERROR * extent * extent * extent), edge / (EDGE_ERROR * extent * extent)));
    return least > 1.0 ? 1 : least < -1.0 ? -1 : 0;
}
//]

#endif
